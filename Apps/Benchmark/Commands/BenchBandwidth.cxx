#include "Benchmark/Commands/BenchTask.h"

#include "Options/OptionParsing.h"

#include "Benchmark/Bandwidth/BandwidthBenchmark.h"
#include "Benchmark/Bandwidth/Rivals/Rival.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr std::int64_t kMostBandwidthPoints = 100000000;
constexpr std::int64_t kMostNeighbors = 1000;

struct BandwidthBenchOptions
{
  std::int64_t points = 0; ///< 0: the default.
  std::int64_t neighbors = 16;
  std::string file;
  BenchChoices choices;
};

BenchOutcome runBandwidthBench(
  const BandwidthBenchOptions& options, const BenchSettings& shared, const bench::Progress& progress)
{
  bench::bandwidth::BandwidthBenchmarkOptions settings;
  if (shared.quick)
  {
    settings.makeQuick();
  }
  settings.points = options.points > 0 ? options.points : settings.points;
  settings.neighbors = int(options.neighbors);
  settings.file = options.file;
  settings.threads = shared.threads;
  takeChoices(settings, options.choices, shared);
  bool allRight = false;
  BenchOutcome outcome;
  outcome.report = bench::bandwidth::benchmarkBandwidth(settings, progress, allRight);
  outcome.wrong = allRight
    ? ""
    : "an answer of ours is wrong; look for \"wrong\" and for the errors of our own rows in the tables";
  return outcome;
}

BenchRun addBandwidthOptions(CLI::App& command)
{
  auto options = std::make_shared<BandwidthBenchOptions>();
  addInteger(
    command, "--points", options->points, 100, kMostBandwidthPoints, "Points of the clouds; default 200000");
  addInteger(command, "--neighbors", options->neighbors, 1, kMostNeighbors,
    "Nearest neighbours the spread is taken from; default 16");
  command.add_option("--file", options->file, "A cloud of your own that joins the study of neighbour search")
    ->type_name("FILE");
  addChoices(command, options->choices, bench::bandwidth::rivalWords(), bench::bandwidth::studyWords());
  return [options](const BenchSettings& shared, const bench::Progress& progress)
  { return runBandwidthBench(*options, shared, progress); };
}

} // namespace

BenchTask bandwidthTask()
{
  BenchTask task;
  task.name = "bandwidth";
  task.description =
    "Time bandwidths, radii and densities against their error; PCL's, VTK's, nanoflann's beside";
  task.addOptions = addBandwidthOptions;
  return task;
}

} // namespace app
} // namespace pointhaptics
