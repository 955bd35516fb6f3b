/// @file
/// The constants that quantize points, for a transform and a lattice.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Lattice.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

namespace pointhaptics::simd
{

/// Bits that index the voxels of a lattice's longest axis; at least kMinimumIndexBits.
int indexBitsOf(const Lattice& lattice);
/// Bits of an offset in a voxel: those that an index leaves of kPositionBits, or of all of a double's on
/// fine lattices.
int fractionBitsOf(const Lattice& lattice);

/// Leaves blocksPerLayer, rowShift and layerShift, which come from a PartitionPlan, to the caller.
PointQuantizer makeQuantizer(const AffineTransform& transform, const Lattice& lattice);

/// False where the vector loops' division by way of the reciprocal could under- or overflow.
bool hasOrdinarySpacing(const Lattice& lattice);

} // namespace pointhaptics::simd
