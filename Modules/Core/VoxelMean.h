/// @file
/// Mean resampling: the points in each voxel of a lattice become their mean (the paper's "mean filter").
#pragma once

#include "Core/AffineTransform.h"
#include "Core/Executor.h"
#include "Core/Lattice.h"
#include "Core/PointView.h"
#include "Core/Status.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// The active voxels, in order of their keys (x fastest), and which input points lie in each.
struct VoxelMeans
{
  Lattice lattice;
  std::vector<std::uint64_t> keys;   ///< Lattice::key of each active voxel, ascending.
  std::vector<Vec3> means;           ///< Frame of the transformed cloud.
  std::vector<SymMat3> covariances;  ///< Central, divided by the count; empty unless asked for.
  std::vector<std::int64_t> members; ///< Input indices, voxel by voxel, ascending in each voxel.
  std::vector<std::int64_t> begin;   ///< Members of voxel v are [begin[v], begin[v + 1]); size voxels + 1.
  std::int64_t clippedPoints = 0;    ///< Finite points outside the lattice.
  std::int64_t invalidPoints = 0;    ///< NaN or infinite points.

  std::int64_t count(std::size_t voxel) const { return begin[voxel + 1] - begin[voxel]; }
};

/// Bounds of the transformed points that are finite before and after the transform.
Bounds transformedBounds(
  const PointView& points, const AffineTransform& transform, const Executor& executor = {});

/// Maps @p points by @p transform and averages them voxel by voxel.
/// Sums are fixed-point int64 offsets from the voxel's centre, quantum 2^-32 voxel (second moments: 128-bit),
/// so means and covariances do not depend on the order of the points or on @p executor, and a mean differs
/// from the exact mean of the transformed points by at most 2^-33 voxel plus one rounding of the coordinate,
/// and lies in its voxel. Any count below 2^31 points in one voxel is safe. Memory while running: 40 bytes a
/// point. Errors: the transform's, the lattice's; @p result is then empty. A cloud without a point inside is
/// no error here: the result has no voxels.
Status voxelMeans(const PointView& points, const AffineTransform& transform, const Lattice& lattice,
  bool withCovariances, VoxelMeans& result, const Executor& executor = {});

} // namespace pointhaptics
