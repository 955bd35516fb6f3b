/// @file
/// Exact sums of voxels' points: whole, and in as few words as they need.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/VoxelTally.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace pointhaptics
{
namespace simd
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
  /// Adds the low and the high bits of a sum.
  void add(int axis, std::uint64_t lowBits, std::uint64_t highBits)
  {
    low[axis] += lowBits;
    high += (highBits + std::uint64_t(low[axis] < lowBits)) << (kHighBits * axis);
  }
  void add(const WideSums& other)
  {
    count += other.count;
    high += other.high;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->add(axis, other.low[axis], 0);
    }
  }
  /// Takes another's sums away. @return false where that leaves less than nothing.
  bool subtract(const WideSums& other)
  {
    count -= other.count;
    bool isRight = count >= 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Int128 left = sum(axis) - other.sum(axis);
      isRight = isRight && left >= 0 && (count > 0 || left == 0);
      const Int128 less = -other.sum(axis);
      this->add(axis, std::uint64_t(less), std::uint64_t(less >> 64));
    }
    return isRight;
  }
  /// Rounded.
  std::array<double, 3> sums() const { return { double(sum(0)), double(sum(1)), double(sum(2)) }; }
};

inline void add(SecondMoments& to, const SecondMoments& moments, int sign = 1)
{
  for (int m = 0; m < 6; ++m)
  {
    to.lanes[m] += sign > 0 ? moments.lanes[m] : -moments.lanes[m];
  }
}

/// Voxels in ascending order of their keys. Second moments are empty unless asked for, and tallies, one for
/// each array, unless arrays are accumulated.
struct VoxelRun
{
  PageVector<WideSums> voxels;
  PageVector<SecondMoments> secondMoments;
  std::vector<VoxelTally> tallies;

  std::size_t size() const { return voxels.size(); }
  bool hasMoments() const { return !secondMoments.empty(); }
  /// Second moments of a voxel; null unless requested.
  const SecondMoments* momentsOf(std::size_t voxel) const
  {
    return hasMoments() ? secondMoments.data() + voxel : nullptr;
  }
  /// The first voxel with a key of at least @p key.
  std::size_t find(std::uint64_t key) const
  {
    return std::size_t(std::lower_bound(voxels.begin(), voxels.end(), key,
                         [](const WideSums& voxel, std::uint64_t k) { return voxel.key < k; }) -
      voxels.begin());
  }
  void reserve(std::size_t size, bool withMoments)
  {
    voxels.reserve(size);
    secondMoments.reserve(withMoments ? size : 0);
  }
  /// Appends voxels without points, keys and what arrays have.
  void append(std::size_t size, bool withMoments)
  {
    voxels.resize(voxels.size() + size, WideSums{});
    secondMoments.resize(secondMoments.size() + (withMoments ? size : 0), SecondMoments{});
  }
  /// Adds the offsets of a point to a voxel.
  void addPoint(std::size_t voxel, const std::array<std::uint64_t, 3>& offset)
  {
    WideSums& sums = voxels[voxel];
    ++sums.count;
    for (int axis = 0; axis < 3; ++axis)
    {
      sums.add(axis, offset[std::size_t(axis)], 0);
    }
    if (hasMoments())
    {
      addProducts(secondMoments[voxel], offset[0], offset[1], offset[2]);
    }
  }
  void push(const WideSums& sums, const SecondMoments* moments)
  {
    voxels.push_back(sums);
    if (moments)
    {
      secondMoments.push_back(*moments);
    }
  }
  /// Drops the last voxel.
  void pop()
  {
    voxels.pop_back();
    secondMoments.resize(hasMoments() ? voxels.size() : 0);
  }
  /// Adds to the last voxel, or with a @p sign of -1 takes from it. @return false where that leaves less than
  /// nothing.
  bool addToLast(const WideSums& sums, const SecondMoments* moments, int sign = 1)
  {
    if (moments)
    {
      add(secondMoments.back(), *moments, sign);
    }
    return sign > 0 ? (voxels.back().add(sums), true) : voxels.back().subtract(sums);
  }
  /// Appends voxels @p first to before @p last of another run.
  void append(const VoxelRun& from, std::size_t first, std::size_t last)
  {
    const auto copy = [=](const auto& source, auto& to)
    {
      const auto begin = source.begin();
      to.insert(to.end(), begin + std::ptrdiff_t(first), begin + std::ptrdiff_t(last));
    };
    copy(from.voxels, voxels);
    if (from.hasMoments())
    {
      copy(from.secondMoments, secondMoments);
    }
    appendTallies(from, first, last);
  }
  /// Appends only the tallies of the arrays.
  void appendTallies(const VoxelRun& from, std::size_t first, std::size_t last)
  {
    tallies.resize(std::max(tallies.size(), from.tallies.size())); // A run without voxels has none.
    for (std::size_t i = 0; i < from.tallies.size(); ++i)
    {
      tallies[i].append(from.tallies[i], first, last);
    }
  }
  /// Gathers the tallies of groups of the voxels of two runs. @p isRight: see TallySums::gathered().
  void gatherTallies(const VoxelRun& from, const VoxelRun& other, const VoxelGroups& groups, bool& isRight)
  {
    const auto of = [](const VoxelRun& run, std::size_t i)
    { return run.tallies.empty() ? nullptr : run.tallies.data() + i; };
    const std::size_t arrays = std::max(from.tallies.size(), other.tallies.size());
    for (std::size_t i = 0; i < arrays; ++i)
    {
      tallies.push_back(VoxelTally::gathered(of(from, i), of(other, i), groups, isRight));
    }
  }
  void clear()
  {
    voxels.clear();
    secondMoments.clear();
    tallies.clear();
  }
  /// Frees memory where much of it is unused.
  void trim()
  {
    if (voxels.capacity() > voxels.size() + voxels.size() / 32)
    {
      voxels.shrink_to_fit();
      secondMoments.shrink_to_fit();
    }
  }
  std::size_t bytes() const
  {
    return std::accumulate(tallies.begin(), tallies.end(),
      voxels.capacity() * sizeof(WideSums) + secondMoments.capacity() * sizeof(SecondMoments),
      [](std::size_t sum, const VoxelTally& tally) { return sum + tally.bytes(); });
  }
};

} // namespace simd
} // namespace pointhaptics
