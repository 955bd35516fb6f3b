#include "Benchmark/Proxy/Scenes.h"

#include "SmpExecutor.h"

#include "Core/Bandwidth/LocalBandwidth.h"
#include "Core/Neighbors/NeighborQuery.h"
#include "Core/Resample/TransformedBounds.h"
#include "Haptics/LocalScene.h"

#include <fmt/format.h>

#include <algorithm>

namespace pointhaptics::bench::proxy
{
namespace
{

constexpr std::uint64_t kSceneSeed = 7;
constexpr double kFittedSide = 0.095;

/// False: the lattice cannot be had.
bool resample(const std::vector<Vec3>& points, const SceneSettings& settings, HapticSceneInput& input)
{
  const PointView view(points.data(), std::int64_t(points.size()));
  LatticeSettings latticeSettings;
  latticeSettings.voxelSize = settings.voxelSize;
  VoxelRequest request;
  request.points = view;
  request.transform = settings.transform;
  request.covariances = settings.covariances;
  VoxelResampler voxels;
  if (makeLattice(latticeSettings, transformedBounds(view, settings.transform), request.lattice) !=
      Status::Ok ||
    voxels.run(request, SmpExecutor()) != Status::Ok)
  {
    return false;
  }
  takeVoxels(voxels, request, input);
  input.corner.reset();
  return true;
}

} // namespace

Scene sceneOf(const std::vector<Vec3>& points, const SceneSettings& settings)
{
  HapticSceneInput input;
  input.modelToWorkspace = settings.transform;
  if (settings.raw)
  {
    input.points.reserve(points.size());
    for (const Vec3& p : points)
    {
      input.points.push_back(settings.transform.apply(p));
    }
  }
  else if (!resample(points, settings, input))
  {
    return nullptr;
  }
  auto origin = std::make_shared<SceneOrigin>();
  origin->bandwidth.emplace();
  input.origin = std::move(origin);
  // The proxy's radius from the bandwidth, as the program does.
  const PointView felt(input.points.data(), std::int64_t(input.points.size()));
  NeighborQuery query;
  const SmpExecutor executor;
  query.build(felt, executor);
  std::vector<double> bandwidths;
  Status status = localBandwidths(felt, input.counts, query, {}, bandwidths, input.proxyRadii, executor);
  return status == Status::Ok ? HapticScene::create(std::move(input), status, executor) : nullptr;
}

std::vector<Vec3> pointsOf(Shape shape, std::int64_t count, double noise)
{
  std::vector<Vec3> points;
  static_cast<void>(generateShape(shape, count, kSceneSeed, noise, points));
  return points;
}

std::vector<Vec3> fitted(std::vector<Vec3> points)
{
  Bounds box;
  for (const Vec3& p : points)
  {
    if (isFinite(p))
    {
      box.include(p);
    }
  }
  const Vec3 extent = box.extent();
  const double scale = kFittedSide / std::max({ extent.x, extent.y, extent.z });
  const Vec3 middle = 0.5 * (box.minimum + box.maximum);
  for (Vec3& p : points)
  {
    p = scale * (p - middle);
  }
  return points;
}

std::string noiseName(double noise)
{
  return noise > 0.0 ? fmt::format("{:.0f} um", 1e6 * noise) : "clean";
}

} // namespace pointhaptics::bench::proxy
