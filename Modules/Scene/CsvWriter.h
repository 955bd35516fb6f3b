/// @file
/// A table of numbers as text, shortest digits that read back to the same doubles.
#pragma once

#include "Core/Base/OutputFile.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <chrono>
#include <string>

namespace pointhaptics
{

/// Rows of numbers into an OutputFile, which appears under its name with commit(). One thread.
class POINTHAPTICSSCENE_EXPORT CsvWriter
{
public:
  /// @param isKept for what cannot be made again: rows stand in NAME.part within a second, and stay there
  /// where commit() is not reached (OutputFile::openKept()). False: @p message says why the file cannot be
  /// created.
  bool open(
    const std::string& fileName, const std::string& header, std::string& message, bool isKept = false);
  bool isOpen() const { return isOpen_; }
  void row(const double* values, std::size_t count);
  /// A line "# text".
  void comment(const std::string& text) { this->add("# " + text + "\n"); }
  /// False: not all could be written; commit() says why.
  bool isFine() const { return isFine_; }
  /// False: @p message says why; the target is as it was before. Closes the file in any case.
  bool commit(std::string& message);
  /// Closes the file and leaves nothing of it.
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
