/// @file
/// The sums of an accumulator. Private to Core.
#pragma once

#include "Core/Resample/Stages/VoxelRun.h"
#include "Core/Resample/VoxelAccumulator.h"

#include <cstddef>
#include <cstdint>

namespace pointhaptics
{

/// Points: all, and of these the ones that are in no voxel.
struct PointCounts
{
  std::int64_t points = 0;
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;

  void add(const PointCounts& more, int sign = 1)
  {
    points += sign * more.points;
    clipped += sign * more.clipped;
    invalid += sign * more.invalid;
  }
};

/// Sums of the points of some calls.
class VoxelAccumulator::Sums
{
public:
  /// Voxels of the whole run from @p first to before @p last, and their points.
  struct Range
  {
    std::size_t first;
    std::size_t last;
    PointCounts counts;
  };
  /// See VoxelAccumulator::part().
  Range range(std::uint64_t firstKey, std::uint64_t endKey);

  simd::VoxelRuns runs;
  PointCounts counts;
};

} // namespace pointhaptics
