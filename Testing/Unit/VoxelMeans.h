/// @file
/// Mean resampling in one call, for tests.
#pragma once

#include "Core/Resample/TransformedBounds.h"
#include "Core/Resample/VoxelResampler.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// The voxels with at least one point, in order of their keys.
struct VoxelMeans
{
  std::vector<std::uint64_t> keys;
  std::vector<Vec3> means;
  std::vector<std::int64_t> counts;
  std::vector<SymMat3> covariances; ///< Empty unless asked for.
  std::int64_t clippedPoints = 0;
  std::int64_t invalidPoints = 0;
};

inline Status voxelMeans(const PointView& points, const AffineTransform& transform, const Lattice& lattice,
  bool withCovariances, VoxelMeans& result, const Executor& executor = {})
{
  VoxelRequest request;
  request.points = points;
  request.transform = transform;
  request.lattice = lattice;
  request.covariances = withCovariances;
  request.keys = true;
  VoxelResampler voxels;
  const Status status = voxels.run(request, executor);
  const auto taken = [&](const auto* from) { return std::vector(from, from + voxels.size()); };
  result = VoxelMeans();
  if (status == Status::Ok && voxels.size() > 0)
  {
    result.keys = taken(voxels.keys());
    result.means = taken(reinterpret_cast<const Vec3*>(voxels.doubles()));
    result.counts = taken(voxels.counts());
    result.covariances = withCovariances ? taken(voxels.covariances()) : result.covariances;
  }
  result.clippedPoints = voxels.clippedPoints();
  result.invalidPoints = voxels.invalidPoints();
  return status;
}

} // namespace pointhaptics
