/// @file
/// Mean resampling the slow way: long double, one ordered map. The oracle of tests and benchmarks; not
/// installed.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/PointView.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace pointhaptics
{
namespace reference
{

/// One active voxel.
struct Voxel
{
  std::vector<std::int64_t> members;
  long double mean[3] = { 0, 0, 0 };
  long double covariance[6] = { 0, 0, 0, 0, 0, 0 }; ///< xx yy zz xy yz xz, central, divided by the count.
};

/// Active voxels by key.
struct VoxelMap
{
  std::map<std::uint64_t, Voxel> voxels;
  std::int64_t clippedPoints = 0;
  std::int64_t invalidPoints = 0;
};

/// Which voxel a point is in is a question of double precision, asked of Lattice itself; everything after it
/// is exact to long double: mean of the transformed points, central second moments about that mean.
inline VoxelMap voxelMeans(const PointView& points, const AffineTransform& transform, const Lattice& lattice)
{
  using Wide = long double;
  VoxelMap result;
  const auto wide = [&](std::int64_t i, int axis)
  {
    const Vec3 p = points[i];
    const double* row = transform.m[axis];
    return Wide(row[0]) * Wide(p.x) + Wide(row[1]) * Wide(p.y) + Wide(row[2]) * Wide(p.z) + Wide(row[3]);
  };
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Vec3 moved = transform.apply(points[i]);
    if (!isFinite(points[i]) || !isFinite(moved))
    {
      ++result.invalidPoints;
      continue;
    }
    const Vec3 u = lattice.continuousIndex(moved);
    if (!lattice.contains(u))
    {
      ++result.clippedPoints;
      continue;
    }
    const std::uint64_t key = lattice.key(
      std::int64_t(std::floor(u.x)), std::int64_t(std::floor(u.y)), std::int64_t(std::floor(u.z)));
    result.voxels[key].members.push_back(i);
  }
  for (auto& entry : result.voxels)
  {
    Voxel& voxel = entry.second;
    const Wide n = Wide(voxel.members.size());
    const Wide first[3] = { wide(voxel.members[0], 0), wide(voxel.members[0], 1), wide(voxel.members[0], 2) };
    for (int axis = 0; axis < 3; ++axis)
    {
      Wide sum = 0;
      for (const std::int64_t i : voxel.members)
      {
        sum += wide(i, axis) - first[axis];
      }
      voxel.mean[axis] = first[axis] + sum / n;
    }
    for (const std::int64_t i : voxel.members)
    {
      const Wide d[3] = { wide(i, 0) - voxel.mean[0], wide(i, 1) - voxel.mean[1],
        wide(i, 2) - voxel.mean[2] };
      const Wide products[6] = { d[0] * d[0], d[1] * d[1], d[2] * d[2], d[0] * d[1], d[1] * d[2],
        d[0] * d[2] };
      for (int m = 0; m < 6; ++m)
      {
        voxel.covariance[m] += products[m] / n;
      }
    }
  }
  return result;
}

} // namespace reference
} // namespace pointhaptics
