#include "Core/Kernel/GeneralVoxels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointhaptics
{
namespace kernel
{
namespace
{

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

Lattice finerLattice(const Lattice& lattice, int halvings)
{
  Lattice fine = lattice;
  for (int axis = 0; axis < 3; ++axis)
  {
    fine.dimensions[std::size_t(axis)] = lattice.dimensions[std::size_t(axis)] << halvings;
    fine.spacing[axis] = std::ldexp(lattice.spacing[axis], -halvings);
    fine.end[axis] = std::ldexp(lattice.end[axis], halvings);
  }
  return fine;
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
