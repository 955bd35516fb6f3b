/// @file
/// Neighbours by looking at every point. The oracle of tests and benchmarks; not installed.
#pragma once

#include "Core/Base/PointView.h"
#include "Core/Neighbors/NeighborQuery.h"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

namespace pointhaptics
{
namespace reference
{

/// All finite places by distance from @p center, ties by index, each under its first point's.
inline std::vector<Neighbor> neighborsByDistance(const PointView& points, const Vec3& center)
{
  std::set<std::array<double, 3>> places;
  std::vector<Neighbor> all;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p = points[i];
    if (isFinite(p) && places.insert({ p.x, p.y, p.z }).second)
    {
      all.push_back({ norm2(p - center), i });
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
