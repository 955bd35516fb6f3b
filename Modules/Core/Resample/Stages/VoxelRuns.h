/// @file
/// Sums of voxels that come in several times, in runs that are in order.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Resample/Stages/VoxelSums.h"

#include <cstddef>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// The sums of two runs, or, with a @p sign of -1, those of the first less those of the second; without
/// voxels that have no points. @p isRight: becomes false where the second has more.
VoxelRun merged(const VoxelRun& a, const VoxelRun& b, int sign, bool& isRight);

/// One run of several whose keys ascend from one to the next; these are freed.
VoxelRun concatenated(std::vector<VoxelRun>& runs, const Executor& executor);

/// The sums of the voxels of all points so far. Runs are merged when they are of like size, so that n of them
/// take n log n time and hold little more than each voxel once.
class VoxelRuns
{
public:
  void add(VoxelRun run);
  /// Makes one run of all.
  VoxelRun& whole();
  std::size_t bytes() const;

private:
  void mergeLast();

  std::vector<VoxelRun> runs_; ///< Each far smaller than the one before.
};

} // namespace simd
} // namespace pointhaptics
