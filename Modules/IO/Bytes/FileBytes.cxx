#include "Bytes/FileBytes.h"

#include "FileProblem.h"

#include "Core/Base/OutputFile.h"

#include "vtk_zlib.h"
#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace pointhaptics::io
{
namespace
{

constexpr std::size_t kReadAtOnce = std::size_t{ 1 } << 22;
constexpr std::size_t kPackedAtOnce = std::size_t{ 1 } << 16;
/// Unpacked bytes that are inspected before the rest is unpacked.
constexpr std::size_t kInspected = std::size_t{ 1 } << 16;
constexpr int kGzipOnly = 16; ///< zlib: add to the window's bits to ask for gzip's header
constexpr std::string_view kGzipMagic = "\x1f\x8b";
constexpr const char* kStandardInput = "/dev/stdin";

/// Throws where the file @p isWrong.
void failOpenIf(bool isWrong, const std::string& what, const char* cure)
{
  if (isWrong)
  {
    throw FileProblem(vtkErrorCode::CannotOpenFileError, what, cure);
  }
}

void checkIsReadable(const std::string& path)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
  {
    const std::string missed = OutputFile::missedPart(path);
    throw FileProblem(
      vtkErrorCode::FileNotFoundError, missed.empty() ? "there is no such file; check the path" : missed);
  }
  failOpenIf(status.type() == fs::file_type::none, error.message(), "check the path and its permissions");
  failOpenIf(fs::is_directory(status), "this is a folder", "name one file inside it");
  failOpenIf(fs::is_block_file(status) || (fs::is_character_file(status) && path != kStandardInput),
    "this is a device", "name a file or a pipe");
}

/// Frees what zlib allocates.
struct Inflater
{
  z_stream stream{};

  Inflater()
  {
    if (inflateInit2(&stream, MAX_WBITS + kGzipOnly) != Z_OK)
    {
      throw std::bad_alloc();
    }
  }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Unpacks at most @p room bytes; @p ended receives whether the member ends there. @return their number.
  template <typename Where>
  std::size_t unpack(char* to, std::size_t room, bool& ended, const Where& where)
  {
    stream.next_out = reinterpret_cast<Bytef*>(to);
    stream.avail_out = static_cast<uInt>(room);
    const int result = inflate(&stream, Z_NO_FLUSH);
    ended = result == Z_STREAM_END;
    failFormatIf(result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR,
      "the file is damaged: copy it again, or test it with gunzip -t", "{}{}", where(),
      (stream.msg ? stream.msg : "damaged data"));
    return room - stream.avail_out;
  }
};

/// Unpacks the start of a gzip file that starts with @p packed: one that is no cloud need not be read whole.
void inspectPacked(std::string_view packed, const FileBytes::Inspect& inspect)
{
  Inflater inflater;
  inflater.stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  inflater.stream.avail_in = static_cast<uInt>(packed.size());
  const auto where = [&]
  { return "byte " + std::to_string(packed.size() - inflater.stream.avail_in) + " of the gzip file: "; };
  std::string start(kInspected, '\0');
  bool ended = false;
  const bool isFull = inflater.unpack(start.data(), start.size(), ended, where) == start.size();
  isFull && !ended ? inspect(start, 0) : void(); // a shorter one is seen whole
}

std::ifstream opened(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  failOpenIf(!file, std::strerror(errno), "check that you may read the file");
  return file;
}

/// Reads exactly @p size bytes from byte @p offset on, of @p all. @throws FileProblem when there are fewer.
void readFrom(std::ifstream& file, std::size_t offset, char* to, std::size_t size, std::size_t all)
{
  file.seekg(static_cast<std::streamoff>(offset)).read(to, static_cast<std::streamsize>(size));
  const auto got = static_cast<std::size_t>(file.gcount());
  failOpenIf(got != size, fmt::format("reading stopped at byte {} of {}", offset + got, all),
    "check the disk, or wait until the file is completely written");
}

} // namespace

FileBytes::FileBytes(const std::string& path, const Progress& progress, const Inspect& inspect, bool salvages)
{
  checkIsReadable(path);
  std::error_code ignored;
  const bool isStream = !fs::is_regular_file(path, ignored);
  isStream ? readStream(path, progress) : readPlain(path, progress, inspect);
  if (size_ == 0)
  {
    throw FileProblem(vtkErrorCode::PrematureEndOfFileError, "the file is empty (0 bytes)",
      "export the cloud again or copy the file again");
  }
  wasPacked_ = view().substr(0, 2) == kGzipMagic;
  if (wasPacked_)
  {
    unpack(progress, inspect, salvages);
  }
  else if (isStream)
  {
    inspect(view(), size_);
  }
}

FileBytes::FileBytes(const std::string& path)
{
  checkIsReadable(path);
  file_ = opened(path);
  size_ = static_cast<std::size_t>(fs::file_size(path));
  data_.reset(static_cast<char*>(std::calloc(std::max(size_, std::size_t{ 1 }), 1)));
  if (!data_)
  {
    throw std::bad_alloc();
  }
}

void FileBytes::load(std::size_t offset, std::size_t size)
{
  readFrom(file_, offset, data_.get() + offset, size, size_);
  loaded_ += size;
}

/// Memory that was never touched costs nothing: growing by much is cheap.
void FileBytes::resize(std::size_t size)
{
  void* grown = std::realloc(data_.get(), size);
  grown ? static_cast<void>(data_.release()) : throw std::bad_alloc();
  data_.reset(static_cast<char*>(grown));
}

/// @p progress is asked while the pipe is silent: it may throw to end the waiting.
void FileBytes::readStream(const std::string& path, const Progress& progress)
{
  constexpr int kPatience = 100; // ms between questions whether to go on
  const int pipe = path == kStandardInput
    ? ::dup(STDIN_FILENO)
    : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); // it may have no writer yet
  const std::shared_ptr<void> closed(nullptr, [pipe](void*) { ::close(pipe); });
  std::size_t capacity = 0;
  ssize_t got = pipe < 0 ? -1 : 1;
  while (got > 0)
  {
    struct pollfd input = { pipe, POLLIN, 0 };
    if (::poll(&input, 1, kPatience) <= 0)
    {
      progress(0.0);
      continue;
    }
    if (capacity < size_ + kReadAtOnce / 4)
    {
      capacity = 2 * size_ + kReadAtOnce;
      resize(capacity);
    }
    got = ::read(pipe, data_.get() + size_, capacity - size_);
    size_ += got > 0 ? static_cast<std::size_t>(got) : 0;
    got = got < 0 && (errno == EINTR || errno == EAGAIN) ? 1 : got;
  }
  failOpenIf(got < 0, std::strerror(errno), "check the program that writes the pipe");
  resize(std::max(size_, std::size_t{ 1 }));
}

void FileBytes::readPlain(const std::string& path, const Progress& progress, const Inspect& inspect)
{
  std::ifstream file = opened(path);
  const auto all = static_cast<std::size_t>(fs::file_size(path));
  resize(std::max(all, std::size_t{ 1 }));
  bool isPacked = false;
  while (size_ < all)
  {
    const std::size_t piece = std::min(kReadAtOnce, all - size_);
    readFrom(file, size_, data_.get() + size_, piece, all);
    if (size_ == 0)
    {
      isPacked = std::string_view(data_.get(), piece).substr(0, 2) == kGzipMagic;
      const std::string_view start(data_.get(), piece);
      isPacked ? inspectPacked(start, inspect) : inspect(start, all);
    }
    size_ += piece;
    progress(isPacked ? 0.0 : static_cast<double>(size_) / static_cast<double>(all));
  }
}

/// Takes the bytes for those of a gzip file.
void FileBytes::unpack(const Progress& progress, const Inspect& inspect, bool salvages)
{
  const std::unique_ptr<char, Free> packed = std::move(data_);
  const std::size_t packedSize = std::exchange(size_, 0);
  const std::size_t limit = std::max(kGzipFloor, kMostGzipRatio * packedSize);
  Inflater inflater;
  std::size_t taken = 0; // by zlib
  const auto where = [&]
  { return "byte " + std::to_string(taken - inflater.stream.avail_in) + " of the gzip file: "; };
  const auto unread = [&] { return inflater.stream.avail_in > 0 || taken < packedSize; };
  std::size_t capacity = kInspected;
  resize(capacity);
  bool inspected = false;
  bool ended = false;
  while (!ended || unread())
  {
    if (inflater.stream.avail_in == 0 && taken < packedSize)
    {
      inflater.stream.next_in = reinterpret_cast<Bytef*>(packed.get() + taken);
      inflater.stream.avail_in = static_cast<uInt>(std::min(kPackedAtOnce, packedSize - taken));
      taken += inflater.stream.avail_in;
      progress(static_cast<double>(taken) / static_cast<double>(packedSize));
    }
    if (ended)
    {
      inflateReset(&inflater.stream); // another member follows
    }
    size_ += inflater.unpack(data_.get() + size_, std::min(capacity - size_, kReadAtOnce), ended, where);
    const bool isCut = !ended && size_ < capacity && !unread();
    if (isCut && (!salvages || size_ == 0))
    {
      failTruncated(where() + "the compressed data end too early", size_ > 0 ? kSalvageCure : "");
    }
    if (!inspected && size_ > 0 && (size_ == kInspected || ended || isCut))
    {
      inspect(view(), (ended && taken == packedSize) || isCut ? size_ : 0);
      inspected = true;
    }
    if (isCut)
    {
      isCut_ = true;
      return;
    }
    if (size_ == capacity)
    {
      failFormatIf(capacity == limit, "if this is no attack, unpack it first: gunzip -k FILE",
        "{}unpacks to more than {} bytes from {}", where(), limit, packedSize);
      capacity = std::min(limit, 2 * capacity);
      resize(capacity);
    }
  }
  failTruncatedIf(size_ == 0, "the gzip file holds 0 bytes");
}

std::string startOfFile(const std::string& path, std::size_t size)
{
  std::string start(size, '\0');
  std::error_code ignored; // a pipe would lose what is read
  std::ifstream file;
  fs::is_regular_file(path, ignored) ? file.open(path, std::ios::binary) : void();
  file.read(start.data(), static_cast<std::streamsize>(size));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return start;
}

std::string lowerExtension(const std::string& path)
{
  const std::string extension = vtksys::SystemTools::LowerCase(fs::path(path).extension().string());
  return extension.empty() ? extension : extension.substr(1);
}

} // namespace pointhaptics::io
