#include "Core/VoxelMean.h"

#include "Core/VoxelResampler.h"

#include <mutex>

namespace pointhaptics
{

Bounds transformedBounds(const PointView& points, const AffineTransform& transform, const Executor& executor)
{
  Bounds box;
  std::mutex mutex;
  forRange(executor, points.size(),
    [&](std::int64_t begin, std::int64_t end)
    {
      Bounds local;
      for (std::int64_t i = begin; i < end; ++i)
      {
        const Vec3 p = points[i];
        const Vec3 moved = transform.apply(p);
        if (isFinite(p) && isFinite(moved))
        {
          local.include(moved);
        }
      }
      if (!local.empty())
      {
        const std::lock_guard<std::mutex> lock(mutex);
        box.include(local.minimum);
        box.include(local.maximum);
      }
    });
  return box;
}

Status voxelMeans(const PointView& points, const AffineTransform& transform, const Lattice& lattice,
  bool withCovariances, VoxelMeans& result, const Executor& executor)
{
  result = VoxelMeans();
  VoxelRequest request;
  request.points = points;
  request.transform = transform;
  request.lattice = lattice;
  request.covariances = withCovariances;
  request.keys = true;
  VoxelResampler resampler;
  const Status status = resampler.run(request, executor);
  if (status != Status::Ok)
  {
    return status;
  }
  const auto size = std::size_t(resampler.size());
  result.lattice = lattice;
  result.keys.resize(size);
  result.means.resize(size);
  result.counts.resize(size);
  resampler.copyKeys(0, result.keys.data(), executor);
  resampler.copyMeans(0, size ? &result.means.front().x : nullptr, executor);
  resampler.copyCounts(0, result.counts.data(), executor);
  if (withCovariances)
  {
    result.covariances.resize(size);
    resampler.copyCovariances(0, result.covariances.data(), executor);
  }
  result.clippedPoints = resampler.clippedPoints();
  result.invalidPoints = resampler.invalidPoints();
  return Status::Ok;
}

} // namespace pointhaptics
