#include "Core/Base/OutputFile.h"

#include <cerrno>
#include <filesystem>
#include <random>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace pointhaptics
{
namespace
{

constexpr std::size_t kFlushAt = std::size_t{ 1 } << 16;
constexpr int kMostLinks = 40; ///< As many as Linux follows.
constexpr int kMostNames = 16; ///< Random names tried before giving up.
/// File systems take names of 255 bytes: this much of the target's own stays readable in the temporary one.
constexpr std::size_t kKeptOfName = 200;

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

fs::path temporaryBeside(const fs::path& target)
{
  std::random_device random;
  const std::string name = target.filename().string().substr(0, kKeptOfName);
  return target.parent_path() / ("." + name + "." + std::to_string(random()) + ".part");
}

} // namespace

OutputFile::~OutputFile()
{
  this->discard();
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
  return this->fail(std::generic_category().message(error),
    diskFull_ ? "free some space on the disk or write elsewhere"
              : "check that the folder exists and that you may write in it");
}

void OutputFile::discard() noexcept
{
  if (descriptor_ >= 0)
  {
    ::close(descriptor_);
    descriptor_ = -1;
  }
  if (!temporary_.empty())
  {
    ::unlink(temporary_.c_str());
    temporary_.clear();
  }
  buffer_.clear();
}

Status OutputFile::open(const std::string& target)
{
  this->discard();
  reason_.clear();
  cure_.clear();
  diskFull_ = false;
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
  if (exists && !S_ISREG(status.st_mode))
  {
    target_ = target;
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    return descriptor_ >= 0 ? Status::Ok : this->fail(errno);
  }
  std::error_code error;
  const fs::path end = endOfLinks(target, error);
  if (error)
  {
    return this->fail(error.message(), "name a file, or repair the link");
  }
  target_ = end.string();
  for (int i = 0; i < kMostNames && descriptor_ < 0; ++i)
  {
    const std::string name = temporaryBeside(end).string();
    descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0)
    {
      temporary_ = name;
    }
    else if (errno != EEXIST)
    {
      break;
    }
  }
  if (descriptor_ < 0)
  {
    return this->fail(errno);
  }
  if (exists && ::fchmod(descriptor_, status.st_mode & 07777) != 0)
  {
    return this->fail(errno);
  }
  return Status::Ok;
}

void OutputFile::flush()
{
  std::size_t done = 0;
  while (done < buffer_.size())
  {
    const ssize_t written = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (written < 0 && errno != EINTR)
    {
      static_cast<void>(this->fail(errno));
      return;
    }
    done += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  buffer_.clear();
}

Status OutputFile::write(std::string_view bytes)
{
  if (descriptor_ < 0)
  {
    return Status::FileNotWritable;
  }
  buffer_ += bytes;
  if (buffer_.size() >= kFlushAt)
  {
    this->flush();
  }
  return reason_.empty() ? Status::Ok : Status::FileNotWritable;
}

Status OutputFile::join(const std::string& unfinished)
{
  this->discard();
  reason_.clear();
  cure_.clear();
  target_ = unfinished;
  descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  return descriptor_ >= 0 ? Status::Ok : this->fail(errno);
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

Status OutputFile::commit()
{
  if (descriptor_ >= 0)
  {
    this->flush();
  }
  if (descriptor_ < 0)
  {
    return reason_.empty() ? this->fail("no file is open", "open one first") : Status::FileNotWritable;
  }
  const int closed = ::close(descriptor_); // a full disk may show only here
  descriptor_ = -1;
  if (closed != 0 || (this->isReplacing() && ::rename(temporary_.c_str(), target_.c_str()) != 0))
  {
    return this->fail(errno);
  }
  temporary_.clear();
  return Status::Ok;
}

} // namespace pointhaptics
