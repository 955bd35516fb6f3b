/// @file
/// A table of numbers as text, shortest digits that read back to the same doubles; it appears only when
/// complete.
#pragma once

#include <cstdio>
#include <string>

namespace pointhaptics
{
namespace app
{

/// Writes to a temporary file beside the target; commit() renames it. Without commit() nothing is left
/// behind. A target that is a link keeps being one; a pipe or a device is written to as it stands.
class CsvWriter
{
public:
  CsvWriter() = default;
  ~CsvWriter();
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;

  /// False: @p message says why the file cannot be created.
  bool open(const std::string& fileName, const std::string& header, std::string& message);
  void row(const double* values, std::size_t count);
  /// False: @p message says why; the target is as it was before.
  bool commit(std::string& message);

private:
  void discard();

  std::string fileName_;
  std::string temporaryName_;
  std::FILE* file_ = nullptr;
  std::string buffer_;
  bool failed_ = false;
};

} // namespace app
} // namespace pointhaptics
