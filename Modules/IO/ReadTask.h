/// @file
/// What every format reader gets: the bytes, where to report progress, and where to name the format.
#pragma once

#include "FileProblem.h"

#include "vtkAlgorithm.h"
#include "vtkType.h"

#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// Rows between two progress reports: a few reports per 100,000 points.
constexpr vtkIdType kProgressRows = 32768;

/// Part of the progress that reading the bytes takes; parsing them takes the rest.
constexpr double kReadingPart = 0.3;

/// Lives during one read, in one thread.
struct ReadTask
{
  std::string path;
  std::string_view bytes;
  bool wasPacked = false; ///< the bytes are the unpacked content of a gzip file
  vtkAlgorithm* algorithm = nullptr;
  std::string format; ///< out: "PLY (binary little endian)", as soon as it is known

  /// Reports how much of the parsing is done, 0..1. @throws ReadingStopped when an observer asked to stop.
  void progress(double fraction) const { report(kReadingPart + (1.0 - kReadingPart) * fraction); }
  /// The same for reading the bytes.
  void readingProgress(double fraction) const { report(kReadingPart * fraction); }

private:
  void report(double fraction) const
  {
    algorithm->UpdateProgress(fraction);
    if (algorithm->GetAbortExecute())
    {
      throw ReadingStopped();
    }
  }
};

} // namespace pointhaptics::io
