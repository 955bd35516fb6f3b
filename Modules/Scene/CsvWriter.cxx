#include "CsvWriter.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

namespace pointhaptics
{
namespace
{

/// A killed process loses at most this much of a touch.
constexpr auto kFlushPeriod = std::chrono::seconds(1);

} // namespace

bool CsvWriter::open(
  const std::string& fileName, const std::string& header, std::string& message, bool isKept)
{
  fileName_ = fileName;
  isKept_ = isKept;
  isOpen_ = isFine_ = file_.open(fileName, isKept) == Status::Ok;
  if (!isOpen_)
  {
    message = fmt::format("{}: cannot be created: {}; {}", fileName, file_.reason(), file_.cure());
    return false;
  }
  this->add(header + "\n");
  return true;
}

void CsvWriter::add(const std::string& line)
{
  isFine_ = file_.write(line) == Status::Ok && isFine_;
  if (isKept_ && isFine_ && Clock::now() - flushed_ >= kFlushPeriod)
  {
    isFine_ = file_.flush() == Status::Ok;
    flushed_ = Clock::now();
  }
}

void CsvWriter::row(const double* values, std::size_t count)
{
  char digits[40];
  line_.clear();
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, values[i]);
    line_.append(digits, end.ptr);
    line_ += i + 1 < count ? ',' : '\n';
  }
  this->add(line_);
}

bool CsvWriter::commit(std::string& message)
{
  isOpen_ = false;
  if (file_.commit() != Status::Ok)
  {
    const std::string part = OutputFile::keptPartOf(fileName_);
    std::error_code ignored;
    message = fmt::format("{}: cannot be written: {}; {}{}", fileName_, file_.reason(), file_.cure(),
      isKept_ && std::filesystem::exists(part, ignored) ? "; " + part + " has what came before" : "");
    return false;
  }
  return true;
}

void CsvWriter::abandon()
{
  isOpen_ = false;
  file_.abandon();
}

} // namespace pointhaptics
