#include "Benchmark/Touch/Hard/HardScenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics::bench::touch::hard
{
namespace
{

constexpr double kDegree = kTwoPi / 360.0;
constexpr double kSheetHalf = 0.030;
constexpr double kSlow = 0.050; ///< m/s.
constexpr double kAway = 0.200; ///< m/s, of a hand that leaves.
constexpr std::uint64_t kCloudSeed = 5200;
constexpr int kQuickStrokes = 8;

int strokesOf(const TouchBenchmarkOptions& options, int count)
{
  return options.quick ? kQuickStrokes : count;
}

/// Turns all of a scene, so that nothing is parallel to the lattice.
HardScene turned(HardScene scene)
{
  const auto turn = [](std::vector<Vec3>& points)
  { std::transform(points.begin(), points.end(), points.begin(), turnedAway); };
  turn(scene.points);
  turn(scene.mesh.points);
  for (TouchStroke& stroke : scene.strokes)
  {
    turn(stroke.hip);
  }
  for (TouchPlace& place : scene.loopPlaces)
  {
    place = { turnedAway(place.point), turnedAway(place.up) };
  }
  return scene;
}

std::vector<Vec3> circle(double radius, int sides)
{
  std::vector<Vec3> polygon;
  for (int i = 0; i < sides; ++i)
  {
    polygon.emplace_back(radius * std::cos(kTwoPi * i / sides), radius * std::sin(kTwoPi * i / sides), 0.0);
  }
  return polygon;
}

/// A place @p x outward from the sheet's rim, @p along it and @p z above it; @p side counts quarter turns.
Vec3 atRim(int side, double x, double along, double z)
{
  const double out = kSheetHalf + x;
  const Vec3 turns[] = { { out, along, z }, { -along, out, z }, { -out, -along, z }, { along, -out, z } };
  return turns[side];
}

/// Presses inside the rim, slides over it, and comes back behind the sheet.
TouchStroke aroundRim(int i, detail::PortableRandom& random)
{
  const double speeds[] = { 0.020, 0.100, 0.300 };
  const int side = int(random.bits() % 4);
  const double along = random.uniform(-0.02, 0.02);
  const double inside = random.uniform(1e-3, 8e-3);
  const double beyond = random.uniform(-0.3e-3, 3e-3);
  const double depth = i % 2 == 0 ? 1e-3 : 3e-3;
  const auto at = [&](double x, double z) { return atRim(side, x, along, z); };
  return strokeAlong(at(-inside, 4e-3),
    { { at(-inside, -depth), kPressSpeed }, { at(beyond, -depth), speeds[(i / 2) % 3] },
      { at(beyond, -depth - 3e-3), kSlow }, { at(-10e-3, -depth - 3e-3), kSlow },
      { at(-10e-3, -depth - 63e-3), kAway } });
}

/// Pushes against the rim from outside, in the sheet's plane or just above it, and leaves up or down.
TouchStroke againstRim(int i, detail::PortableRandom& random)
{
  // Exactly in the plane rounding decides on which side the truth is: 1 um above.
  const double heights[] = { 1e-6, 0.1e-3, 0.4e-3 };
  const int side = int(random.bits() % 4);
  const double along = random.uniform(-0.02, 0.02);
  const double in = i % 2 == 0 ? -1e-3 : -3e-3;
  const double up = (i / 2) % 2 == 0 ? 1.0 : -1.0;
  const double z = heights[(i / 4) % 3];
  const auto at = [&](double x, double height) { return atRim(side, x, along, z + up * height); };
  return strokeAlong(at(8e-3, 0.0),
    { { at(in, 0.0), kPressSpeed }, { at(in, 6e-3), kSlow }, { at(in - 10e-3, 6e-3), kSlow },
      { at(in - 10e-3, 56e-3), kAway } });
}

HardScene rim(const TouchBenchmarkOptions& options, std::int64_t points, double noise, bool isEdgeOn)
{
  HardScene scene;
  scene.name =
    fmt::format("rim {} {}, noise {:.0f} um", isEdgeOn ? "edge-on" : "around", points, 1e6 * noise);
  scene.mesh = sheetMesh(kSheetHalf);
  scene.points = samplesOf(scene.mesh, points, kCloudSeed, noise);
  detail::PortableRandom random(hardSeed(options, isEdgeOn ? 1 : 2));
  for (int i = 0; i < strokesOf(options, isEdgeOn ? 24 : 36); ++i)
  {
    scene.strokes.push_back(isEdgeOn ? againstRim(i, random) : aroundRim(i, random));
  }
  return turned(std::move(scene));
}

HardScene sheet(const TouchBenchmarkOptions& options, std::int64_t points)
{
  HardScene scene;
  scene.name = fmt::format("sheet {}", points);
  scene.mesh = sheetMesh(kSheetHalf);
  scene.points = samplesOf(scene.mesh, points, kCloudSeed);
  detail::PortableRandom random(hardSeed(options, 3));
  for (int i = 0; i < strokesOf(options, 40); ++i)
  {
    scene.loopPlaces.push_back(
      { { random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), 0.0 }, { 0, 0, 1 } });
  }
  scene.strokes = handsAt(scene.loopPlaces, random);
  scene.loopPlaces.resize(options.quick ? 1 : 5);
  return turned(std::move(scene));
}

void addDisc(HardScene& scene, const Vec3& center, const Vec3& normal, double radius)
{
  constexpr std::uint32_t kSides = 24;
  const Vec3 a = anyPerpendicular(normal);
  const Vec3 b = cross(normal, a);
  const auto first = std::uint32_t(scene.mesh.points.size());
  scene.mesh.points.push_back(center);
  std::uint32_t side = 0;
  for (const Vec3& p : circle(radius, int(kSides)))
  {
    scene.mesh.points.push_back(center + p.x * a + p.y * b);
    scene.mesh.triangles.insert(
      scene.mesh.triangles.end(), { first, first + 1 + side, first + 1 + (side + 1) % kSides });
    ++side;
  }
}

Vec3 inCube(detail::PortableRandom& random, double half)
{
  const double x = random.uniform(-half, half);
  const double y = random.uniform(-half, half);
  return { x, y, random.uniform(-half, half) };
}

/// Discs anywhere; hands begin at rest among them and go straight out.
HardScene leaves(const TouchBenchmarkOptions& options, bool isSmall)
{
  HardScene scene;
  scene.name = isSmall ? "leaves small" : "leaves";
  const double least = isSmall ? 1e-3 : 3e-3;
  const double most = isSmall ? 2e-3 : 8e-3;
  detail::PortableRandom cloud(kCloudSeed + (isSmall ? 1 : 2));
  for (int disc = 0; disc < (isSmall ? 3000 : 400); ++disc)
  {
    const Vec3 center = inCube(cloud, 0.036);
    const Vec3 normal = cloud.sphere();
    const double radius = cloud.uniform(least, most);
    addDisc(scene, center, normal, radius);
    const Vec3 a = anyPerpendicular(normal);
    for (int i = 0; i < (isSmall ? 40 : 300); ++i)
    {
      const double r = radius * std::sqrt(cloud.uniform());
      const double angle = kTwoPi * cloud.uniform();
      scene.points.push_back(center + r * (std::cos(angle) * a + std::sin(angle) * cross(normal, a)));
    }
  }
  scene.mesh = twoSided(std::move(scene.mesh));
  detail::PortableRandom random(hardSeed(options, isSmall ? 4 : 5));
  for (int i = 0; i < strokesOf(options, 32); ++i)
  {
    const Vec3 start = inCube(random, 0.030);
    scene.strokes.push_back(
      strokeAlong(start, { { start, kSlow }, { start + 0.120 * random.sphere(), 0.100 } }));
  }
  return scene;
}

/// Points that lie on no surface. Polygons of eight legs and back the same way: what a path takes on the way
/// there it has to give back.
HardScene fog(const TouchBenchmarkOptions& options, int points)
{
  HardScene scene;
  scene.name = fmt::format("fog {}", points);
  detail::PortableRandom cloud(kCloudSeed + 3);
  for (int i = 0; i < points; ++i)
  {
    scene.points.push_back(inCube(cloud, 0.040));
  }
  detail::PortableRandom random(hardSeed(options, 6));
  for (int i = 0; i < strokesOf(options, 32); ++i)
  {
    TouchStroke stroke;
    stroke.hip.push_back(inCube(random, 0.030));
    for (int leg = 0; leg < 8; ++leg)
    {
      goTo(stroke, stroke.hip.back() + 4e-3 * random.sphere(), kSlow);
    }
    const std::vector<Vec3> there = stroke.hip;
    stroke.hip.insert(stroke.hip.end(), there.rbegin() + 1, there.rend());
    scene.strokes.push_back(std::move(stroke));
  }
  return scene;
}

/// A sheet whose right half is @p ratio times as sparse in spacing, crossed both ways.
HardScene step(const TouchBenchmarkOptions& options, int ratio, double noise)
{
  constexpr std::int64_t kDenseHalf = 100000;
  HardScene scene;
  scene.name = fmt::format("steps 1:{}, noise {:.1f}", ratio, noise);
  scene.mesh = sheetMesh(kSheetHalf);
  detail::PortableRandom cloud(kCloudSeed + 4);
  for (const int sparser : { 1, ratio })
  {
    const std::int64_t count = kDenseHalf / (sparser * sparser);
    const double spacing = std::sqrt(2.0 * kSheetHalf * kSheetHalf / double(count));
    const double side = sparser == 1 ? -1.0 : 1.0;
    for (std::int64_t i = 0; i < count; ++i)
    {
      const double x = side * cloud.uniform(0.0, kSheetHalf);
      const double y = cloud.uniform(-kSheetHalf, kSheetHalf);
      scene.points.emplace_back(x, y, noise * spacing * cloud.gaussian());
    }
  }
  const double speeds[] = { 0.020, 0.050, 0.200, 0.500 };
  detail::PortableRandom random(hardSeed(options, 7));
  for (int i = 0; i < strokesOf(options, 40); ++i)
  {
    const double way = i % 2 == 0 ? 12e-3 : -12e-3;
    const double depth = -random.uniform(0.5e-3, 2e-3);
    const double y = random.uniform(-0.02, 0.02);
    scene.strokes.push_back(strokeAlong({ -way, y, 4e-3 },
      { { { -way, y, depth }, kPressSpeed }, { { way, y, depth }, speeds[(i / 2) % 4] },
        { { way, y, 5e-3 }, kSlow } }));
  }
  return turned(std::move(scene));
}

/// @p makePlace draws a place for each hand.
template <class MakePlace>
HardScene narrow(const TouchBenchmarkOptions& options, const std::string& name, TouchMesh mesh,
  std::int64_t points, MakePlace&& makePlace)
{
  HardScene scene;
  scene.name = "narrow " + name;
  scene.points = samplesOf(mesh, points, kCloudSeed + 5);
  scene.mesh = std::move(mesh);
  scene.isSolid = true;
  detail::PortableRandom random(hardSeed(options, 8));
  std::vector<TouchPlace> places;
  for (int i = 0; i < strokesOf(options, 40); ++i)
  {
    places.push_back(makePlace(random));
  }
  scene.strokes = handsAt(places, random);
  return turned(std::move(scene));
}

/// Walls on a block with a gap between them, and hands that go into the gap.
HardScene slot(const TouchBenchmarkOptions& options, double width, std::int64_t points)
{
  TouchMesh mesh = blockMesh({ -0.020, -0.5 * width, 0.5 * width, 0.020 }, { -0.025, 0.025 },
    { -0.020, -0.010, 0.0 }, [](int x, int, int z) { return z == 0 || x != 1; });
  return narrow(options, fmt::format("slot {:.1f} mm", 1e3 * width), std::move(mesh), points,
    [](detail::PortableRandom& random)
    {
      const double x = random.uniform(-1e-3, 1e-3);
      return TouchPlace{ { x, random.uniform(-0.02, 0.02), 0.0 }, { 0.0, 0.0, 1.0 } };
    });
}

HardScene pole(const TouchBenchmarkOptions& options, double radius, std::int64_t points)
{
  return narrow(options, fmt::format("pole {:.1f} mm", 1e3 * radius), cylinderMesh(radius, 0.060, 32), points,
    [=](detail::PortableRandom& random)
    {
      const double angle = kTwoPi * random.uniform();
      const Vec3 up{ std::cos(angle), std::sin(angle), 0.0 };
      return TouchPlace{ radius * up + Vec3(0.0, 0.0, random.uniform(-0.02, 0.029)), up };
    });
}

HardScene hole(const TouchBenchmarkOptions& options, double radius, std::int64_t points)
{
  TouchMesh mesh = twoSided(ringMesh(circle(kSheetHalf, 32), circle(radius, 32), 0.0));
  HardScene scene = narrow(options, fmt::format("hole {:.1f} mm", 1e3 * radius), std::move(mesh), points,
    [](detail::PortableRandom& random)
    {
      const double x = random.uniform(-1e-3, 1e-3);
      return TouchPlace{ { x, random.uniform(-1e-3, 1e-3), 0.0 }, { 0.0, 0.0, 1.0 } };
    });
  scene.isSolid = false;
  return scene;
}

HardScene wedge(const TouchBenchmarkOptions& options, double degrees, std::int64_t points)
{
  const double flank = 0.040;
  const double s = std::sin(0.5 * degrees * kDegree);
  const double c = std::cos(0.5 * degrees * kDegree);
  const double top = 0.5 * flank * c;
  TouchMesh mesh =
    prismMesh({ { -flank * s, -top, 0.0 }, { flank * s, -top, 0.0 }, { 0.0, top, 0.0 } }, 0.05);
  return narrow(options, fmt::format("wedge {:.0f} deg", degrees), std::move(mesh), points,
    [=](detail::PortableRandom& random)
    {
      const double side = random.uniform() < 0.5 ? 1.0 : -1.0;
      const double back = random.uniform(0.5e-3, 6e-3);
      const double z = random.uniform(-0.02, 0.02);
      return TouchPlace{ { side * s * back, top - c * back, z }, { side * c, s, 0.0 } };
    });
}

/// Two plates of 1 mm with ribs, slots, holes and a lip.
TouchMesh bracketMesh()
{
  const std::vector<double> x{ -0.030, -0.0205, -0.0195, -0.013, -0.007, -0.0005, 0.0005, 0.007, 0.009, 0.011,
    0.013, 0.0195, 0.0205, 0.030 };
  const std::vector<double> y{ -0.030, -0.029, -0.017, 0.000, 0.006, 0.010, 0.020, 0.029, 0.030 };
  const std::vector<double> z{ -0.022, -0.021, -0.017, -0.009, 0.003, 0.009, 0.023 };
  return blockMesh(x, y, z,
    [](int i, int j, int k)
    {
      const bool isRib = i == 1 || i == 5 || i == 11;
      const bool isBaseSlot = i == 8 && j == 5;
      const bool isBaseHole = i == 3 && j == 3;
      const bool isWallHole = (i == 3 || (i >= 7 && i <= 9)) && k == 4;
      const bool isBase = k == 0 && !isBaseSlot && !isBaseHole;
      const bool isWall = j == 0 && k > 0 && !isWallHole;
      const bool isLip = j == 7 && k == 1;
      return isBase || isWall || isLip || (isRib && j == 1 && k <= 2);
    });
}

constexpr int kTeeth = 200;

TouchMesh toothedRing()
{
  std::vector<Vec3> outer;
  std::vector<Vec3> inner;
  for (int i = 0; i < kTeeth; ++i)
  {
    for (const auto& [part, radius] :
      { std::pair{ 0.0, 0.045 }, { 0.45, 0.045 }, { 0.5, 0.046 }, { 0.95, 0.046 } })
    {
      const double angle = kTwoPi * (i + part) / kTeeth;
      const Vec3 direction{ std::cos(angle), std::sin(angle), 0.0 };
      outer.push_back(radius * direction);
      inner.push_back(0.015 * direction);
    }
  }
  return ringMesh(outer, inner, 0.010);
}

/// Hands that press 1 mm on tops of teeth and between them, and slide along them.
std::vector<TouchStroke> strokesOnTeeth(int count, detail::PortableRandom& random)
{
  std::vector<TouchStroke> strokes;
  for (int i = 0; i < count; ++i)
  {
    const bool isTop = i % 2 == 0;
    const double part = (isTop ? 0.725 : 0.225) + random.uniform(-0.15, 0.15);
    const double angle = kTwoPi * (double(random.bits() % kTeeth) + part) / kTeeth;
    const Vec3 up{ std::cos(angle), std::sin(angle), 0.0 };
    const auto at = [&](double height, double z)
    { return ((isTop ? 0.046 : 0.045) + height) * up + Vec3(0, 0, z); };
    strokes.push_back(strokeAlong(at(4e-3, -3e-3),
      { { at(-1e-3, -3e-3), kPressSpeed }, { at(-1e-3, 3e-3), 0.020 }, { at(4e-3, 3e-3), kSlow } }));
  }
  return strokes;
}

HardScene solid(const TouchBenchmarkOptions& options, const std::string& family, std::int64_t points)
{
  const bool isOnTeeth = family == "teeth";
  HardScene scene;
  scene.name = fmt::format("{} {}", family, points);
  scene.mesh = family == "bracket" ? bracketMesh() : toothedRing();
  scene.isSolid = true;
  scene.hasErrors = true;
  scene.points = samplesOf(scene.mesh, points, kCloudSeed + 6);
  detail::PortableRandom random(hardSeed(options, 9));
  const int count = strokesOf(options, 60);
  scene.strokes =
    isOnTeeth ? strokesOnTeeth(count, random) : strokesOn(TriangleTree(scene.mesh), count, options.strokeSet);
  if (isOnTeeth)
  {
    scene.loopPlaces = placesOn(scene.points, options.quick ? 1 : 5, random);
  }
  return turned(std::move(scene));
}

void addSheets(const TouchBenchmarkOptions& options, std::vector<HardSceneMaker>& all)
{
  for (const bool isEdgeOn : { false, true })
  {
    for (const int points : someOf<int>(options, { 4000, 20000, 200000 }))
    {
      for (const double noise : someOf<double>(options, { 20e-6, 0.0, 200e-6 }))
      {
        all.push_back({ "rim", [=, &options] { return rim(options, points, noise, isEdgeOn); } });
      }
    }
  }
  all.push_back({ "sheet", [=, &options] { return sheet(options, options.quick ? 20000 : 200000); } });
  for (const bool isSmall : { false, true })
  {
    all.push_back({ "leaves", [=, &options] { return leaves(options, isSmall); } });
  }
  for (const int points : someOf<int>(options, { 20000, 100000, 500000 }))
  {
    all.push_back({ "fog", [=, &options] { return fog(options, points); } });
  }
  for (const double noise : someOf<double>(options, { 0.3, 0.0 }))
  {
    for (const int ratio : someOf<int>(options, { 8, 4, 6, 12 }))
    {
      all.push_back({ "steps", [=, &options] { return step(options, ratio, noise); } });
    }
  }
}

void addSolids(const TouchBenchmarkOptions& options, std::vector<HardSceneMaker>& all)
{
  const auto addNarrow = [&](auto make, std::initializer_list<double> sizes, std::int64_t points)
  {
    for (const double size : someOf<double>(options, sizes))
    {
      all.push_back({ "narrow", [=, &options] { return make(options, size, points); } });
    }
  };
  const std::int64_t points = options.quick ? 30000 : 200000;
  addNarrow(slot, { 1e-3, 0.4e-3 }, points);
  addNarrow(pole, { 0.5e-3, 0.1e-3 }, 20000);
  addNarrow(hole, { 0.5e-3, 0.3e-3 }, points);
  addNarrow(wedge, { 20.0, 8.0 }, points);
  for (const char* family : { "bracket", "gear", "teeth" })
  {
    for (const int count : someOf<int>(options, { 47516, 543652 }))
    {
      all.push_back({ family, [=, &options] { return solid(options, family, count); } });
    }
  }
}

} // namespace

std::vector<std::string> hardFamilies()
{
  return { "rim", "sheet", "leaves", "fog", "steps", "narrow", "bracket", "gear", "teeth", "misregistered",
    "noise", "strays", "grid", "scan" };
}

std::vector<HardSceneMaker> hardScenes(const TouchBenchmarkOptions& options)
{
  std::vector<HardSceneMaker> all;
  addSheets(options, all);
  addSolids(options, all);
  addClouds(options, all);
  const std::vector<std::string>& wanted = options.families;
  all.erase(
    std::remove_if(all.begin(), all.end(),
      [&](const HardSceneMaker& maker)
      { return !wanted.empty() && std::find(wanted.begin(), wanted.end(), maker.family) == wanted.end(); }),
    all.end());
  return all;
}

std::uint64_t hardSeed(const TouchBenchmarkOptions& options, std::uint64_t family)
{
  return 5300 + 100 * std::uint64_t(options.strokeSet) + family;
}

void goTo(TouchStroke& stroke, const Vec3& to, double speed)
{
  moveTo(stroke, Vec3(stroke.hip.back()), to, speed);
}

TouchStroke strokeAlong(const Vec3& start, const std::vector<Leg>& legs)
{
  TouchStroke stroke;
  stroke.hip.push_back(start);
  for (const Leg& leg : legs)
  {
    goTo(stroke, leg.to, leg.speed);
  }
  stay(stroke, kAwayTicks);
  return stroke;
}

TouchMesh twoSided(TouchMesh mesh)
{
  const std::size_t size = mesh.triangles.size();
  for (std::size_t i = 0; i < size; i += 3)
  {
    const std::uint32_t corner[] = { mesh.triangles[i], mesh.triangles[i + 2], mesh.triangles[i + 1] };
    mesh.triangles.insert(mesh.triangles.end(), std::begin(corner), std::end(corner));
  }
  return mesh;
}

TouchMesh sheetMesh(double half)
{
  TouchMesh mesh;
  mesh.points = { { -half, -half, 0.0 }, { half, -half, 0.0 }, { half, half, 0.0 }, { -half, half, 0.0 } };
  mesh.triangles = { 0, 1, 2, 0, 2, 3 };
  return twoSided(std::move(mesh));
}

TouchMesh ringMesh(const std::vector<Vec3>& outer, const std::vector<Vec3>& inner, double height)
{
  const auto count = std::uint32_t(outer.size());
  TouchMesh mesh;
  // Four circles of corners: outer and inner at the top, outer and inner at the bottom.
  for (const double z : { 0.5 * height, -0.5 * height })
  {
    for (const std::vector<Vec3>* polygon : { &outer, &inner })
    {
      for (const Vec3& p : *polygon)
      {
        mesh.points.emplace_back(p.x, p.y, z);
      }
    }
  }
  const auto addStrip = [&](std::uint32_t a, std::uint32_t b)
  {
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const std::uint32_t j = (i + 1) % count;
      const std::uint32_t c[] = { a * count + i, a * count + j, b * count + j, b * count + i };
      mesh.triangles.insert(mesh.triangles.end(), { c[0], c[1], c[2], c[0], c[2], c[3] });
    }
  };
  addStrip(0, 1);
  if (height > 0.0)
  {
    addStrip(3, 2);
    addStrip(2, 0);
    addStrip(1, 3);
  }
  return mesh;
}

} // namespace pointhaptics::bench::touch::hard
