/// @file
/// Quantizing points: the constants for a transform and a lattice, and one point by plain code.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Lattice.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

#include <cstdint>

namespace pointhaptics::simd
{

/// Bits that index the voxels of a lattice's longest axis.
int indexBitsOf(const Lattice& lattice);
/// Lattices with more index bits use all fraction bits of a double for positions. Rounding could then cost a
/// quarter of a quantum beside the quantum (2^-31 voxel) that truncation costs: it is corrected.
constexpr int kUncorrectedIndexBits = 20;
/// Bits of an offset in a voxel: those that an index leaves of kPositionBits, or of all of a double's on
/// lattices too fine for those.
int fractionBitsOf(const Lattice& lattice);

/// Leaves blocksPerLayer, rowShift and layerShift, which come from a PartitionPlan, to the caller.
PointQuantizer makeQuantizer(const AffineTransform& transform, const Lattice& lattice);

/// False where the vector loops' division by way of the reciprocal could under- or overflow.
bool hasOrdinarySpacing(const Lattice& lattice);

enum class PointLocation
{
  Inside,
  Outside,
  Invalid, ///< Not finite, before or after the transform.
};
/// Quantizes a point: voxel index << fractionBits | offset in the voxel. The vector loops give the same
/// bits.
PointLocation quantizePoint(const PointQuantizer& quantizer, const Vec3& point, std::uint64_t position[3]);

} // namespace pointhaptics::simd
