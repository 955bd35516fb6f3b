#include "Benchmark/Commands/BenchModelMover.h"
#include "Benchmark/Commands/BenchTask.h"

#include "Benchmark/Scenery/SceneTurntable.h"
#include "Options/OptionParsing.h"
#include "ViewDisplay.h"

#include "Benchmark/Render/RenderBenchmark.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr double kMostRenderPoints = 1e8;

struct RenderOptions
{
  std::vector<double> points;
  std::vector<std::string> files;
  bool noF3d = false;
};

BenchOutcome runRender(
  const RenderOptions& options, const BenchSettings& shared, const bench::Progress& progress)
{
  BenchOutcome outcome;
  if (!displayIsAvailable(outcome.wrong))
  {
    return outcome;
  }
  bench::render::RenderBenchmarkOptions settings;
  if (shared.quick)
  {
    settings.makeQuick();
  }
  if (!options.points.empty())
  {
    settings.points.assign(options.points.begin(), options.points.end());
  }
  settings.files = options.files;
  settings.repetitions = shared.repetitions > 0 ? shared.repetitions : settings.repetitions;
  settings.withF3d = !options.noF3d;
  settings.makeTurntable = makeSceneTurntable;
  settings.makeModelMover = makeModelMover;
  outcome.report = bench::render::benchmarkRender(settings, progress, outcome.wrong);
  return outcome;
}

BenchRun addRenderOptions(CLI::App& command)
{
  auto options = std::make_shared<RenderOptions>();
  addWholeNumbers(command, "--points", options->points, kMostRenderPoints,
    "Points of the clouds that are drawn; default 543652,5000000");
  command
    .add_option_function<std::string>(
      "--file", [options](const std::string& text) { options->files = CLI::detail::split(text, ','); },
      "Clouds of your own, separated by commas: what the picture of each costs, as the viewer chooses it; "
      "nothing else is measured then")
    ->type_name("FILE,...");
  command.add_flag("--no-f3d", options->noF3d, "Leave out f3d, which runs beside ours where it is installed");
  return [options](const BenchSettings& shared, const bench::Progress& progress)
  { return runRender(*options, shared, progress); };
}

} // namespace

BenchTask renderTask()
{
  BenchTask task;
  task.name = "render";
  task.description = "Time the viewer's picture: turning with and without level of detail, the first picture";
  task.repetitions = 5;
  task.hasThreads = false;
  task.addOptions = addRenderOptions;
  return task;
}

} // namespace app
} // namespace pointhaptics
