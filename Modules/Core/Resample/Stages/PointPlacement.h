/// @file
/// From a transform and a lattice to the numbers that place points, and one point placed the plain way.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Lattice.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

#include <cstdint>

namespace pointhaptics
{
namespace kernel
{

/// Bits that index the voxels of a lattice's longest axis.
int indexBitsOf(const Lattice& lattice);
/// Where a lattice has more than so many, positions use all bits of a double below the point, and rounding
/// can be worth a quarter of a quantum more than the quantum, 2^-31 voxel, that cutting is: it is corrected.
constexpr int kUncorrectedIndexBits = 20;
/// Bits of a position: kPositionBits, or all of a double's on lattices too fine for those.
int positionBitsFor(int indexBits);

/// Leaves rowsPerLayer and rowShift to whoever plans the partitions.
Placement makePlacement(
  const AffineTransform& transform, const Lattice& lattice, int indexBits, int positionBits);

/// False where the vector loops' division by way of the reciprocal could under- or overflow.
bool hasOrdinarySpacing(const Lattice& lattice);

enum class Place
{
  Inside,
  Outside,
  Invalid, ///< Not finite, before or after the transform.
};
/// The position of a point: voxel index << fractionBits | place in the voxel. The vector loops give the same
/// bits.
Place placePoint(const Placement& placement, const Vec3& point, std::uint64_t position[3]);

} // namespace kernel
} // namespace pointhaptics
