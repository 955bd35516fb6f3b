/// Is a hand let go that slides over the edge or the corner of a box into free space?
#include "Benchmark/Touch/Studies.h"

#include "Core/Base/PortableRandom.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pointhaptics::bench::touch
{
namespace
{

constexpr double kHalf = 0.025; ///< Half an edge of Shape::Box.
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

/// Strokes and their truths, turned away from the axes where asked.
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

} // namespace

void studyEdges(StudyContext& context)
{
  const TouchBenchmarkOptions& options = context.options;
  for (const bool turned : { false, true })
  {
    for (const bool corner : { false, true })
    {
      const std::vector<TouchStroke> strokes = strokesOver(corner, options.quick ? 1 : 10);
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
          context.run.say(
            fmt::format("{} over the {} of a box", contestant.name, corner ? "corner" : "edge"));
          EdgeFigures f;
          const TouchFigures all = judge(context, contestant, scene, tasks,
            [&](std::size_t i, const TouchTrace& trace)
            { add(strokes[i], trace, std::max(kLeastOutside, spacing), f); });
          addFigures(context, "edges",
            { { "points", cloud.points }, { "noise_metres", cloud.noise },
              { "box", turned ? "turned" : "straight" }, { "over", corner ? "corner" : "edge" },
              { "method", contestant.name }, { "to_100_um_newton", f.bandNewton[0] },
              { "to_250_um_newton", f.bandNewton[1] }, { "to_500_um_newton", f.bandNewton[2] },
              { "outside_newton", f.outsideNewton }, { "strokes_late", f.late },
              { "most_ticks_late", f.mostTicks }, { "strokes_above", f.above }, { "stuck", f.held } },
            all);
        }
      }
    }
  }
}

} // namespace pointhaptics::bench::touch
