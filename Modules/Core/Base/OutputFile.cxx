#include "Core/Base/OutputFile.h"

#include <cerrno>
#include <filesystem>
#include <mutex>
#include <system_error>

#include <fcntl.h>
#include <linux/fs.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace pointhaptics
{
namespace
{

constexpr std::size_t kFlushAt = std::size_t{ 1 } << 16;
constexpr int kMostLinks = 40; ///< As many as Linux follows.
constexpr int kMostParts = 64; ///< Most parts of one target: as many processes may write it at a time.
/// Bytes of the target's own name that stay in the part's: file systems take names of 255 bytes.
constexpr std::size_t kKeptOfName = 200;
constexpr const char* kPartEnding = ".part";

/// Where the bytes of @p target belong: the end of its chain of links, whether that exists or not.
fs::path endOfLinks(fs::path target, std::error_code& error)
{
  error.clear();
  for (int i = 0; i < kMostLinks; ++i)
  {
    std::error_code notALink;
    const fs::path next = fs::read_symlink(target, notALink);
    if (notALink)
    {
      return target;
    }
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
  return target;
}

std::string partOf(const fs::path& target, int number)
{
  const std::string name = target.filename().string().substr(0, kKeptOfName);
  return (target.parent_path() / ("." + name + "." + std::to_string(number) + kPartEnding)).string();
}

/// True if an open OutputFile, of any process, holds the lock of this part.
bool isLocked(const std::string& part)
{
  const int descriptor = ::open(part.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0)
  {
    return errno != ENOENT; // somebody else's
  }
  const bool isLocked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0;
  ::close(descriptor);
  return isLocked;
}

bool isLivingPart(const fs::path& target)
{
  return target.extension() == kPartEnding && isLocked(target.string());
}

/// Creates and locks a part. @return its descriptor, or -1: errno says why.
int createPart(const std::string& part)
{
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  struct stat status = {};
  // Another process may have taken it for a dead one's before it was locked.
  if (descriptor >= 0 && ::flock(descriptor, LOCK_EX) == 0 && ::fstat(descriptor, &status) == 0 &&
    status.st_nlink == 0)
  {
    ::close(descriptor);
    errno = EEXIST;
    return -1;
  }
  return descriptor;
}

/// "/dev/stdout" and its other names.
bool isStandardOutput(const std::string& target)
{
  return target == "/dev/stdout" || target == "/dev/fd/1" || target == "/proc/self/fd/1";
}

const char* cureOf(int error)
{
  switch (error)
  {
    case ENOSPC:
    case EDQUOT:
      return "free some space on the disk or write elsewhere";
    case EFBIG:
      return "raise the limit of file sizes (ulimit -f), or write elsewhere";
    case EMFILE:
    case ENFILE:
      return "raise the limit of open files (ulimit -n), or write fewer at a time";
    case EPIPE:
      return "its reader has ended: look why";
    case EROFS:
      return "write elsewhere";
    default:
      return "check that the folder exists and that you may write in it";
  }
}

/// All objects of this process, for discardAll().
OutputFile* all = nullptr;
std::mutex allMutex;

} // namespace

OutputFile::OutputFile()
{
  const std::lock_guard<std::mutex> lock(allMutex);
  next_ = all;
  all = this;
}

OutputFile::~OutputFile()
{
  this->discard();
  const std::lock_guard<std::mutex> lock(allMutex);
  OutputFile** place = &all;
  while (*place != this)
  {
    place = &(*place)->next_;
  }
  *place = next_;
}

void OutputFile::discardAll() noexcept
{
  for (OutputFile* file = all; file; file = file->next_)
  {
    file->discard();
  }
}

Status OutputFile::fail(const std::string& reason, const std::string& cure)
{
  reason_ = reason;
  cure_ = cure;
  this->discard();
  return Status::FileNotWritable;
}

Status OutputFile::fail(int error)
{
  diskFull_ = error == ENOSPC || error == EDQUOT || error == EFBIG;
  readerGone_ = error == EPIPE;
  return this->fail(std::generic_category().message(error), cureOf(error));
}

void OutputFile::discard() noexcept
{
  if (descriptor_ >= 0)
  {
    ::close(descriptor_);
    descriptor_ = -1;
  }
  if (!temporary_.empty() && !isKept_)
  {
    ::unlink(temporary_.c_str());
  }
  temporary_.clear();
  buffer_.clear();
}

void OutputFile::abandon() noexcept
{
  isKept_ = false;
  this->discard();
}

Status OutputFile::check(const std::string& target)
{
  this->discard();
  isKept_ = replaces_ = false;
  reason_.clear();
  cure_.clear();
  diskFull_ = readerGone_ = false;
  if (fs::path(target).filename().empty())
  {
    return this->fail("this is no file name", "choose the name of a new file");
  }
  struct stat status = {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode))
  {
    return this->fail("this is a folder", "choose the name of a new file");
  }
  // Root may write what nobody may: the bits tell what was meant.
  if (exists && ((status.st_mode & 0222) == 0 || ::access(target.c_str(), W_OK) != 0))
  {
    return this->fail("the file is write-protected", "choose another name, or allow it: chmod u+w");
  }
  std::error_code error;
  const fs::path end = endOfLinks(target, error);
  if (error)
  {
    return this->fail(error.message(), "name a file, or repair the link");
  }
  const bool isReplaced = !exists || S_ISREG(status.st_mode);
  const std::string folder = end.has_parent_path() ? end.parent_path().string() : ".";
  if (isReplaced && !isStandardOutput(target) && !isLivingPart(end) &&
    ::access(folder.c_str(), W_OK | X_OK) != 0)
  {
    return exists && errno != ENOENT ? this->fail(std::generic_category().message(errno) +
                                           " in its folder, where a complete file replaces it",
                                         "allow to write in the folder, or write elsewhere")
                                     : this->fail(errno);
  }
  target_ = end.string();
  isRegular_ = isReplaced && !isStandardOutput(target);
  return Status::Ok;
}

Status OutputFile::openInPlace(int descriptor)
{
  descriptor_ = descriptor;
  return descriptor_ >= 0 ? Status::Ok : this->fail(errno);
}

/// @p replaced: of the file that is there; null where there is none.
Status OutputFile::openPart(const struct stat* replaced)
{
  int problem = EEXIST;
  if (isKept_)
  {
    const std::string part = keptPartOf(target_);
    descriptor_ = createPart(part);
    problem = descriptor_ < 0 ? errno : 0;
    temporary_ = descriptor_ < 0 ? std::string() : part;
    if (problem == EEXIST)
    {
      return this->fail(
        part + " is there, left by a run that was ended", "rename it to keep it, or remove it");
    }
  }
  for (int number = isKept_ ? kMostParts + 1 : 1; number <= kMostParts; ++number)
  {
    const std::string part = partOf(target_, number);
    struct stat status = {};
    const bool exists = ::lstat(part.c_str(), &status) == 0;
    if (!exists && descriptor_ >= 0)
    {
      break;
    }
    if (exists && !isLocked(part))
    {
      ::unlink(part.c_str());
    }
    if (descriptor_ < 0)
    {
      descriptor_ = createPart(part);
      problem = descriptor_ < 0 ? errno : 0;
      temporary_ = descriptor_ < 0 ? std::string() : part;
    }
    if (problem != 0 && problem != EEXIST)
    {
      break;
    }
  }
  if (problem != 0)
  {
    return this->fail(problem);
  }
  if (replaced)
  {
    // Only root can keep another owner.
    static_cast<void>(::fchown(descriptor_, replaced->st_uid, replaced->st_gid) == 0);
  }
  return replaced && ::fchmod(descriptor_, replaced->st_mode & 07777) != 0 ? this->fail(errno) : Status::Ok;
}

std::string OutputFile::keptPartOf(const std::string& target)
{
  return target + kPartEnding;
}

std::string OutputFile::missedPart(const std::string& target)
{
  const std::string part = keptPartOf(target);
  const bool isMissed = ::access(target.c_str(), F_OK) != 0 && ::access(part.c_str(), F_OK) == 0;
  return isMissed ? "there is no such file, but what an ended run kept of it: give " + part : std::string();
}

void OutputFile::forgetKept(const std::string& target)
{
  const std::string part = keptPartOf(target);
  if (!isLocked(part))
  {
    ::unlink(part.c_str());
  }
}

Status OutputFile::open(const std::string& target, bool isKept)
{
  if (this->check(target) != Status::Ok)
  {
    return Status::FileNotWritable;
  }
  if (isStandardOutput(target))
  {
    target_ = target;
    return this->openInPlace(::dup(STDOUT_FILENO));
  }
  if (!isRegular_)
  {
    target_ = target;
    return this->openInPlace(::open(target.c_str(), O_WRONLY | O_CLOEXEC));
  }
  if (isLivingPart(target_))
  {
    return this->openInPlace(::open(target_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
  }
  struct stat status = {};
  isKept_ = isKept;
  replaces_ = ::stat(target_.c_str(), &status) == 0;
  return this->openPart(replaces_ ? &status : nullptr);
}

Status OutputFile::flush()
{
  std::size_t done = 0;
  while (done < buffer_.size())
  {
    const ssize_t written = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (written < 0 && errno != EINTR)
    {
      return this->fail(errno);
    }
    done += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  buffer_.clear();
  return descriptor_ >= 0 ? Status::Ok : Status::FileNotWritable;
}

Status OutputFile::write(std::string_view bytes)
{
  if (descriptor_ < 0)
  {
    return Status::FileNotWritable;
  }
  buffer_ += bytes;
  return buffer_.size() < kFlushAt ? Status::Ok : this->flush();
}

Status OutputFile::writeAt(std::uint64_t place, std::string_view bytes)
{
  while (descriptor_ >= 0 && !bytes.empty())
  {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (written < 0 && errno != EINTR)
    {
      return this->fail(errno);
    }
    const std::size_t done = written > 0 ? static_cast<std::size_t>(written) : 0;
    bytes.remove_prefix(done);
    place += done;
  }
  return descriptor_ >= 0 ? Status::Ok : Status::FileNotWritable;
}

bool OutputFile::renamePart() noexcept
{
  const unsigned how = isKept_ && !replaces_ ? RENAME_NOREPLACE : 0U;
  return ::syscall(SYS_renameat2, AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), how) == 0 ||
    // Not every file system knows how.
    ((errno == EINVAL || errno == ENOSYS) && (how == 0 || ::access(target_.c_str(), F_OK) != 0) &&
      ::rename(temporary_.c_str(), target_.c_str()) == 0);
}

Status OutputFile::commit()
{
  if (this->flush() != Status::Ok)
  {
    return reason_.empty() ? this->fail("no file is open", "open one first") : Status::FileNotWritable;
  }
  // Renamed while it is locked. A full disk may show only where it is closed, so the descriptor goes first.
  const int lock = ::dup(descriptor_);
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  const bool isDone = closed == 0 && (temporary_.empty() || this->renamePart());
  const int problem = errno;
  ::close(lock);
  if (!isDone && problem == EEXIST)
  {
    return this->fail("a file of that name came meanwhile", "rename " + temporary_);
  }
  if (!isDone)
  {
    return this->fail(problem);
  }
  temporary_.clear();
  return Status::Ok;
}

} // namespace pointhaptics
