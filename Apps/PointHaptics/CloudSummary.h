/// @file
/// What `pointhaptics info` says of a cloud.
#pragma once

#include "Pipeline.h"

#include "Core/PointView.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace app
{

struct ArraySummary
{
  std::string name;
  std::string type;
  int components = 1;
  std::vector<double> minima; ///< One a component, of the finite values; empty where there are none.
  std::vector<double> maxima;
};

struct CloudSummary
{
  std::string format;
  std::int64_t points = 0;
  std::int64_t invalid = 0; ///< NaN or infinite.
  Bounds bounds;            ///< Of the finite points.
  double spacing = 0.0;     ///< Median distance to the nearest distinct point, of a sample of the points.
  std::vector<ArraySummary> arrays;
  std::string hint;            ///< Unit or scale to try where the size is not about that of the workspace.
  double suggestedScale = 1.0; ///< Makes the cloud fill most of the workspace.
};

/// Cost: O(n log n) for the spacing, 48 bytes a point up to 4 million points.
CloudSummary summarize(const Cloud& cloud);

} // namespace app
} // namespace pointhaptics
