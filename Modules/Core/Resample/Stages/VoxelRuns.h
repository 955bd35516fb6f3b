/// @file
/// Sums of voxels that come in several times, in runs that are in order.
#pragma once

#include "Core/Resample/Stages/VoxelSums.h"

#include <cstddef>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// The sums of the voxels of all points so far, by ranges of keys. Runs of a range are joined when they are
/// of like size, so that n of them take n log n time and hold little more than each voxel once. Several
/// threads may work on it at once, on different ranges.
class VoxelRuns
{
public:
  void reset(std::size_t ranges, int fractionBits);
  std::size_t ranges() const { return runs_.size(); }
  void add(std::size_t range, VoxelRun run);
  /// Makes one run of all of a range.
  void join(std::size_t range);
  /// Voxels of a range. @pre it is joined.
  std::size_t size(std::size_t range) const
  {
    return runs_[range].empty() ? 0 : runs_[range][0].voxels.size();
  }
  /// @pre it is joined and not empty.
  const VoxelRun& run(std::size_t range) const { return runs_[range][0]; }
  void release(std::size_t range) { std::vector<VoxelRun>().swap(runs_[range]); }
  /// The run of a range, empty where there is none; leaves none. @pre it is joined.
  VoxelRun take(std::size_t range);
  int fractionBits() const { return fractionBits_; }
  std::size_t bytes() const;

private:
  void joinLast(std::size_t range);

  int fractionBits_ = 0;
  std::vector<std::vector<VoxelRun>> runs_; ///< Of each range, each far smaller than the one before.
};

} // namespace simd
} // namespace pointhaptics
