/// Do thin plates, holes, slots, ridges, wedges and jumps of the density feel as they are?
#include "Benchmark/Touch/Studies.h"

#include "Core/Base/PortableRandom.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace touch
{
namespace
{

constexpr std::uint64_t kThinSampleSeed = 29;
constexpr std::uint64_t kStrokeSeed = 30;
constexpr std::uint64_t kThroughSeed = 300;
constexpr double kLiftSpeed = 0.050;
constexpr double kAbove = 3e-3;
constexpr double kPlateHalf = 0.025;
constexpr double kBehind = 3e-3; ///< How far the hand is behind a plate that it went through.
constexpr double kDegree = 0.017453292519943295;

struct Item
{
  std::string name;
  TouchMesh mesh;
  std::vector<Vec3> points;
  std::vector<TouchStroke> strokes;
};

double slideSpeed(int i)
{
  return i % 2 == 0 ? 0.020 : 0.050;
}

/// From outside along @p normal to @p depth below @p place, across by @p slide, out again, and stay.
TouchStroke pressAndSlide(
  const Vec3& place, const Vec3& normal, double depth, const Vec3& slide, double speed)
{
  TouchStroke stroke;
  const Vec3 low = place - depth * normal;
  moveTo(stroke, place + kAbove * normal, low, kPressSpeed);
  moveTo(stroke, low, low + slide, speed);
  moveTo(stroke, low + slide, low + slide + (depth + kAbove) * normal, kLiftSpeed);
  stay(stroke, kRestTicks);
  return stroke;
}

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

/// A plate of 3 mm with an opening: strokes at 1 mm depth end over its middle, or go on across it.
Item opening(const std::string& name, double width, double length, int count, detail::PortableRandom& random)
{
  Item item;
  item.name = fmt::format("{} {:.0f} mm", name, 1e3 * width);
  item.mesh = blockMesh({ -kPlateHalf, -0.5 * width, 0.5 * width, kPlateHalf },
    { -kPlateHalf, -0.5 * length, 0.5 * length, kPlateHalf }, { -0.0015, 0.0015 },
    [](int x, int y, int) { return x != 1 || y != 1; });
  for (int i = 0; i < count; ++i)
  {
    const double reach = 0.3 * length;
    const double back = random.uniform(4e-3, 7e-3);
    const Vec3 place{ -0.5 * width - back, random.uniform(-reach, reach), 0.0015 };
    const double way = back + (i % 4 < 2 ? 0.5 * width : width + 4e-3);
    item.strokes.push_back(pressAndSlide(place, { 0.0, 0.0, 1.0 }, 1e-3, { way, 0.0, 0.0 }, slideSpeed(i)));
  }
  return item;
}

/// A wall on a base, pressed from both sides to 0.6 of its thickness and slid up over its rim.
Item ridge(double thickness, int count, detail::PortableRandom& random)
{
  Item item;
  item.name = fmt::format("ridge {:.1f} mm", 1e3 * thickness);
  const double half = 0.5 * thickness;
  item.mesh = blockMesh({ -0.015, -half, half, 0.015 }, { -kPlateHalf, kPlateHalf }, { -0.005, 0.0, 0.012 },
    [](int x, int, int z) { return z == 0 || x == 1; });
  for (int i = 0; i < count; ++i)
  {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const Vec3 place{ side * half, random.uniform(-0.02, 0.02), random.uniform(0.004, 0.008) };
    const Vec3 slide{ 0.0, 0.0, 0.012 - place.z + 0.003 };
    item.strokes.push_back(
      pressAndSlide(place, { side, 0.0, 0.0 }, 0.6 * thickness, slide, slideSpeed(i / 2)));
  }
  return item;
}

/// A prism with an apex of @p degrees; strokes press a flank to 1 mm and slide over the apex.
Item wedge(double degrees, int count, detail::PortableRandom& random)
{
  Item item;
  item.name = fmt::format("wedge {:.0f} deg", degrees);
  const double flank = 0.025;
  const double s = std::sin(0.5 * degrees * kDegree);
  const double c = std::cos(0.5 * degrees * kDegree);
  // The apex points along y.
  const double low = -0.5 * flank * c;
  item.mesh =
    prismMesh({ { -flank * s, low, 0.0 }, { flank * s, low, 0.0 }, { 0.0, low + flank * c, 0.0 } }, 0.05);
  for (int i = 0; i < count; ++i)
  {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const double back = random.uniform(5e-3, 8e-3);
    const Vec3 up{ -side * s, c, 0.0 };
    const Vec3 normal{ side * c, s, 0.0 };
    const Vec3 apex{ 0.0, low + flank * c, random.uniform(-0.02, 0.02) };
    item.strokes.push_back(
      pressAndSlide(apex - back * up, normal, 1e-3, (back + 3e-3) * up, slideSpeed(i / 2)));
  }
  return item;
}

/// The plane whose right half has 16 times as many points, crossed both ways at 1 mm depth.
Item densityStep(std::int64_t points, int count, detail::PortableRandom& random)
{
  Item item;
  item.name = "density 16:1";
  constexpr double kSide = 0.04;
  item.mesh.points = { { -kSide, -kSide, 0.0 }, { kSide, -kSide, 0.0 }, { kSide, kSide, 0.0 },
    { -kSide, kSide, 0.0 } };
  item.mesh.triangles = { 0, 1, 2, 0, 2, 3 };
  for (int i = 0; i < count; ++i)
  {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const Vec3 place{ -side * random.uniform(4e-3, 6e-3), random.uniform(-0.02, 0.02), 0.0 };
    item.strokes.push_back(
      pressAndSlide(place, { 0.0, 0.0, 1.0 }, 1e-3, { side * 0.010, 0.0, 0.0 }, slideSpeed(i / 2)));
  }
  item.points = proxy::pointsOf(Shape::DensityStep, points, 0.0);
  return item;
}

/// Made one at a time: each is a cloud.
std::vector<std::function<Item()>> itemsOf(
  const TouchBenchmarkOptions& options, detail::PortableRandom& random)
{
  const int count = options.strokes;
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
  for (const double width : { 2e-3, 4e-3, 8e-3 })
  {
    items.emplace_back(
      [=, &random] { return finished(opening("hole", width, width, count, random), points); });
  }
  for (const double width : { 1e-3, 2e-3, 6e-3 })
  {
    items.emplace_back(
      [=, &random] { return finished(opening("slot", width, 0.03, count, random), points); });
  }
  for (const double thickness : { 0.8e-3, 1.5e-3 })
  {
    items.emplace_back([=, &random] { return finished(ridge(thickness, count, random), points); });
  }
  for (const double degrees : { 30.0, 60.0, 90.0, 120.0 })
  {
    items.emplace_back([=, &random] { return finished(wedge(degrees, count, random), points); });
  }
  items.emplace_back([=, &random] { return densityStep(points, count, random); });
  return items;
}

} // namespace

ReportPart studyThin(StudyContext& context)
{
  const TouchBenchmarkOptions& options = context.options;
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "Thin plates, holes, slots, ridges, wedges and a density jump";
  part.text = fmt::format(
    "{} strokes and {} points each; {}. Plates: pressed at 0.05, 0.2, 0.5 and 1 m/s to 0.8 of their "
    "thickness, from both sides. Through: at 0.05, 0.2 and 1 m/s right through a plate, or through the rim "
    "of its hole (square, 4 mm) 0.3 to 1 mm beside that, from both sides, until the hand is 3 mm behind; "
    "half of the strokes go 8 mm aside there and back; out where they came in. A hand that is let go or "
    "pushed on before counts under pops. Holes (square) and slots (30 mm long) in a plate of 3 mm: 1 mm "
    "deep, ending over the middle of the opening or beyond it. Ridges (12 mm high, on a base): pressed from "
    "both sides to 0.6 of their thickness, slid up over the rim. Wedges: 1 mm deep over the apex. Density: "
    "1 mm deep, across a jump of 16:1.",
    options.strokes, grouped(options.points), sceneText(options));
  setFigureHeader(part, { "part", "method" });
  detail::PortableRandom random(kStrokeSeed + std::uint64_t(options.strokeSet));
  for (const auto& make : itemsOf(options, random))
  {
    Item item = make();
    context.progress("god objects on " + item.name);
    const std::vector<TouchTask> tasks = tasksOn(TriangleTree(item.mesh), std::move(item.strokes));
    const TouchScene scene = makeTouchScene(std::move(item.points), sceneSettings(options));
    if (!scene.scene)
    {
      continue;
    }
    for (const Contestant& contestant : contestantsNamed(options.methods, options.instructions))
    {
      context.progress(contestant.name + " on " + item.name);
      addFigures(context, part, { item.name, contestant.name },
        { { "part", item.name }, { "method", contestant.name } }, judge(context, contestant, scene, tasks));
    }
  }
  return part;
}

} // namespace touch
} // namespace bench
} // namespace pointhaptics
