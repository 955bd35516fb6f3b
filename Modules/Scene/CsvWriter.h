/// @file
/// A table of numbers as text, shortest digits that read back to the same doubles.
#pragma once

#include "Core/Base/OutputFile.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <chrono>
#include <string>

namespace pointhaptics
{

/// Writes rows of numbers into an OutputFile, which appears under its name with commit(). One thread.
class POINTHAPTICSSCENE_EXPORT CsvWriter
{
public:
  /// Opens the file. @param isKept for data that cannot be made again: rows stand in NAME.part within a
  /// second, and stay there where commit() is not reached (OutputFile::open()). False: @p message says
  /// why the file cannot be created.
  bool open(
    const std::string& fileName, const std::string& header, std::string& message, bool isKept = false);
  bool isOpen() const { return isOpen_; }
  void row(const double* values, std::size_t count);
  /// Writes a line "# text".
  void comment(const std::string& text) { this->add("# " + text + "\n"); }
  /// False: not all could be written; commit() says why.
  bool isFine() const { return isFine_; }
  /// False: @p message says why; the target is as it was before. Closes the file in any case.
  bool commit(std::string& message);
  /// Closes and removes the file.
  void abandon();

private:
  using Clock = std::chrono::steady_clock;
  void add(const std::string& line);

  std::string fileName_;
  OutputFile file_;
  std::string line_;
  bool isOpen_ = false;
  bool isFine_ = true;
  bool isKept_ = false;
  Clock::time_point flushed_;
};

} // namespace pointhaptics
