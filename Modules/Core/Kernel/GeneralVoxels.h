/// @file
/// Sums of the voxels of any lattice in 128-bit integers, and those of coarser voxels made of them.
#pragma once

#include "Core/Buffer.h"
#include "Core/Executor.h"
#include "Core/Kernel/VoxelKernel.h"
#include "Core/Lattice.h"
#include "Core/Watcher.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace kernel
{

/// Sums over the points of a voxel of their places in it, in quanta.
struct VoxelSums
{
  std::uint64_t key;
  std::int64_t count;
  Int128 sums[3];
};

/// Voxels in ascending order of their keys. Seconds are empty unless asked for.
struct VoxelSumList
{
  int fractionBits = 0;
  HugeVector<VoxelSums> voxels;
  HugeVector<SecondSums> seconds;
};

/// The lattice twice as coarse, from the same corner; one voxel has no coarser one and stays as it is.
Lattice coarserLattice(const Lattice& lattice);
/// The lattice 2^@p halvings times as fine, from the same corner.
Lattice finerLattice(const Lattice& lattice, int halvings);
/// Sums of the coarser lattice's voxels, exactly those of its points; @p parents: of each fine voxel, the
/// coarse one it lies in. @return false where @p watcher, who may be none, ended the work.
bool coarserSums(const VoxelSumList& fine, const Lattice& fineLattice, const Lattice& coarseLattice,
  VoxelSumList& coarse, std::vector<std::int64_t>& parents, const Executor& executor, Watcher* watcher);

} // namespace kernel
} // namespace pointhaptics
