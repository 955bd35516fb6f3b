/// @file
/// Voxels of coarser lattices: exact sums of the finer voxels, without another pass over the points.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Resample/Stages/VoxelSums.h"

namespace pointhaptics
{
namespace simd
{

/// Sums the voxels of the lattice twice as coarse as @p lattice, whose voxels are @p fine, with offsets of
/// @p fractionBits bits. @return false where @p observer, which may be null, ended the work. @pre the lattice
/// has several voxels
bool sumCoarseVoxels(const VoxelRun& fine, const Lattice& lattice, int fractionBits, VoxelRun& coarse,
  const Executor& executor, ProgressObserver* observer);

} // namespace simd
} // namespace pointhaptics
