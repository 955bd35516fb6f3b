#include "CsvWriter.h"

#include <fmt/format.h>

#include <charconv>

namespace pointhaptics
{

bool CsvWriter::open(const std::string& fileName, const std::string& header, std::string& message)
{
  fileName_ = fileName;
  if (file_.open(fileName) != Status::Ok)
  {
    message = fmt::format("{}: cannot be created: {}; {}", fileName, file_.reason(), file_.cure());
    return false;
  }
  static_cast<void>(file_.write(header + "\n"));
  return true;
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
  static_cast<void>(file_.write(line_)); // commit() tells
}

bool CsvWriter::commit(std::string& message)
{
  if (file_.commit() != Status::Ok)
  {
    message = fmt::format("{}: cannot be written: {}; {}", fileName_, file_.reason(), file_.cure());
    return false;
  }
  return true;
}

} // namespace pointhaptics
