/// @file
/// Exact sums of the points of voxels, and how they are merged where they come in several times.
#pragma once

#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/VoxelTally.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics::simd
{

/// Sums over the points of a voxel of their offsets in it, in quanta: below 2^85.
struct WideSums
{
  std::uint64_t key;
  std::int64_t count;
  std::uint64_t low[3];
  std::uint64_t high; ///< Bits above the low 64: kHighBits for each axis.

  static constexpr int kHighBits = 21;

  static WideSums of(std::uint64_t key, const PackedSums& packed)
  {
    return { key, packedCount(packed), { packed.lanes[0], packed.lanes[1], std::uint64_t(packedZ(packed)) },
      0 };
  }
  Int128 sum(int axis) const
  {
    constexpr std::uint64_t kMask = (std::uint64_t(1) << kHighBits) - 1;
    return (Int128((high >> (kHighBits * axis)) & kMask) << 64) + Int128(low[axis]);
  }
  /// Adds to a sum.
  void add(int axis, std::uint64_t bits)
  {
    low[axis] += bits;
    high += std::uint64_t(low[axis] < bits) << (kHighBits * axis);
  }
  void add(const WideSums& other)
  {
    count += other.count;
    high += other.high;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->add(axis, other.low[axis]);
    }
  }
  /// Rounded.
  std::array<double, 3> sums() const { return { double(sum(0)), double(sum(1)), double(sum(2)) }; }
};

/// Voxels in ascending order of their keys. Second moments are empty unless asked for, and tallies, one for
/// each array, unless arrays are accumulated.
struct VoxelRun
{
  std::vector<WideSums> voxels;
  std::vector<SecondMoments> secondMoments;
  std::vector<VoxelTally> tallies;

  std::size_t size() const { return voxels.size(); }
  bool hasMoments() const { return !secondMoments.empty(); }
  /// The first voxel with a key of at least @p key.
  std::size_t find(std::uint64_t key) const
  {
    return std::size_t(std::lower_bound(voxels.begin(), voxels.end(), key,
                         [](const WideSums& voxel, std::uint64_t k) { return voxel.key < k; }) -
      voxels.begin());
  }
  /// Appends the sums of voxel @p i of @p a and voxel @p j of @p b, the same voxel; either may be null.
  void append(const VoxelRun* a, std::size_t i, const VoxelRun* b, std::size_t j);
  /// Appends the voxels from @p first to before @p last of a run whose keys are above all here.
  void append(const VoxelRun& run, std::size_t first, std::size_t last);
};

/// The sums of the voxels of all points so far. Runs are merged when they are of like size, so that n of them
/// take n log n time and hold little more than each voxel once.
class VoxelRuns
{
public:
  /// Where it throws, nothing is added. Too little memory to merge is no error here.
  void add(VoxelRun&& run);
  /// Makes one run of all. Where it throws, the sums are unchanged.
  VoxelRun& whole();

private:
  void mergeLast();

  std::vector<VoxelRun> runs_; ///< Each far smaller than the one before, where there was memory to merge.
};

} // namespace pointhaptics::simd
