/// Do thin plates and the rims of their holes feel as they are? Slots, wedges and jumps of the density are
/// scenes of the study hard.
#include "Benchmark/Touch/Studies.h"

#include "Core/Base/PortableRandom.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics::bench::touch
{
namespace
{

constexpr std::uint64_t kThinSampleSeed = 29;
constexpr std::uint64_t kStrokeSeed = 30;
constexpr std::uint64_t kThroughSeed = 300;
constexpr double kPlateHalf = 0.025;
constexpr double kBehind = 3e-3; ///< How far the hand is behind a plate that it went through.

struct Item
{
  std::string name;
  TouchMesh mesh;
  std::vector<Vec3> points;
  std::vector<TouchStroke> strokes;
};

TouchMesh turned(TouchMesh mesh)
{
  std::transform(mesh.points.begin(), mesh.points.end(), mesh.points.begin(), turnedAway);
  return mesh;
}

/// Turns mesh and strokes, and draws the points.
Item finished(Item item, std::int64_t points)
{
  item.mesh = turned(std::move(item.mesh));
  for (TouchStroke& stroke : item.strokes)
  {
    std::transform(stroke.hip.begin(), stroke.hip.end(), stroke.hip.begin(), turnedAway);
  }
  item.points = samplesOf(item.mesh, points, kThinSampleSeed);
  return item;
}

/// Down to 0.8 of the thickness and back at up to 1 m/s, from both sides.
Item plate(double thickness, int count, detail::PortableRandom& random)
{
  Item item;
  item.name = fmt::format("plate {:.1f} mm", 1e3 * thickness);
  const double half = 0.5 * thickness;
  item.mesh = blockMesh({ -kPlateHalf, kPlateHalf }, { -kPlateHalf, kPlateHalf }, { -half, half },
    [](int, int, int) { return true; });
  const double speeds[] = { 0.05, 0.2, 0.5, 1.0 };
  for (int i = 0; i < count; ++i)
  {
    const double up = i % 2 == 0 ? 1.0 : -1.0;
    const double x = random.uniform(-0.02, 0.02);
    const double y = random.uniform(-0.02, 0.02);
    const double start = random.uniform(5e-3, 6e-3);
    const Vec3 low{ x, y, up * (half - 0.8 * thickness) };
    const Vec3 high{ x, y, up * (half + start) };
    TouchStroke stroke;
    moveTo(stroke, high, low, speeds[(i / 2) % 4]);
    stay(stroke, 20);
    moveTo(stroke, low, high, speeds[(i / 2) % 4]);
    stay(stroke, kRestTicks);
    item.strokes.push_back(std::move(stroke));
  }
  return item;
}

/// Right through a plate to 3 mm beyond its other face, and back the same way; half of the strokes go 8 mm
/// aside there and back. At 1 m/s a tick may begin before the plate and end behind it. With @p hole
/// they go through beside the walls of a square hole, that is through its rim.
Item throughPlate(double thickness, double hole, int count, detail::PortableRandom random)
{
  Item item;
  const double half = 0.5 * thickness;
  const double rim = 0.5 * hole;
  item.name = fmt::format("through {} {:.1f} mm", hole > 0.0 ? "rim" : "plate", 1e3 * thickness);
  item.mesh = hole > 0.0
    ? blockMesh({ -kPlateHalf, -rim, rim, kPlateHalf }, { -kPlateHalf, -rim, rim, kPlateHalf },
        { -half, half }, [](int x, int y, int) { return x != 1 || y != 1; })
    : blockMesh({ -kPlateHalf, kPlateHalf }, { -kPlateHalf, kPlateHalf }, { -half, half },
        [](int, int, int) { return true; });
  const double speeds[] = { 0.05, 0.2, 1.0 };
  for (int i = 0; i < count; ++i)
  {
    const double up = i % 2 == 0 ? 1.0 : -1.0;
    const double start = random.uniform(5e-3, 6e-3);
    const double x = hole > 0.0 ? rim + random.uniform(0.3e-3, 1e-3) : random.uniform(-0.015, 0.015);
    const double y = hole > 0.0 ? random.uniform(-0.7, 0.7) * rim : random.uniform(-0.02, 0.02);
    const Vec3 aside = (i / 6) % 2 == 1 ? Vec3(8e-3, 0.0, 0.0) : Vec3();
    item.strokes.push_back(strokeThrough(
      { x, y, up * half }, { 0.0, 0.0, up }, start, thickness + kBehind, aside, speeds[(i / 2) % 3]));
  }
  return item;
}

/// Made one at a time: each is a cloud.
std::vector<std::function<Item()>> itemsOf(
  const TouchBenchmarkOptions& options, detail::PortableRandom& random)
{
  const int count = int(options.strokes);
  const std::int64_t points = options.points;
  std::vector<std::function<Item()>> items;
  for (const double thickness : { 0.6e-3, 0.8e-3, 1e-3, 2e-3 })
  {
    items.emplace_back([=, &random] { return finished(plate(thickness, count, random), points); });
  }
  const std::uint64_t through = kThroughSeed + std::uint64_t(options.strokeSet);
  for (const double thickness : { 0.6e-3, 0.8e-3, 1e-3, 2e-3 })
  {
    items.emplace_back(
      [=] { return finished(throughPlate(thickness, 0.0, count, detail::PortableRandom(through)), points); });
  }
  for (const double thickness : { 0.6e-3, 1e-3 })
  {
    items.emplace_back([=]
      { return finished(throughPlate(thickness, 4e-3, count, detail::PortableRandom(through)), points); });
  }
  return items;
}

} // namespace

void studyThin(StudyContext& context)
{
  const TouchBenchmarkOptions& options = context.options;
  detail::PortableRandom random(kStrokeSeed + std::uint64_t(options.strokeSet));
  for (const auto& make : itemsOf(options, random))
  {
    Item item = make();
    context.run.say("god objects on " + item.name);
    const std::vector<TouchTask> tasks = tasksOn(TriangleTree(item.mesh), std::move(item.strokes));
    const TouchScene scene = makeTouchScene(std::move(item.points), sceneSettings(options));
    if (!scene.scene)
    {
      continue;
    }
    for (const Contestant& contestant : contestantsNamed(options.methods, options.instructions))
    {
      context.run.say(contestant.name + " on " + item.name);
      addFigures(context, "thin", { { "part", item.name }, { "method", contestant.name } },
        judge(context, contestant, scene, tasks));
    }
  }
}

} // namespace pointhaptics::bench::touch
