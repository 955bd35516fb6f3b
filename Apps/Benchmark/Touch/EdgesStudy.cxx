/// What does a hand meet that slides over the edge or the corner of a box into free space?
#include "Benchmark/Touch/Studies.h"

#include "Core/Base/PortableRandom.h"
#include "Haptics/Contact/SurfaceFitProxy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

namespace pointhaptics
{
namespace bench
{
namespace touch
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kHalf = 0.025; ///< Of Shape::Box.
constexpr double kBeyond = 0.015;
constexpr int kTicksAtRest = 100;
constexpr double kLeastOutside = 5e-4;
constexpr double kForce = 0.05;
constexpr double kJustOutside = 1e-9;
constexpr std::uint64_t kSeed = 540;

struct EdgeCloud
{
  std::int64_t points;
  double noise;
};

/// Metres outside up to which the largest forces are told apart; further than the last none may be.
constexpr double kBands[] = { 1e-4, 2.5e-4, kLeastOutside };

struct EdgeFigures
{
  double bandNewton[std::size(kBands)] = {};
  double outsideNewton = 0.0;
  int late = 0;      ///< Strokes that are let go outside.
  int mostTicks = 0; ///< After which the last of them is.
  int above = 0;     ///< Strokes.
  int held = 0;
};

/// Metres outside the prism over the top face; negative above or below that face.
double distanceOutside(const Vec3& p)
{
  return std::max(std::abs(p.x), std::abs(p.y)) - kHalf;
}

/// All depths, speeds and starts on the box whose faces are parallel to the axes.
std::vector<TouchStroke> strokesOver(bool corner, int starts)
{
  detail::PortableRandom random(kSeed);
  std::vector<TouchStroke> strokes;
  const Vec3 along = corner ? normalized(Vec3(1.0, 1.0, 0.0)) : Vec3(1.0, 0.0, 0.0);
  const Vec3 across = corner ? normalized(Vec3(-1.0, 1.0, 0.0)) : Vec3(0.0, 1.0, 0.0);
  const Vec3 rim = (corner ? std::sqrt(2.0) : 1.0) * kHalf * along + Vec3(0.0, 0.0, kHalf);
  for (const double depth : { 1e-3, 2e-3, 3e-3 })
  {
    for (const double speed : { 0.05, 0.2, 0.5 })
    {
      for (int i = 0; i < starts; ++i)
      {
        const double back = random.uniform(8e-3, 12e-3);
        const double aside = corner ? random.uniform(-5e-4, 5e-4) : random.uniform(-5e-3, 5e-3);
        const Vec3 top = rim - back * along + aside * across;
        const Vec3 low = top - Vec3(0.0, 0.0, depth);
        TouchStroke stroke;
        moveTo(stroke, top + Vec3(0.0, 0.0, 3e-3), low, kPressSpeed);
        moveTo(stroke, low, low + (back + kBeyond) * along, speed);
        stay(stroke, kTicksAtRest);
        strokes.push_back(std::move(stroke));
      }
    }
  }
  return strokes;
}

void add(const TouchStroke& stroke, const TouchTrace& trace, double limit, EdgeFigures& figures)
{
  double most = 0.0;
  int ticks = 0;
  for (std::size_t i = 0; i < trace.states.size(); ++i)
  {
    const double outside = distanceOutside(stroke.hip[i]);
    const double force = norm(trace.states[i].force);
    if (!(outside > kJustOutside))
    {
      continue;
    }
    const double* const band = std::lower_bound(std::begin(kBands), std::end(kBands), outside);
    if (band != std::end(kBands))
    {
      double& newton = figures.bandNewton[band - std::begin(kBands)];
      newton = std::max(newton, force);
    }
    most = outside > limit ? std::max(most, force) : most;
    ticks += force > kForce;
  }
  figures.outsideNewton = std::max(figures.outsideNewton, most);
  figures.late += ticks > 0;
  figures.mostTicks = std::max(figures.mostTicks, ticks);
  figures.above += most > kForce;
  figures.held += norm(trace.states.back().force) > kForce;
}

std::vector<EdgeCloud> cloudsOf(const TouchBenchmarkOptions& options)
{
  if (options.quick)
  {
    return { { options.points, 0.0 } };
  }
  return { { 47516, 0.0 }, { options.points, 0.0 }, { options.points, 20e-6 } };
}

/// The same, turned away from the axes where asked.
std::vector<TouchTask> tasksOver(bool turned, const std::vector<TouchStroke>& strokes)
{
  TouchMesh mesh =
    blockMesh({ -kHalf, kHalf }, { -kHalf, kHalf }, { -kHalf, kHalf }, [](int, int, int) { return true; });
  std::vector<TouchStroke> moved = strokes;
  if (turned)
  {
    std::transform(mesh.points.begin(), mesh.points.end(), mesh.points.begin(), turnedAway);
    for (TouchStroke& stroke : moved)
    {
      std::transform(stroke.hip.begin(), stroke.hip.end(), stroke.hip.begin(), turnedAway);
    }
  }
  return tasksOn(TriangleTree(mesh), std::move(moved));
}

/// A circle about @p center in the plane of x and z, millimetres from the edge.
Series circle(const std::string& name, const Vec3& center, double radius)
{
  constexpr int kParts = 90;
  Series series{ name, {}, {} };
  for (int i = 0; i <= kParts; ++i)
  {
    const double angle = 2.0 * kPi * i / kParts;
    series.x.push_back(1e3 * (center.x - kHalf + radius * std::cos(angle)));
    series.y.push_back(1e3 * (center.z - kHalf + radius * std::sin(angle)));
  }
  return series;
}

/// The fit as far as its ball reaches, in the same plane.
Series curve(const std::string& name, const SurfaceTracker& fit, double radius)
{
  constexpr int kParts = 40;
  Series series{ name, {}, {} };
  for (int i = -kParts; i <= kParts; ++i)
  {
    const Vec3 aside = radius * i / kParts * cross(Vec3(0.0, 1.0, 0.0), fit.normal());
    Vec3 point;
    Vec3 normal;
    fit.alongSurface(aside, point, normal);
    series.x.push_back(1e3 * (point.x - kHalf));
    series.y.push_back(1e3 * (point.z - kHalf));
  }
  return series;
}

/// What the hand meets on its way over an edge, in section: ball, fit, HIP and contact point before and past
/// it.
Chart drawEdge()
{
  constexpr std::int64_t kPoints = 47516;
  constexpr double kDepth = 2e-3;
  constexpr double kSlab = 3e-4;
  constexpr double kShown = 6e-3;
  Chart chart{ "touch-edge", "A hand slides over the edge of a box, 2 mm deep",
    { "x from the edge (mm)", false }, { "z from the top (mm)", false }, {}, true };
  const std::vector<Vec3> points = proxy::pointsOf(Shape::Box, kPoints, 0.0);
  Series cloud{ "points of the cloud", {}, {}, false };
  for (const Vec3& p : points)
  {
    if (std::abs(p.y) < kSlab && p.x > kHalf - kShown && p.z > kHalf - kShown)
    {
      cloud.x.push_back(1e3 * (p.x - kHalf));
      cloud.y.push_back(1e3 * (p.z - kHalf));
    }
  }
  chart.series = { cloud, { "HIP", {}, {}, false }, { "contact point", {}, {}, false } };
  TouchSceneSettings settings;
  const TouchScene scene = makeTouchScene(points, settings);
  if (!scene.scene)
  {
    return chart;
  }
  TouchStroke stroke;
  const Vec3 low(kHalf - 4e-3, 0.0, kHalf - kDepth);
  moveTo(stroke, low + Vec3(0.0, 0.0, 5e-3), low, kPressSpeed);
  moveTo(stroke, low, low + Vec3(6e-3, 0.0, 0.0), 0.05);
  SurfaceFitProxy proxy;
  const auto memory = std::make_unique<SurfaceFitProxy::Memory>(InstructionSet::Automatic);
  const std::pair<double, const char*> shown[] = { { -3e-3, "on the top" }, { -4e-4, "at the edge" },
    { 1.5e-3, "past it" } };
  std::size_t next = 0;
  for (const Vec3& hip : stroke.hip)
  {
    ProxyState felt;
    proxy.step(*scene.scene, *memory, ContactParameters(), hip, true, felt);
    if (next < std::size(shown) && hip.z <= low.z + 1e-9 && hip.x - kHalf >= shown[next].first)
    {
      const std::string where = shown[next++].second;
      const double radius = proxy.ball().radius();
      chart.series.push_back(circle("ball " + where, proxy.ball().center(), radius));
      if (felt.contact && proxy.fit())
      {
        chart.series.push_back(curve("fit " + where, *proxy.fit(), radius));
      }
      chart.series[1].x.push_back(1e3 * (hip.x - kHalf));
      chart.series[1].y.push_back(1e3 * (hip.z - kHalf));
      chart.series[2].x.push_back(1e3 * (felt.proxy.x - kHalf));
      chart.series[2].y.push_back(1e3 * (felt.proxy.z - kHalf));
    }
  }
  return chart;
}

void addEdgeFigures(StudyContext& context, ReportPart& part, const EdgeCloud& cloud, const std::string& box,
  const std::string& over, const std::string& method, const EdgeFigures& figures, const TouchFigures& all)
{
  addFigures(context, part,
    { grouped(cloud.points), proxy::noiseName(cloud.noise), box, over, method, brief(figures.bandNewton[0]),
      brief(figures.bandNewton[1]), brief(figures.bandNewton[2]), brief(figures.outsideNewton),
      fmt::format("{}", figures.late), fmt::format("{}", figures.mostTicks), fmt::format("{}", figures.above),
      fmt::format("{}", figures.held) },
    { { "points", cloud.points }, { "noise_metres", cloud.noise }, { "box", box }, { "over", over },
      { "method", method }, { "to_100_um_newton", figures.bandNewton[0] },
      { "to_250_um_newton", figures.bandNewton[1] }, { "to_500_um_newton", figures.bandNewton[2] },
      { "outside_newton", figures.outsideNewton }, { "strokes_late", figures.late },
      { "most_ticks_late", figures.mostTicks }, { "strokes_above", figures.above },
      { "stuck", figures.held } },
    all);
}

} // namespace

ReportPart studyEdges(StudyContext& context)
{
  const TouchBenchmarkOptions& options = context.options;
  const int starts = options.quick ? 1 : 10;
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "Over the edge and the corner of a box";
  part.text = fmt::format(
    "A cube of 50 mm, pressed 1, 2 and 3 mm deep, slid over an edge or a corner at 50, 200 and 500 mm/s "
    "until the hand is 15 mm outside, {} starts each; {}. The largest force where the god object is free, by "
    "how far the hand is outside: to 0.1, 0.25 and 0.5 mm, and more than that (one spacing where the cloud "
    "is sparser). Late: strokes with more than {} N anywhere outside, and in how many ticks at most. Above: "
    "strokes with more than that further outside than 0.5 mm. Stuck: strokes with more than that at their "
    "end. Turned: no face is parallel to the lattice.",
    starts, sceneText(options), kForce);
  part.charts.push_back(drawEdge());
  setFigureHeader(part, { "points", "noise", "box", "over", "method" },
    { "to 0.1 mm N", "to 0.25 mm", "to 0.5 mm", "outside N", "late", "ticks", "above", "stuck" });
  for (const bool turned : { false, true })
  {
    for (const bool corner : { false, true })
    {
      const std::vector<TouchStroke> strokes = strokesOver(corner, starts);
      const std::vector<TouchTask> tasks = tasksOver(turned, strokes);
      for (const EdgeCloud& cloud : cloudsOf(options))
      {
        std::vector<Vec3> points = proxy::pointsOf(Shape::Box, cloud.points, cloud.noise);
        if (turned)
        {
          std::transform(points.begin(), points.end(), points.begin(), turnedAway);
        }
        const TouchScene scene = makeTouchScene(std::move(points), sceneSettings(options));
        if (!scene.scene)
        {
          continue;
        }
        const double spacing = std::sqrt(24.0 * kHalf * kHalf / double(cloud.points));
        for (const Contestant& contestant : contestantsNamed(options.methods, options.instructions))
        {
          context.progress(
            fmt::format("{} over the {} of a box", contestant.name, corner ? "corner" : "edge"));
          EdgeFigures figures;
          const TouchFigures all = judge(context, contestant, scene, tasks,
            [&](std::size_t i, const TouchTrace& trace)
            { add(strokes[i], trace, std::max(kLeastOutside, spacing), figures); });
          addEdgeFigures(context, part, cloud, turned ? "turned" : "straight", corner ? "corner" : "edge",
            contestant.name, figures, all);
        }
      }
    }
  }
  return part;
}

} // namespace touch
} // namespace bench
} // namespace pointhaptics
