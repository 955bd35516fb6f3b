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

/// The sums of two runs.
VoxelRun merged(const VoxelRun& a, const VoxelRun& b);
/// The sums of a run less those of another, without voxels that have no points left. @return false where the
/// other one has more.
bool subtracted(const VoxelRun& from, const VoxelRun& run, VoxelRun& difference);

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
