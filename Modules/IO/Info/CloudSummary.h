/// @file
/// Summary of a cloud, as `pointhaptics info` prints it.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsIOModule.h" // For export macro

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics
{

struct ArraySummary
{
  std::string name;
  std::string type;
  int components = 1;
  std::vector<double> minima; ///< One a component, of the finite values; NaN where there are none.
  std::vector<double> maxima;
  std::vector<double> means;      ///< Mean of each component; empty unless statistics are asked for.
  std::vector<double> deviations; ///< Standard deviation of all values, not of a sample.
};

struct ScanSummary
{
  std::string name;
  std::int64_t points = 0;
  std::array<double, 7> pose{}; ///< Where the scanner stood, x y z, and its quaternion w x y z.
};

struct CloudSummary
{
  std::string format;      ///< With the version, where files of it have one.
  std::string generator;   ///< The program that wrote the file; empty where it does not say.
  std::int64_t chunks = 0; ///< Parts that are packed one by one; 0 where there are none.
  std::vector<ScanSummary> scans;
  std::vector<std::string> notes; ///< Parts of the file that this does not tell.
  std::int64_t points = 0;
  std::int64_t invalid = 0;    ///< NaN or infinite.
  std::int64_t noReturns = 0;  ///< At exactly (0, 0, 0), where areNoReturns().
  Bounds bounds;               ///< Bounds of the finite points.
  bool isFloat = false;        ///< Coordinates have the digits of a float.
  std::int64_t duplicates = 0; ///< Finite points at the very place of an earlier one.
  /// Distance to the nearest distinct point, of a sample of the points: what 5, 25, 50, 75 and 95 percent of
  /// them do not exceed. Zero where there are no two places.
  std::array<double, 5> spacing{};
  /// Spacing where the points are sparse over that where they are dense: the medians of that distance about
  /// places which 95 and 5 percent of the surface do not exceed. 1 on a grid, about 1 of points at random.
  double densityVariation = 0.0;
  double suggestedVoxel =
    0.0; ///< Edge of a voxel that holds a few points of a surface at the median spacing.
  std::string coordinateSystem; ///< As the file says it.
  std::string unit;             ///< As --unit takes it, or "deg": of the file, or a guess; an unknown one as
                                ///< the file says it.
  bool unitIsGuess = true;
  bool unitIsTold = true; ///< False: nothing tells the unit, and metres are taken.
  std::vector<ArraySummary> arrays;
  ArraySummary coordinates;    ///< x, y and z; without components unless statistics are asked for.
  std::string farPoints;       ///< Note on a few points far from all others, and how to leave them out; or
                               ///< empty.
  std::string hint;            ///< Unit or scale to try where the size is not about that of the workspace.
  double suggestedScale = 1.0; ///< Makes the cloud fill most of the workspace.
};

/// Percentiles that spacing holds.
constexpr std::array<int, 5> kSpacingPercents{ 5, 25, 50, 75, 95 };

/// Cost: O(n log n) for spacing and duplicates, 72 bytes a point up to 4 million points.
/// @param format as the reader calls it. @param statistics whether means and deviations are wanted.
POINTHAPTICSIO_EXPORT CloudSummary summarize(
  vtkPolyData* cloud, const std::string& format, bool statistics = false);

} // namespace pointhaptics
