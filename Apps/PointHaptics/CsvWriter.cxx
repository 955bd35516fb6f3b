#include "CsvWriter.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include <unistd.h>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr std::size_t kFlushAt = 1 << 16;

} // namespace

CsvWriter::~CsvWriter()
{
  this->discard();
}

bool CsvWriter::open(const std::string& fileName, const std::string& header, std::string& message)
{
  std::error_code error;
  if (std::filesystem::is_directory(fileName, error))
  {
    message = fileName + ": is a folder; name a file";
    return false;
  }
  // A link stays a link: the file it points to is replaced. What is no regular file (a pipe, a device) is
  // written as it stands: it cannot be replaced without harm.
  const std::filesystem::path resolved = std::filesystem::weakly_canonical(fileName, error);
  fileName_ = error ? fileName : resolved.string();
  const std::filesystem::file_status status = std::filesystem::status(fileName_, error);
  const bool replaces = !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
  temporaryName_ = replaces ? fmt::format("{}.{}.tmp", fileName_, getpid()) : std::string();
  file_ = replaces ? std::fopen(temporaryName_.c_str(), "wbx") : std::fopen(fileName_.c_str(), "wb");
  if (!file_)
  {
    message = fmt::format(
      "{}: cannot be created: {}; check the folder and its permissions", fileName, std::strerror(errno));
    return false;
  }
  buffer_ = header + "\n";
  return true;
}

void CsvWriter::row(const double* values, std::size_t count)
{
  char digits[40];
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, values[i]);
    buffer_.append(digits, end.ptr);
    buffer_ += i + 1 < count ? ',' : '\n';
  }
  if (buffer_.size() >= kFlushAt)
  {
    failed_ = std::fwrite(buffer_.data(), 1, buffer_.size(), file_) != buffer_.size() || failed_;
    buffer_.clear();
  }
}

bool CsvWriter::commit(std::string& message)
{
  failed_ = std::fwrite(buffer_.data(), 1, buffer_.size(), file_) != buffer_.size() || failed_;
  failed_ = std::fclose(file_) != 0 || failed_;
  file_ = nullptr;
  const bool replaces = !temporaryName_.empty();
  if (failed_ || (replaces && std::rename(temporaryName_.c_str(), fileName_.c_str()) != 0))
  {
    message = fmt::format("{}: cannot be written: {}; check the space left", fileName_, std::strerror(errno));
    this->discard();
    return false;
  }
  temporaryName_.clear();
  return true;
}

void CsvWriter::discard()
{
  if (file_)
  {
    std::fclose(file_);
    file_ = nullptr;
  }
  if (!temporaryName_.empty())
  {
    std::remove(temporaryName_.c_str());
    temporaryName_.clear();
  }
}

} // namespace app
} // namespace pointhaptics
