#include "Benchmark/Commands/BenchTask.h"

#include "Benchmark/Commands/BenchScan.h"
#include "Options/OptionParsing.h"

#include "Benchmark/Proxy/ProxyBenchmark.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr double kMostProxyPoints = 1e8;
constexpr double kMostProxyStrokes = 100000;

struct ProxyOptions
{
  std::vector<double> points;
  std::vector<double> sizes;
  std::vector<std::string> shapes;
  std::vector<std::string> studies;
  std::vector<std::string> scans;
  std::int64_t strokes = 0; ///< 0: the default.
};

/// Shapes with a course; the idol has none.
std::vector<std::string> shapeWords()
{
  std::vector<std::string> words;
  for (const Shape shape : bench::proxy::ProxyBenchmarkOptions().shapes)
  {
    words.emplace_back(shapeName(shape));
  }
  return words;
}

BenchOutcome runProxy(
  const ProxyOptions& options, const BenchSettings& shared, const bench::Progress& progress)
{
  bench::proxy::ProxyBenchmarkOptions settings;
  if (shared.quick)
  {
    settings.makeQuick();
  }
  BenchOutcome outcome;
  for (const std::string& file : options.scans)
  {
    settings.scans.emplace_back();
    if (!readScan(file, settings.scans.back(), outcome.wrong))
    {
      return outcome;
    }
  }
  if (!options.points.empty())
  {
    settings.points.assign(options.points.begin(), options.points.end());
  }
  if (!options.sizes.empty())
  {
    settings.sizes.assign(options.sizes.begin(), options.sizes.end());
  }
  if (!options.shapes.empty())
  {
    settings.shapes.clear();
    for (const std::string& word : options.shapes)
    {
      settings.shapes.emplace_back();
      static_cast<void>(shapeFromName(word, settings.shapes.back()));
    }
  }
  settings.studies = options.studies;
  settings.strokes = options.strokes > 0 ? int(options.strokes) : settings.strokes;
  settings.repetitions = shared.repetitions > 0 ? shared.repetitions : settings.repetitions;
  outcome.report = bench::proxy::benchmarkProxy(settings, progress, outcome.wrong);
  return outcome;
}

BenchRun addProxyOptions(CLI::App& command)
{
  auto options = std::make_shared<ProxyOptions>();
  addWholeNumbers(
    command, "--points", options->points, kMostProxyPoints, "Numbers of points; default 47516,543652");
  addWholeNumbers(command, "--sizes", options->sizes, kMostProxyPoints,
    "Numbers of points for the study of size; default 1e4,1e5,1e6,1e7");
  addWords(command, "--shapes", options->shapes, shapeWords(), false, "Shapes to feel; default all");
  addWords(command, "--studies", options->studies, bench::proxy::studyWords(), false,
    "What to measure; default all, scans where there are some");
  command
    .add_option_function<std::string>(
      "--scans", [options](const std::string& text) { options->scans = CLI::detail::split(text, ','); },
      "Clouds of your own to feel")
    ->type_name("FILE,...");
  addInteger(
    command, "--strokes", options->strokes, 1, kMostProxyStrokes, "Strokes over each scan; default 60");
  return [options](const BenchSettings& shared, const bench::Progress& progress)
  { return runProxy(*options, shared, progress); };
}

} // namespace

BenchTask proxyTask()
{
  BenchTask task;
  task.name = "proxy";
  task.description = "Compare the felt force with the exact one, and time the updates";
  task.repetitions = bench::proxy::ProxyBenchmarkOptions().repetitions;
  task.hasThreads = false;
  task.addOptions = addProxyOptions;
  return task;
}

} // namespace app
} // namespace pointhaptics
