#include "Benchmark/Commands/BenchTask.h"

#include "Options/OptionParsing.h"

#include "Benchmark/Io/IoBenchmark.h"
#include "Benchmark/Io/Rival.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr std::int64_t kMostIoPoints = 100'000'000;

struct IoOptions
{
  std::int64_t points = 0; ///< 0: the default.
  BenchChoices choices;
};

BenchOutcome runIo(const IoOptions& options, const BenchSettings& shared, const bench::Progress& progress)
{
  bench::io::IoBenchmarkOptions settings;
  if (shared.quick)
  {
    settings.makeQuick();
  }
  settings.points = options.points > 0 ? options.points : settings.points;
  takeChoices(settings, options.choices, shared);
  bool allRight = false;
  BenchOutcome outcome;
  outcome.report = bench::io::benchmarkIo(settings, progress, allRight);
  outcome.wrong =
    allRight ? "" : "vtkPointCloudReader or vtkPointCloudWriter is wrong; look for \"wrong\" in the tables";
  return outcome;
}

BenchRun addIoOptions(CLI::App& command)
{
  auto options = std::make_shared<IoOptions>();
  addInteger(command, "--points", options->points, 1, kMostIoPoints,
    "Points of the files that are read and written; default 543652");
  addChoices(command, options->choices, bench::io::rivalWords(), bench::io::studyWords());
  return [options](const BenchSettings& shared, const bench::Progress& progress)
  { return runIo(*options, shared, progress); };
}

} // namespace

BenchTask ioTask()
{
  BenchTask task;
  task.name = "io";
  task.description = "Time reading and writing of files: ours, VTK's, PCL's; answers checked first";
  task.hasThreads = false;
  task.addOptions = addIoOptions;
  return task;
}

} // namespace app
} // namespace pointhaptics
