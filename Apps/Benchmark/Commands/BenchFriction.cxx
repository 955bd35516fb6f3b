#include "Benchmark/Commands/BenchTask.h"

#include "Benchmark/Friction/FrictionBenchmark.h"

#include <CLI/CLI.hpp>

namespace pointhaptics
{
namespace app
{
namespace
{

BenchRun addFrictionOptions(CLI::App&)
{
  return [](const BenchSettings& shared, const bench::Progress& progress)
  {
    bench::friction::FrictionBenchmarkOptions settings;
    if (shared.quick)
    {
      settings.makeQuick();
    }
    BenchOutcome outcome;
    outcome.report = bench::friction::benchmarkFriction(settings, progress, outcome.wrong);
    return outcome;
  };
}

} // namespace

BenchTask frictionTask()
{
  BenchTask task;
  task.name = "friction";
  task.description = "Compare the felt friction with mu at several speeds";
  task.repetitions = 1;
  task.hasThreads = false;
  task.addOptions = addFrictionOptions;
  return task;
}

} // namespace app
} // namespace pointhaptics
