/// @file
/// Sums of voxels that come in several times, in runs that are in order.
#pragma once

#include "Core/Base/Lattice.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/VoxelSink.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// Sums over the points of a voxel of their offsets in it, in quanta, below 2^85.
struct WideSums
{
  std::uint64_t key;
  std::int64_t count;
  std::uint64_t low[3];
  std::uint64_t high; ///< What stands above the low 64 bits: kHighBits for each axis.

  static constexpr int kHighBits = 21;

  void add(const WideSums& other)
  {
    count += other.count;
    high += other.high;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] += other.low[axis];
      high += std::uint64_t(low[axis] < other.low[axis]) << (kHighBits * axis);
    }
  }
  static WideSums of(const VoxelSums& voxel)
  {
    WideSums sums{ voxel.key, voxel.count, { 0, 0, 0 }, 0 };
    for (int axis = 0; axis < 3; ++axis)
    {
      sums.low[axis] = std::uint64_t(voxel.sums[axis]);
      sums.high |= std::uint64_t(voxel.sums[axis] >> 64) << (kHighBits * axis);
    }
    return sums;
  }
  VoxelSums whole() const
  {
    constexpr std::uint64_t kMask = (std::uint64_t(1) << kHighBits) - 1;
    VoxelSums sums{ key, count, { 0, 0, 0 } };
    for (int axis = 0; axis < 3; ++axis)
    {
      sums.sums[axis] = (Int128((high >> (kHighBits * axis)) & kMask) << 64) + Int128(low[axis]);
    }
    return sums;
  }
};

/// Voxels in ascending order of their keys. Second moments are empty unless asked for.
struct VoxelRun
{
  std::vector<WideSums> voxels;
  std::vector<SecondMoments> secondMoments;

  void append(const Lattice& lattice, const MomentBatch<std::int64_t>& batch);
  /// Frees memory where much of it is unused.
  void trim();
};

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
  /// Writes a range's voxels at @p offset. @p plain: not by the vector loops, which overflow earlier.
  /// @pre it is joined.
  void write(std::size_t range, const Kernels& kernels, const Lattice& lattice, bool plain, MeanArena& arena,
    std::size_t offset) const;
  void release(std::size_t range) { std::vector<VoxelRun>().swap(runs_[range]); }
  int fractionBits() const { return fractionBits_; }
  std::size_t bytes() const;

private:
  void joinLast(std::size_t range);

  int fractionBits_ = 0;
  std::vector<std::vector<VoxelRun>> runs_; ///< Of each range, each far smaller than the one before.
};

} // namespace simd
} // namespace pointhaptics
