/// @file
/// What every format reader gets: the bytes, where to report progress, and where to name the format.
#pragma once

#include "FileProblem.h"
#include "Progress.h"

#include <string>
#include <string_view>

class vtkAlgorithm;

namespace pointhaptics::io
{

/// Part of the progress that reading the bytes takes; parsing them takes the rest.
constexpr double kReadingPart = 0.3;

/// What of a cloud is wanted.
struct WantedPart
{
  bool onlyPositions = false; ///< no arrays beside the points, where leaving them out saves work
};

/// Lives during one read, in one thread.
struct ReadTask
{
  std::string path;
  std::string_view bytes;
  bool wasPacked = false; ///< the bytes are the unpacked content of a gzip file
  WantedPart wanted;
  vtkAlgorithm* algorithm = nullptr;
  std::string format; ///< out: "PLY (binary little endian)", as soon as it is known

  /// Reports how much of the parsing is done, 0..1. @throws StoppedOnRequest when an observer asked to stop.
  void progress(double fraction) const { reportProgress(algorithm, overall(fraction)); }
  /// What part of the whole work is done when @p fraction of the parsing is.
  static double overall(double fraction) { return kReadingPart + (1.0 - kReadingPart) * fraction; }
  /// The same for reading the bytes.
  void readingProgress(double fraction) const { reportProgress(algorithm, kReadingPart * fraction); }
};

} // namespace pointhaptics::io
