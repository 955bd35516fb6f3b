/// How far is the felt force from the exact one with each method, and what does an update take?
#include "Benchmark/Proxy/Scenes.h"
#include "Benchmark/Proxy/Trial.h"
#include "Benchmark/Tasks.h"
#include "Options/OptionParsing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace pointhaptics::bench::proxy
{
namespace
{

using namespace app;

constexpr double kMostPoints = 1e8;
/// Percent of error that no clean shape may have with the default method; ten times what is measured.
constexpr double kSurelyWrong = 1.0;

struct Options
{
  std::vector<double> points;
  std::vector<std::string> shapes;
};

/// Shapes with a course: the idol has none.
const std::vector<Shape> kShapes{ Shape::Plane, Shape::Sphere, Shape::Torus, Shape::Ellipsoid, Shape::Saddle,
  Shape::Box, Shape::Sheet, Shape::Hole, Shape::DensityStep };

std::vector<std::string> shapeWords()
{
  std::vector<std::string> words;
  std::transform(kShapes.begin(), kShapes.end(), std::back_inserter(words), shapeName);
  return words;
}

ExactAnswer answerOf(Shape shape)
{
  return [shape](const Vec3& hip) { return exactContact(shape, hip, ContactParameters().stiffness); };
}

struct Contestant
{
  std::string name;
  HapticParameters parameters;
  SceneSettings scene;
};

HapticParameters gradientSteps(const GradientStepsParameters& gains)
{
  HapticParameters parameters;
  parameters.method = ProxyMethod::GradientSteps;
  parameters.gradientSteps = gains;
  return parameters;
}

/// The default first.
std::vector<Contestant> contestants()
{
  GradientStepsParameters few = GradientStepsParameters::tuned();
  few.maximumStepsPerTick = 4;
  std::vector<Contestant> all{ { "surface-fit (default)", {}, {} }, { "surface-fit, plain means", {}, {} },
    { "surface-fit, raw points", {}, {} }, { "surface-fit, 2/3 mm voxels", {}, {} },
    { "gradient-steps, tuned", gradientSteps(GradientStepsParameters::tuned()), {} },
    { "gradient-steps, tuned, 4 steps", gradientSteps(few), {} },
    { "gradient-steps, paper", gradientSteps(GradientStepsParameters::paper()), {} } };
  all[1].scene.covariances = false;
  all[2].scene.raw = true;
  all[3].scene.voxelSize = 2e-3 / 3.0;
  return all;
}

Json toJson(const TrialFigures& f)
{
  return { { "rms_percent", f.rmsPercent }, { "max_percent", f.maximumPercent },
    { "direction_rms_degrees", f.directionRmsDegrees },
    { "direction_max_degrees", f.directionMaximumDegrees }, { "largest_step", f.largestStep },
    { "energy_joule", f.energyJoule }, { "pop_throughs", f.popThroughs }, { "false_ticks", f.falseTicks },
    { "contact_ticks", f.contactTicks }, { "p50_us", f.p50 }, { "p99_us", f.p99 }, { "p999_us", f.p999 },
    { "max_us", f.maximum }, { "first_contact_us", f.firstContact } };
}

/// The default on every shape, and all methods on the torus or on the first shape that was asked for.
void studyMethods(Run& run, const std::vector<Shape>& shapes, const std::vector<double>& sizes,
  const std::vector<double>& noises)
{
  const bool hasTorus = std::find(shapes.begin(), shapes.end(), Shape::Torus) != shapes.end();
  const Shape compared = hasTorus ? Shape::Torus : shapes.front();
  for (const Shape shape : shapes)
  {
    for (const double size : sizes)
    {
      for (const double noise : noises)
      {
        const std::vector<Vec3> points = pointsOf(shape, std::int64_t(size), noise);
        for (const Contestant& contestant : contestants())
        {
          run.say(
            fmt::format("{}, {}, {} points, {}", contestant.name, shapeName(shape), size, noiseName(noise)));
          const Scene scene = sceneOf(points, contestant.scene);
          const TrialFigures f =
            runTrial(*scene, contestant.parameters, slideCourse(shape), answerOf(shape), run.repetitions);
          Json row{ { "shape", shapeName(shape) }, { "points", points.size() }, { "noise_metres", noise },
            { "method", contestant.name } };
          row.update(toJson(f));
          run.add("methods", std::move(row));
          const bool isDefault = contestant.name == contestants().front().name;
          if (isDefault && noise == 0.0 && (f.popThroughs > 0 || !(f.rmsPercent < kSurelyWrong)))
          {
            run.fault(fmt::format("surface-fit on the {}: {} pops, RMS error {:.3g} %", shapeName(shape),
              f.popThroughs, f.rmsPercent));
          }
          if (shape != compared)
          {
            break;
          }
        }
      }
    }
  }
}

TaskRun addOptions(CLI::App& command)
{
  auto options = std::make_shared<Options>();
  addWholeNumbers(
    command, "--points", options->points, kMostPoints, "Numbers of points; default 47516,543652");
  addWords(command, "--shapes", options->shapes, shapeWords(), false, "Shapes to feel; default all");
  return [options](Run& run)
  {
    const std::vector<double> points = run.chosen(options->points, { 47516, 543652 }, { 20000 });
    const std::vector<double> noises =
      run.quick ? std::vector<double>{ 0.0, 20e-6 } : std::vector<double>{ 0.0, 20e-6, 100e-6 };
    std::vector<Shape> shapes = run.quick ? std::vector<Shape>{ Shape::Sphere, Shape::Torus } : kShapes;
    if (!options->shapes.empty())
    {
      shapes.resize(options->shapes.size());
      for (std::size_t i = 0; i < shapes.size(); ++i)
      {
        static_cast<void>(shapeFromName(options->shapes[i], shapes[i]));
      }
    }
    studyMethods(run, shapes, points, noises);
  };
}

} // namespace
} // namespace pointhaptics::bench::proxy

namespace pointhaptics::bench
{

Task proxyTask()
{
  return { "proxy", "Compare the felt force with the exact one, and time the updates", 5, 1, false,
    { "methods" }, {}, proxy::addOptions };
}

} // namespace pointhaptics::bench
