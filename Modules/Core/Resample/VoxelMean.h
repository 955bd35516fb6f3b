/// @file
/// Mean resampling in one call, and the bounds of a transformed cloud.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/PointView.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Base/Status.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// The voxels with at least one point, in order of their keys (x fastest).
struct VoxelMeans
{
  Lattice lattice;
  std::vector<std::uint64_t> keys; ///< Lattice::key of each active voxel, ascending.
  std::vector<Vec3> means;         ///< Frame of the transformed cloud.
  std::vector<std::int64_t> counts;
  std::vector<SymMat3> covariances; ///< Central, divided by the count; empty unless asked for.
  std::int64_t clippedPoints = 0;   ///< Finite points outside the lattice.
  std::int64_t invalidPoints = 0;   ///< NaN or infinite points.
};

/// Bounds of the transformed points that are finite before and after the transform. Not valid
/// where @p observer has ended the work.
Bounds transformedBounds(const PointView& points, const AffineTransform& transform,
  const Executor& executor = {}, ProgressObserver* observer = nullptr);

/// Maps @p points by @p transform and averages them voxel by voxel, in double, with a VoxelResampler made for
/// this call. Errors: an invalid transform or lattice; @p result is then empty. A cloud without
/// a point inside is no error: the result has no voxels.
Status voxelMeans(const PointView& points, const AffineTransform& transform, const Lattice& lattice,
  bool withCovariances, VoxelMeans& result, const Executor& executor = {});

} // namespace pointhaptics
