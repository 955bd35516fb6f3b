/// @file
/// Voxels of coarser lattices: exact sums of the finer voxels, without another pass over the points.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Resample/Stages/VoxelRuns.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// Sums the voxels of the lattice twice as coarse as @p lattice, whose voxels are @p fine, in ranges of whole
/// layers. @return false where @p observer, which may be null, ended the work. @pre all ranges are joined
bool sumCoarseVoxels(const VoxelRuns& fine, const Lattice& lattice, VoxelRuns& coarse,
  const Executor& executor, ProgressObserver* observer);

/// Of each fine voxel, the position of the coarse one it lies in. Keys ascend. @return false where
/// @p observer, which may be null, ended the work.
bool findParents(const std::uint64_t* fineKeys, std::int64_t fineVoxels, const Lattice& fine,
  const std::uint64_t* coarseKeys, std::int64_t coarseVoxels, std::vector<std::int64_t>& parents,
  const Executor& executor, ProgressObserver* observer);

} // namespace simd
} // namespace pointhaptics
