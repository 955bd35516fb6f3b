/// @file
/// What is kept of points voxel by voxel: where that of each voxel lies, and loops over it.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/ProgressObserver.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// The points of each voxel become where its first one goes. @return the number of all.
inline std::int64_t countsToPlaces(std::vector<std::int64_t>& counts)
{
  std::int64_t sum = 0;
  for (std::int64_t& count : counts)
  {
    sum += std::exchange(count, sum);
  }
  return sum;
}

/// Calls work(first, last) for consecutive voxels, in slices with the points of one report, at least one
/// voxel.
/// @p ends: where the points of each voxel end. @return false where @p observer, which may be null, aborted
/// the work.
template <typename Work>
bool forVoxelSlices(
  const std::vector<std::int64_t>& ends, const Executor& executor, ProgressObserver* observer, Work&& work)
{
  PointProgress progress(observer, ends.empty() ? 0 : ends.back(), 1);
  for (auto first = ends.begin(); first != ends.end();)
  {
    const std::int64_t points = first == ends.begin() ? 0 : first[-1];
    const auto last = std::upper_bound(first + 1, ends.end(), points + kPointsPerReport);
    forRange(executor, last - first,
      [&](std::int64_t from, std::int64_t to)
      { work(first - ends.begin() + from, first - ends.begin() + to); });
    first = last;
    if (!progress.add(last[-1] - points))
    {
      return false;
    }
  }
  return true;
}

} // namespace simd
} // namespace pointhaptics
