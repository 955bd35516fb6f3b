/// @file
/// A table of numbers as text, shortest digits that read back to the same doubles; it appears only when
/// complete.
#pragma once

#include "Core/Base/OutputFile.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <string>

namespace pointhaptics
{

/// Rows of numbers into an OutputFile: without commit() nothing is left behind.
class POINTHAPTICSSCENE_EXPORT CsvWriter
{
public:
  /// False: @p message says why the file cannot be created.
  bool open(const std::string& fileName, const std::string& header, std::string& message);
  void row(const double* values, std::size_t count);
  /// False: @p message says why; the target is as it was before.
  bool commit(std::string& message);

private:
  std::string fileName_;
  OutputFile file_;
  std::string line_;
};

} // namespace pointhaptics
