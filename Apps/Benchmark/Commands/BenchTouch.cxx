#include "Benchmark/Commands/BenchTask.h"

#include "Benchmark/Commands/BenchScan.h"
#include "Options/OptionParsing.h"

#include "Benchmark/Harness/Instructions.h"
#include "Benchmark/Touch/Hard/HardScenes.h"
#include "Benchmark/Touch/Methods/TouchMethod.h"
#include "Benchmark/Touch/TouchBenchmark.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr std::int64_t kMostTouchPoints = 100000000;
constexpr std::int64_t kMostTouchStrokes = 100000;
constexpr std::int64_t kMostLate = 10000;

struct TouchOptions
{
  std::vector<std::string> scans;
  std::vector<std::string> meshes;
  std::vector<std::string> methods;
  std::vector<std::string> studies;
  std::vector<std::string> families;
  std::vector<double> sizes;
  std::int64_t points = 0;  ///< 0: the default.
  std::int64_t strokes = 0; ///< 0: the default.
  int strokeSet = 0;
  int instructions = int(InstructionSet::Automatic);
  bool raw = false;
  bool whole = false;
  std::int64_t late = bench::touch::TouchBenchmarkOptions().lateTicks;
  CLI::Option* meshesOption = nullptr;
};

bench::touch::TouchMesh meshOf(bench::proxy::Scan scan)
{
  bench::touch::TouchMesh mesh;
  mesh.name = std::move(scan.name);
  mesh.points = std::move(scan.points);
  mesh.triangles = std::move(scan.triangles);
  mesh.isScan = true;
  return mesh;
}

BenchOutcome runTouch(
  const TouchOptions& options, const BenchSettings& shared, const bench::Progress& progress)
{
  bench::touch::TouchBenchmarkOptions settings;
  if (shared.quick)
  {
    settings.makeQuick();
  }
  settings.instructions = InstructionSet(options.instructions);
  BenchOutcome outcome;
  if (!bench::hasInstructions(settings.instructions))
  {
    outcome.wrong = "this machine does not have the instruction set of --instructions";
    return outcome;
  }
  for (const std::string& file : options.scans)
  {
    bench::proxy::Scan scan;
    if (!readScan(file, scan, outcome.wrong))
    {
      return outcome;
    }
    settings.scans.push_back(meshOf(std::move(scan)));
  }
  if (options.meshesOption->count() > 0)
  {
    settings.meshes = options.meshes;
  }
  settings.methods = options.methods;
  settings.studies = options.studies;
  settings.families = options.families;
  settings.points = options.points > 0 ? options.points : settings.points;
  if (!options.sizes.empty())
  {
    settings.sizes.assign(options.sizes.begin(), options.sizes.end());
  }
  settings.strokes = options.strokes > 0 ? int(options.strokes) : settings.strokes;
  settings.strokeSet = bench::touch::StrokeSet(options.strokeSet);
  settings.raw = options.raw;
  settings.local = !options.whole;
  settings.lateTicks = int(options.late);
  settings.repetitions = shared.repetitions > 0 ? shared.repetitions : settings.repetitions;
  outcome.report = bench::touch::benchmarkTouch(settings, progress, outcome.wrong);
  return outcome;
}

BenchRun addTouchOptions(CLI::App& command)
{
  auto options = std::make_shared<TouchOptions>();
  command
    .add_option_function<std::string>(
      "--scans", [options](const std::string& text) { options->scans = CLI::detail::split(text, ','); },
      "Scans to touch: with a mesh (PLY), and for the study hard any cloud")
    ->type_name("FILE,...");
  options->meshesOption = addWords(command, "--meshes", options->meshes, bench::touch::generatedMeshNames(),
    true, "Generated meshes to touch, or none; default all");
  addInteger(
    command, "--points", options->points, 1, kMostTouchPoints, "Samples of each mesh; default 543652");
  addWholeNumbers(command, "--sizes", options->sizes, kMostTouchPoints,
    "Samples of each mesh for the study of size; default 1e4,1e7");
  addInteger(
    command, "--strokes", options->strokes, 1, kMostTouchStrokes, "Strokes on each mesh; default 60");
  addChoice(command, "--stroke-set", options->strokeSet,
    { { "a", int(bench::touch::StrokeSet::A) }, { "b", int(bench::touch::StrokeSet::B) } },
    "Which strokes: two sets that share no place; default a");
  command.add_flag("--raw", options->raw, "Touch the points themselves, no voxels");
  command.add_flag("--whole", options->whole, "One scene of the whole cloud, no finer ones near the hand");
  addInteger(command, "--late", options->late, 0, kMostLate,
    fmt::format(
      "Milliseconds from the look at where the hand is until the finer scene there is felt; default {}",
      options->late));
  std::vector<std::pair<std::string, int>> sets;
  for (const bench::NamedInstructionSet& one : bench::kInstructionSets)
  {
    sets.emplace_back(one.word, int(one.set));
  }
  addChoice(command, "--instructions", options->instructions, std::move(sets),
    "Hold the updates to this instruction set; default the best of the machine");
  addWords(command, "--methods", options->methods, bench::touch::contestantNames(), false,
    "Methods to judge; default all");
  addWords(command, "--studies", options->studies, bench::touch::studyWords(), false,
    "What to measure; default all but hard");
  addWords(command, "--scenes", options->families, bench::touch::hard::hardFamilies(), false,
    "Families of scenes of the study hard; default all");
  return [options](const BenchSettings& shared, const bench::Progress& progress)
  { return runTouch(*options, shared, progress); };
}

} // namespace

BenchTask touchTask()
{
  BenchTask task;
  task.name = "touch";
  task.description = "Judge the touch of edges, thin parts and scans by a god object on their meshes";
  task.repetitions = bench::touch::TouchBenchmarkOptions().repetitions;
  task.hasThreads = false;
  task.addOptions = addTouchOptions;
  return task;
}

} // namespace app
} // namespace pointhaptics
