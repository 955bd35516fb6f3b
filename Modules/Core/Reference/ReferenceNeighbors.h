/// @file
/// Neighbours by looking at every point. The oracle of tests and benchmarks; not installed.
#pragma once

#include "Core/Base/PointView.h"
#include "Core/Neighbors/NeighborQuery.h"

#include <algorithm>
#include <vector>

namespace pointhaptics
{
namespace reference
{

/// All finite points by distance from @p center, ties by index.
inline std::vector<Neighbor> neighborsByDistance(const PointView& points, const Vec3& center)
{
  std::vector<Neighbor> all;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    if (isFinite(points[i]))
    {
      all.push_back({ norm2(points[i] - center), i });
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

inline std::vector<Neighbor> nearest(const PointView& points, const Vec3& center, std::size_t k)
{
  std::vector<Neighbor> all = neighborsByDistance(points, center);
  all.resize(std::min(k, all.size()));
  return all;
}

} // namespace reference
} // namespace pointhaptics
