/// @file
/// Mean resampling the slow way: long double, one ordered map. The oracle of tests and benchmarks; not
/// installed.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/PointView.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
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

/// The member of a voxel nearest to its mean, or to @p center if that is not null. Squared distances are
/// exact where long double holds them: coordinates with few digits. Of several the first in the order of
/// places, then of @p values, one a point, then of numbers.
inline std::int64_t nearestMember(const PointView& points, const AffineTransform& transform,
  const Voxel& voxel, const Vec3* center, const std::vector<int>& values)
{
  using Wide = long double;
  const Wide n = center ? 1 : Wide(voxel.members.size());
  Wide target[3] = { 0, 0, 0 };
  for (const std::int64_t i : voxel.members)
  {
    const Vec3 p = transform.apply(points[i]);
    for (int axis = 0; axis < 3; ++axis)
    {
      target[axis] = center ? Wide((*center)[axis]) : target[axis] + Wide(p[axis]);
    }
  }
  const auto rank = [&](std::int64_t i)
  {
    const Vec3 p = transform.apply(points[i]);
    Wide distance = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Wide difference = n * Wide(p[axis]) - target[axis];
      distance += difference * difference;
    }
    return std::make_tuple(distance, p.x, p.y, p.z, values[std::size_t(i)], i);
  };
  return *std::min_element(voxel.members.begin(), voxel.members.end(),
    [&](std::int64_t a, std::int64_t b) { return rank(a) < rank(b); });
}

/// The median of the members' transformed coordinates on @p axis, of an even number the lower middle one.
inline double medianOf(
  const PointView& points, const AffineTransform& transform, const Voxel& voxel, int axis)
{
  std::vector<double> coordinates;
  for (const std::int64_t i : voxel.members)
  {
    coordinates.push_back(transform.apply(points[i])[axis]);
  }
  std::sort(coordinates.begin(), coordinates.end());
  return coordinates[(coordinates.size() - 1) / 2];
}

} // namespace reference
} // namespace pointhaptics
