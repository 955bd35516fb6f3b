/// @file
/// Scenes with exact answers, hands that move over them, and what a proxy made of it.
#pragma once

#include "Core/Resample/TransformedBounds.h"
#include "Haptics/HapticScene.h"
#include "Haptics/LocalScene.h"
#include "Haptics/Proxy.h"

#include "Unit/Core/RandomClouds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace trial
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kTick = 1e-3;
constexpr double kVoxel = 1e-3 / 3;
constexpr double kSphereRadius = 0.025;
constexpr double kRingRadius = 0.025;
constexpr double kTubeRadius = 0.010;
constexpr int kPaperSmall = 47516;
constexpr int kPaperLarge = 543652;

using Scene = std::shared_ptr<const HapticScene>;
using Path = std::vector<Vec3>;

/// Ticks under random hands; POINTHAPTICS_STRESS_TICKS=1000000 for a long run.
inline int stressTicks()
{
  const char* text = std::getenv("POINTHAPTICS_STRESS_TICKS");
  const int asked = text ? std::atoi(text) : 0;
  return asked > 0 ? asked : 100000;
}

inline std::vector<Vec3> spherePoints(int n, std::uint64_t seed, double noise = 0.0)
{
  Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
  {
    const Vec3 direction = random.direction();
    points.push_back((kSphereRadius + (noise > 0.0 ? noise * random.normal() : 0.0)) * direction);
  }
  return points;
}

/// Uniform over the area of the torus about the z axis.
inline std::vector<Vec3> torusPoints(int n, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Vec3> points;
  while (int(points.size()) < n)
  {
    const double around = random.uniform(0, 2 * kPi);
    const double tube = random.uniform(0, 2 * kPi);
    const double r = kRingRadius + kTubeRadius * std::cos(tube);
    if (random.uniform(0, kRingRadius + kTubeRadius) < r)
    {
      points.emplace_back(r * std::cos(around), r * std::sin(around), kTubeRadius * std::sin(tube));
    }
  }
  return points;
}

/// A square of side 0.06 at height @p z, without what lies within @p hole of its centre.
inline std::vector<Vec3> planePoints(int n, std::uint64_t seed, double z = 0.0, double hole = 0.0)
{
  Random random(seed);
  std::vector<Vec3> points;
  while (int(points.size()) < n)
  {
    const Vec3 p = random.inBox({ -0.03, -0.03, z }, { 0.03, 0.03, z });
    if (std::hypot(p.x, p.y) >= hole)
    {
      points.push_back(p);
    }
  }
  return points;
}

/// The points themselves, without voxels.
inline Scene rawScene(const std::vector<Vec3>& points, Status* status = nullptr)
{
  HapticSceneInput input;
  input.points = points;
  Status result = Status::Ok;
  Scene scene = HapticScene::create(std::move(input), result, ThreadedExecutor(2));
  if (status)
  {
    *status = result;
  }
  return scene;
}

/// Voxel means of 1/3 mm with their covariances, after @p transform.
inline HapticSceneInput resampledInput(
  const std::vector<Vec3>& points, const AffineTransform& transform = {}, double voxel = kVoxel)
{
  const PointView view(points.data(), std::int64_t(points.size()));
  LatticeSettings settings;
  settings.voxelSize = voxel;
  VoxelRequest request;
  request.points = view;
  request.transform = transform;
  request.covariances = true;
  EXPECT_EQ(makeLattice(settings, transformedBounds(view, transform), request.lattice), Status::Ok);
  VoxelResampler voxels;
  EXPECT_EQ(voxels.run(request), Status::Ok);
  HapticSceneInput input;
  takeVoxels(voxels, request, input);
  input.corner.reset();
  return input;
}

inline Scene sceneOf(HapticSceneInput input)
{
  Status status = Status::Empty;
  Scene scene = HapticScene::create(std::move(input), status, ThreadedExecutor(2));
  EXPECT_EQ(status, Status::Ok);
  return scene;
}

inline Scene resampledScene(
  const std::vector<Vec3>& points, const AffineTransform& transform = {}, double voxel = kVoxel)
{
  return sceneOf(resampledInput(points, transform, voxel));
}

inline std::vector<ProxyState> feel(Proxy& proxy, const Path& path)
{
  std::vector<ProxyState> states;
  for (const Vec3& hip : path)
  {
    states.push_back(proxy.step(hip, kTick));
  }
  return states;
}

inline std::vector<ProxyState> feel(const Scene& scene, const HapticParameters& parameters, const Path& path)
{
  Proxy proxy(parameters);
  proxy.setScene(scene.get());
  return feel(proxy, path);
}

inline HapticParameters gradientSteps(const GradientStepsParameters& gains)
{
  HapticParameters parameters;
  parameters.method = ProxyMethod::GradientSteps;
  parameters.gradientSteps = gains;
  return parameters;
}

inline bool isFinite(const ProxyState& s)
{
  using pointhaptics::isFinite;
  return isFinite(s.proxy) && isFinite(s.normal) && isFinite(s.force) && isFinite(s.sphereCenter) &&
    std::isfinite(s.radius);
}

inline bool operator==(const ProxyState& a, const ProxyState& b)
{
  return a.proxy == b.proxy && a.normal == b.normal && a.force == b.force &&
    a.sphereCenter == b.sphereCenter && a.radius == b.radius && a.contact == b.contact &&
    a.status == b.status;
}

/// Approaches from outside along a line, then slides over the sphere on a tilted, waving course.
/// @param depth metres below the surface while sliding. @param speed along the surface, metres per second.
inline Path sphereSlide(double depth, double speed, int ticks)
{
  Path path;
  const auto direction = [](double angle)
  {
    const double tilt = 0.9 + 0.4 * std::sin(1.7 * angle);
    return Vec3(std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), std::cos(tilt));
  };
  for (int i = 0; i < 100; ++i)
  {
    path.push_back((kSphereRadius + 0.003 - (0.003 + depth) * i / 100) * direction(0.0));
  }
  for (int i = 0; i < ticks; ++i)
  {
    path.push_back((kSphereRadius - depth) * direction(i * kTick * speed / kSphereRadius));
  }
  return path;
}

/// Slides around the tube while going around the ring, at depth 1 mm, closed after one turn of the ring.
inline Vec3 torusCourse(double angle)
{
  const double tube = 0.8 + 1.5 * std::sin(angle);
  const double r = kRingRadius + (kTubeRadius - 1e-3) * std::cos(tube);
  return { r * std::cos(angle), r * std::sin(angle), (kTubeRadius - 1e-3) * std::sin(tube) };
}

/// From outside to the course's start, then @p turns closed turns of @p ticks ticks each.
inline Path closedPath(Vec3 (*course)(double), const Vec3& outside, int ticks, int turns)
{
  Path path;
  for (int i = 0; i < 200; ++i)
  {
    path.push_back(outside + (i / 200.0) * (course(0.0) - outside));
  }
  for (int i = 0; i <= ticks * turns; ++i)
  {
    path.push_back(course(2 * kPi * i / ticks));
  }
  return path;
}

/// Down to @p depth below the plane z = 0, then along x at @p speed.
inline Path planeSlide(double depth, double speed, int ticks)
{
  Path path;
  for (int i = 0; i <= 100; ++i)
  {
    path.emplace_back(-0.02, 0.001, 0.002 - (0.002 + depth) * i / 100);
  }
  for (int i = 1; i <= ticks; ++i)
  {
    path.emplace_back(-0.02 + i * kTick * speed, 0.001, -depth);
  }
  return path;
}

/// Exact force of a spring of 800 N/m on the outside of the sphere.
inline Vec3 sphereForce(const Vec3& hip)
{
  const double depth = kSphereRadius - norm(hip);
  return depth > 0.0 ? 800.0 * depth * normalized(hip) : Vec3();
}

inline Vec3 torusForce(const Vec3& hip)
{
  const Vec3 ring = kRingRadius * normalized({ hip.x, hip.y, 0 });
  const double depth = kTubeRadius - norm(hip - ring);
  return depth > 0.0 ? 800.0 * depth * normalized(hip - ring) : Vec3();
}

/// RMS of |force - exact| over RMS of |exact|, of ticks from @p first on.
inline double forceError(
  const std::vector<ProxyState>& states, const std::function<Vec3(const Vec3&)>& exact, std::size_t first = 0)
{
  double error = 0.0;
  double scale = 0.0;
  for (std::size_t i = first; i < states.size(); ++i)
  {
    error += norm2(states[i].force - exact(states[i].hip));
    scale += norm2(exact(states[i].hip));
  }
  return std::sqrt(error / scale);
}

/// Writes a figure into the test's record and returns it.
inline double recorded(const char* name, double value)
{
  ::testing::Test::RecordProperty(name, std::to_string(value));
  std::printf("[ figure   ] %s = %.3g\n", name, value);
  return value;
}

} // namespace trial
} // namespace pointhaptics
