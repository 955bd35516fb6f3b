/// Clouds without a truth: generated ones, and those of files.
#include "Benchmark/Touch/Hard/HardScenes.h"

#include "Benchmark/Proxy/Scenes.h"

#include "Core/Neighbors/LocalShape.h"
#include "Core/Neighbors/NeighborQuery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics::bench::touch::hard
{
namespace
{

constexpr std::uint64_t kWavesSeed = 5250;
constexpr double kAbove = 6e-3; ///< Where hands begin.
constexpr double kPull = 60e-3;
constexpr double kPullSpeed = 0.200;
constexpr double kNearer = 8.0;
constexpr double kFitted = 0.090;
constexpr double kWorkspaceHalf = 0.050;

struct WaveSettings
{
  double noise = 0.0;  ///< In spacings.
  double apart = 0.0;  ///< Distance of two copies, metres; the second is aside by 0.3 of it.
  double strays = 0.0; ///< Fraction of the points that lie anywhere.
};

std::vector<Vec3> waves(std::int64_t count, const WaveSettings& settings)
{
  constexpr double kWavesHalf = 0.040;
  constexpr double kAmplitude = 4e-3;
  constexpr double kLength = 30e-3;
  const double spacing = 2.0 * kWavesHalf / std::sqrt(double(count));
  detail::PortableRandom random(kWavesSeed);
  std::vector<Vec3> points;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double copy = i % 2 == 0 ? 0.0 : settings.apart;
    const double x = random.uniform(-kWavesHalf, kWavesHalf);
    const double y = random.uniform(-kWavesHalf, kWavesHalf);
    const double z = kAmplitude * std::sin(kTwoPi * x / kLength) * std::cos(kTwoPi * y / kLength);
    points.emplace_back(x + 0.3 * copy, y, z + copy + settings.noise * spacing * random.gaussian());
    if (random.uniform() < settings.strays)
    {
      points.back() = { random.uniform(-kWavesHalf, kWavesHalf), y, random.uniform(-kWavesHalf, kWavesHalf) };
    }
  }
  return points;
}

double rounded(double value, double grid)
{
  return grid > 0.0 ? grid * std::round(value / grid) : value;
}

/// Instead of a grid: floats with the coordinates of UTM, whose steps are 1/32 m to the east and 1/2 m to the
/// north.
constexpr double kFloats = -1.0;

/// Terrain of 22 m with a wall of 4 m at 1:250. @p grid of the file, metres of the place, or kFloats.
std::vector<Vec3> terrain(std::int64_t count, double grid)
{
  constexpr double kTerrainHalf = 11.0;
  constexpr double kScale = 1.0 / 250.0;
  const double east = grid == kFloats ? 1.0 / 32.0 : grid;
  const double north = grid == kFloats ? 0.5 : grid;
  detail::PortableRandom random(kWavesSeed + 1);
  std::vector<Vec3> points;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const bool isWall = i % 8 == 0;
    const double x = isWall ? 2.0 : random.uniform(-kTerrainHalf, kTerrainHalf);
    const double y = isWall ? random.uniform(-8.0, 8.0) : random.uniform(-kTerrainHalf, kTerrainHalf);
    const double ground = std::sin(0.5 * x) * std::cos(0.4 * y);
    const double z = isWall ? ground + random.uniform(0.0, 4.0) : ground + 0.01 * random.gaussian();
    points.push_back(kScale * Vec3(rounded(x, east), rounded(y, north), rounded(z, std::max(grid, 0.0))));
  }
  return points;
}

HardScene cloudScene(
  const TouchBenchmarkOptions& options, const std::string& name, std::vector<Vec3> points, bool hasLoop)
{
  HardScene scene;
  scene.name = name;
  detail::PortableRandom random(hardSeed(options, 20));
  scene.strokes = handsAt(placesOn(points, options.quick ? 8 : 40, random), random);
  if (hasLoop)
  {
    scene.loopPlaces = placesOn(points, options.quick ? 1 : 5, random);
  }
  scene.points = std::move(points);
  return scene;
}

/// The finite points, their longest side 90 mm, about the origin.
std::vector<Vec3> fittedPoints(std::vector<Vec3> points)
{
  points.erase(
    std::remove_if(points.begin(), points.end(), [](const Vec3& p) { return !isFinite(p); }), points.end());
  Bounds bounds;
  for (const Vec3& p : points)
  {
    bounds.include(p);
  }
  const Vec3 extent = bounds.extent();
  const double scale = kFitted / std::max({ extent.x, extent.y, extent.z, 1e-9 });
  const Vec3 middle = 0.5 * (bounds.minimum + bounds.maximum);
  std::transform(
    points.begin(), points.end(), points.begin(), [&](const Vec3& p) { return scale * (p - middle); });
  return points;
}

/// Eight times as large, about a point whose spacing is the median of some hundred.
std::vector<Vec3> nearer(const std::vector<Vec3>& points)
{
  NeighborQuery query;
  query.build(PointView(points.data(), std::int64_t(points.size())));
  std::vector<std::pair<double, std::size_t>> spacings;
  for (std::size_t i = 0; i < points.size(); i += std::max<std::size_t>(1, points.size() / 500))
  {
    Neighbor found[9];
    const int count = query.nearest(points[i], int(std::size(found)), found);
    spacings.emplace_back(found[count - 1].squaredDistance, i);
  }
  std::sort(spacings.begin(), spacings.end());
  const Vec3 center = spacings.empty() ? Vec3() : points[spacings[spacings.size() / 2].second];
  std::vector<Vec3> kept;
  for (const Vec3& p : points)
  {
    const Vec3 q = kNearer * (p - center);
    if (std::max({ std::abs(q.x), std::abs(q.y), std::abs(q.z) }) < kWorkspaceHalf)
    {
      kept.push_back(q);
    }
  }
  return kept;
}

HardScene vertices(const TouchBenchmarkOptions& options, TouchMesh mesh)
{
  HardScene scene;
  scene.name = "scan vertices " + mesh.name;
  mesh.points = fittedPoints(std::move(mesh.points));
  orientOutward(mesh);
  scene.points = mesh.points;
  scene.strokes = strokesOn(TriangleTree(mesh), options.quick ? 8 : 60, options.strokeSet);
  scene.mesh = std::move(mesh);
  scene.isSolid = true;
  scene.hasErrors = true;
  return scene;
}

} // namespace

TouchStroke handAt(const TouchPlace& place, int kind, detail::PortableRandom& random)
{
  const double speeds[] = { 0.005, 0.020, 0.100, 0.500 };
  const Vec3 aside = cross(place.up, normalized(random.sphere() + 1e-6 * anyPerpendicular(place.up)));
  const Vec3 tangent = normalized(aside, anyPerpendicular(place.up));
  const double depth = random.uniform(1e-3, 5e-3);
  const int speed = int(random.bits() % 4);
  const auto at = [&](double height, double way = 0.0)
  { return place.point + height * place.up + way * tangent; };
  TouchStroke stroke;
  moveTo(stroke, at(kAbove), at(kind == 1 ? -1e-3 : -depth), kind == 2 ? 1.0 : kPressSpeed);
  if (kind == 0)
  {
    stay(stroke, 200);
  }
  else if (kind == 1)
  {
    goTo(stroke, at(-1e-3, 10e-3), speeds[speed]);
  }
  else if (kind == 2)
  {
    goTo(stroke, at(kAbove), 1.0); // The way it came, tick by tick.
  }
  else
  {
    for (int tick = 0; tick < 1000; ++tick)
    {
      stroke.hip.push_back(at(-depth + 1e-3 * std::sin(kTwoPi * 8.0 * tick * kTickSeconds), 3e-6 * tick));
    }
  }
  goTo(stroke, stroke.hip.back() + kPull * place.up, kPullSpeed);
  stay(stroke, kAwayTicks);
  return stroke;
}

std::vector<TouchStroke> handsAt(const std::vector<TouchPlace>& places, detail::PortableRandom& random)
{
  std::vector<TouchStroke> strokes;
  for (const TouchPlace& place : places)
  {
    strokes.push_back(handAt(place, int(strokes.size() % 4), random));
  }
  return strokes;
}

std::vector<TouchPlace> placesOn(const std::vector<Vec3>& points, int count, detail::PortableRandom& random)
{
  const PointView view(points.data(), std::int64_t(points.size()));
  NeighborQuery query;
  query.build(view);
  LocalShape shape;
  std::vector<TouchPlace> places;
  if (measureLocalShape(view, query, {}, shape) != Status::Ok)
  {
    return places;
  }
  const auto emptiness = [&](const Vec3& p)
  {
    Neighbor nearest;
    return query.nearest(p, 1, &nearest) > 0 ? nearest.squaredDistance : 0.0;
  };
  for (int i = 0; i < count; ++i)
  {
    const std::size_t chosen = std::size_t(random.bits() % points.size());
    const float* n = shape.points[chosen].normal;
    const Vec3 up = normalized(Vec3(double(n[0]), double(n[1]), double(n[2])), random.sphere());
    const Vec3& p = points[chosen];
    places.push_back({ p, emptiness(p + kAbove * up) >= emptiness(p - kAbove * up) ? up : -up });
  }
  return places;
}

void addClouds(const TouchBenchmarkOptions& options, std::vector<HardSceneMaker>& all)
{
  const std::int64_t count = options.quick ? 30000 : 200000;
  const auto add = [&](const std::string& family, const std::string& name, bool hasLoop, auto make) {
    all.push_back({ family, [=, &options] { return cloudScene(options, name, make(), hasLoop); } });
  };
  for (const double apart : someOf<double>(options, { 1e-3, 0.3e-3, 2e-3 }))
  {
    add("misregistered", fmt::format("misregistered {:.1f} mm", 1e3 * apart), false,
      [=] {
        return waves(count, { 0.0, apart, 0.0 });
      });
  }
  for (const double noise : someOf<double>(options, { 1.0, 0.5, 2.0 }))
  {
    add("noise", fmt::format("noise {:.1f} spacings", noise), true,
      [=] {
        return waves(count, { noise, 0.0, 0.0 });
      });
  }
  add("strays", "strays 1 %", false, [=] { return waves(count, { 0.0, 0.0, 0.01 }); });
  for (const double grid : someOf<double>(options, { 0.05, 0.01, kFloats }))
  {
    add("grid", grid == kFloats ? "grid float32 UTM" : fmt::format("grid {:.0f} cm", 100.0 * grid),
      grid != kFloats, [=] { return terrain(count / 2, grid); });
  }
  for (const TouchMesh& scan : options.scans)
  {
    add("scan", "scan " + scan.name, true, [&scan] { return fittedPoints(scan.points); });
    add("scan", "scan near " + scan.name, true, [&scan] { return nearer(fittedPoints(scan.points)); });
    if (!scan.triangles.empty())
    {
      all.push_back({ "scan", [&options, &scan] { return vertices(options, scan); } });
    }
  }
}

} // namespace pointhaptics::bench::touch::hard
