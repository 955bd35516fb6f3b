#include "Benchmark/Commands/BenchTask.h"

#include "Options/OptionParsing.h"

#include "Benchmark/Resample/ResampleBenchmark.h"
#include "Benchmark/Resample/Rivals/Rival.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr double kMostResamplePoints = 1e8;
constexpr double kMostVoxels = 2097152;

struct ResampleOptions
{
  std::vector<double> points;
  std::vector<double> dimensions;
  BenchChoices choices;
};

BenchOutcome runResample(
  const ResampleOptions& options, const BenchSettings& shared, const bench::Progress& progress)
{
  bench::resample::ResampleBenchmarkOptions settings;
  if (shared.quick)
  {
    settings.makeQuick();
  }
  if (!options.points.empty())
  {
    settings.points.assign(options.points.begin(), options.points.end());
  }
  if (!options.dimensions.empty())
  {
    settings.dimensions.assign(options.dimensions.begin(), options.dimensions.end());
  }
  settings.threads = shared.threads;
  takeChoices(settings, options.choices, shared);
  bool allRight = false;
  BenchOutcome outcome;
  outcome.report = bench::resample::benchmarkResample(settings, progress, allRight);
  outcome.wrong =
    allRight ? "" : "an answer of vtkVoxelMeanResampler is wrong; look for \"wrong\" in the tables";
  return outcome;
}

BenchRun addResampleOptions(CLI::App& command)
{
  auto options = std::make_shared<ResampleOptions>();
  addWholeNumbers(command, "--points", options->points, kMostResamplePoints,
    "Numbers of points; default 1e4,1e5,543652,1e6,5e6");
  addWholeNumbers(command, "--dims", options->dimensions, kMostVoxels,
    "Voxels on an axis, for the study of voxel size; default 75,150,300,600,1200,4096");
  addChoices(command, options->choices, bench::resample::rivalWords(), bench::resample::studyWords());
  return [options](const BenchSettings& shared, const bench::Progress& progress)
  { return runResample(*options, shared, progress); };
}

} // namespace

BenchTask resampleTask()
{
  BenchTask task;
  task.name = "resample";
  task.description = "Time mean resampling: ours, PCL's, VTK's, Open3D's; answers checked first";
  task.addOptions = addResampleOptions;
  return task;
}

} // namespace app
} // namespace pointhaptics
