#include "Core/Kernel/GeneralVoxels.h"

#include "Core/RadixSort.h"

#include "Core/Kernel/PointPlacement.h"

#include <algorithm>
#include <array>
#include <atomic>

namespace pointhaptics
{
namespace kernel
{
namespace
{

constexpr std::uint64_t kOutside = ~std::uint64_t(0);

void addVoxel(VoxelSums& to, const VoxelSums& from)
{
  to.count += from.count;
  for (int axis = 0; axis < 3; ++axis)
  {
    to.sums[axis] += from.sums[axis];
  }
}

void addSecondSums(SecondSums& to, const SecondSums& from)
{
  for (int m = 0; m < 6; ++m)
  {
    to.lanes[m] += from.lanes[m];
  }
}

}

GeneralAdder::GeneralAdder(const Placement& placement, const Lattice& lattice, bool seconds)
  : placement_(placement)
  , lattice_(lattice)
  , withSeconds_(seconds)
{
  list_.fractionBits = placement.fractionBits;
}

void GeneralAdder::add(
  const PointView& points, std::int64_t first, std::int64_t count, const Executor& executor)
{
  placed_.resize(std::size_t(count));
  std::atomic<std::int64_t> invalid{ 0 };
  forRange(executor, count,
    [&](std::int64_t begin, std::int64_t end)
    {
      const std::uint64_t mask = (std::uint64_t(1) << placement_.fractionBits) - 1;
      std::int64_t bad = 0;
      for (std::int64_t i = begin; i < end; ++i)
      {
        Placed& placed = placed_[std::size_t(i)];
        const Place place = placePoint(placement_, points[first + i], placed.place);
        bad += place == Place::Invalid;
        std::int64_t index[3];
        for (int axis = 0; axis < 3; ++axis)
        {
          index[axis] = std::int64_t(placed.place[axis] >> placement_.fractionBits);
          placed.place[axis] &= mask;
        }
        placed.key = place == Place::Inside ? lattice_.key(index[0], index[1], index[2]) : kOutside;
      }
      invalid += bad;
    });
  invalid_ += invalid;
  entries_.clear();
  for (std::size_t i = 0; i < placed_.size(); ++i)
  {
    if (placed_[i].key != kOutside)
    {
      entries_.push_back({ placed_[i].key, i });
    }
  }
  inside_ += std::int64_t(entries_.size());
  otherEntries_.resize(entries_.size());
  radixSort(entries_, otherEntries_, entries_.size(), [](const Entry& entry) { return entry.key; });
  mergeEntries();
}

void GeneralAdder::mergeEntries()
{
  VoxelSumList merged;
  merged.fractionBits = list_.fractionBits;
  std::size_t old = 0;
  std::size_t i = 0;
  while (i < entries_.size() || old < list_.voxels.size())
  {
    const std::uint64_t ours = i < entries_.size() ? entries_[i].key : kOutside;
    const std::uint64_t theirs = old < list_.voxels.size() ? list_.voxels[old].key : kOutside;
    VoxelSums voxel{ std::min(ours, theirs), 0, { 0, 0, 0 } };
    SecondSums seconds{ { 0, 0, 0, 0, 0, 0 } };
    for (; i < entries_.size() && entries_[i].key == voxel.key; ++i)
    {
      const std::uint64_t* place = placed_[std::size_t(entries_[i].point)].place;
      ++voxel.count;
      for (int axis = 0; axis < 3; ++axis)
      {
        voxel.sums[axis] += Int128(place[axis]);
      }
      if (withSeconds_)
      {
        addProducts(seconds, place[0], place[1], place[2]);
      }
    }
    if (theirs == voxel.key)
    {
      addVoxel(voxel, list_.voxels[old]);
      if (withSeconds_)
      {
        addSecondSums(seconds, list_.seconds[old]);
      }
      ++old;
    }
    merged.voxels.push_back(voxel);
    if (withSeconds_)
    {
      merged.seconds.push_back(seconds);
    }
  }
  list_ = std::move(merged);
}

namespace
{

bool isOneVoxel(const Lattice& lattice)
{
  return lattice.dimensions == std::array<std::int64_t, 3>{ 1, 1, 1 };
}

}

Lattice coarserLattice(const Lattice& lattice)
{
  Lattice coarse = lattice;
  if (isOneVoxel(lattice))
  {
    return coarse;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto a = std::size_t(axis);
    coarse.dimensions[a] = (lattice.dimensions[a] + 1) / 2;
    coarse.spacing[axis] = 2.0 * lattice.spacing[axis];
    // A last voxel that had no partner reaches out of the workspace.
    coarse.end[axis] = 0.5 * std::min(lattice.end[axis], double(lattice.dimensions[a]));
  }
  return coarse;
}

namespace
{

/// One fine voxel's share of its coarse one: places move by half a coarse voxel where the index is odd.
VoxelSums shareOf(
  const VoxelSums& voxel, const std::array<std::int64_t, 3>& index, int fractionBits, std::uint64_t coarseKey)
{
  VoxelSums share{ coarseKey, voxel.count, { voxel.sums[0], voxel.sums[1], voxel.sums[2] } };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    share.sums[axis] += (Int128(voxel.count) * (index[axis] & 1)) << fractionBits;
  }
  return share;
}

SecondSums shareOfSeconds(const VoxelSums& voxel, const SecondSums& seconds,
  const std::array<std::int64_t, 3>& index, int fractionBits)
{
  const int rows[6] = { 0, 1, 2, 0, 1, 0 };
  const int columns[6] = { 0, 1, 2, 1, 2, 2 };
  SecondSums share = seconds;
  for (int m = 0; m < 6; ++m)
  {
    const UInt128 a = UInt128(index[std::size_t(rows[m])] & 1) << fractionBits;
    const UInt128 b = UInt128(index[std::size_t(columns[m])] & 1) << fractionBits;
    share.lanes[m] +=
      a * UInt128(voxel.sums[columns[m]]) + b * UInt128(voxel.sums[rows[m]]) + a * b * UInt128(voxel.count);
  }
  return share;
}

}

VoxelSumList coarserSums(const VoxelSumList& fine, const Lattice& fineLattice, const Lattice& coarseLattice,
  std::vector<std::int64_t>& parents)
{
  if (isOneVoxel(fineLattice))
  {
    parents.assign(fine.voxels.size(), 0);
    return fine;
  }
  struct Child
  {
    std::uint64_t parentKey;
    std::uint64_t voxel;
  };
  std::vector<Child> children(fine.voxels.size());
  for (std::size_t v = 0; v < children.size(); ++v)
  {
    const auto index = fineLattice.indexOf(fine.voxels[v].key);
    children[v] = { coarseLattice.key(index[0] / 2, index[1] / 2, index[2] / 2), v };
  }
  std::stable_sort(children.begin(), children.end(),
    [](const Child& a, const Child& b) { return a.parentKey < b.parentKey; });
  VoxelSumList coarse;
  coarse.fractionBits = fine.fractionBits + 1;
  parents.resize(children.size());
  for (const Child& child : children)
  {
    const VoxelSums& voxel = fine.voxels[std::size_t(child.voxel)];
    const auto index = fineLattice.indexOf(voxel.key);
    const bool isNew = coarse.voxels.empty() || coarse.voxels.back().key != child.parentKey;
    if (isNew)
    {
      coarse.voxels.push_back({ child.parentKey, 0, { 0, 0, 0 } });
    }
    addVoxel(coarse.voxels.back(), shareOf(voxel, index, fine.fractionBits, child.parentKey));
    if (!fine.seconds.empty())
    {
      if (isNew)
      {
        coarse.seconds.push_back(SecondSums{ { 0, 0, 0, 0, 0, 0 } });
      }
      addSecondSums(coarse.seconds.back(),
        shareOfSeconds(voxel, fine.seconds[std::size_t(child.voxel)], index, fine.fractionBits));
    }
    parents[std::size_t(child.voxel)] = std::int64_t(coarse.voxels.size()) - 1;
  }
  return coarse;
}

} // namespace kernel
} // namespace pointhaptics
