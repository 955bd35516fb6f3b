#include "Benchmark/Commands/BenchTask.h"

#include "Benchmark/Scenery/SceneTurntable.h"
#include "Options/OptionParsing.h"
#include "ViewDisplay.h"

#include "Benchmark/Render/WholeProcess.h"
#include "Benchmark/Servo/ServoBenchmark.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr std::int64_t kMostServoPoints = 100000000;
constexpr double kLongestRun = 86400.0;
constexpr double kQuickSeconds = 0.4;
constexpr std::int64_t kQuickPoints = 30000;

struct ServoOptions
{
  std::int64_t points = 0;
  double seconds = 0.0;
  std::vector<std::string> hands, loads, rates;
};

/// The viewer's picture of the cloud of @p points, turned by a degree a call. Null: there is none, and rows
/// with drawing are left out.
std::function<void()> makeDrawing(int points)
{
  constexpr int kWidth = 1280;
  constexpr int kHeight = 720;
  std::string folder = (std::filesystem::temp_directory_path() / "pointhaptics-servo-XXXXXX").string();
  if (!::mkdtemp(folder.data()))
  {
    return nullptr;
  }
  const std::string file = folder + "/sphere.ply";
  const bench::render::ProcessRun made = bench::render::runProcess(
    { bench::render::viewerProgram(), "generate", "sphere", "-n", std::to_string(points), "-o", file });
  std::string message;
  const std::shared_ptr<bench::render::Turntable> table =
    made.exitCode == 0 ? makeSceneTurntable(file, kWidth, kHeight, message) : nullptr;
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  if (!table)
  {
    return nullptr;
  }
  table->setDetail(true);
  return [table] { table->turn(1.0); };
}

bool isWanted(const std::string& word, const std::vector<std::string>& words)
{
  return words.empty() || std::find(words.begin(), words.end(), word) != words.end();
}

BenchOutcome runServo(
  const ServoOptions& options, const BenchSettings& shared, const bench::Progress& progress)
{
  bench::servo::ServoBenchmarkOptions settings;
  std::string whyNot;
  settings.points = int(options.points > 0 ? options.points : shared.quick ? kQuickPoints : settings.points);
  settings.seconds = options.seconds > 0.0 ? options.seconds
    : shared.quick                         ? kQuickSeconds
                                           : settings.seconds;
  settings.hands = options.hands;
  settings.loads = options.loads;
  settings.rates = options.rates;
  if (!shared.quick && isWanted("drawing", options.loads) && displayIsAvailable(whyNot))
  {
    progress("making the viewer's picture");
    settings.draw = makeDrawing(settings.points);
  }
  bool allRight = false;
  BenchOutcome outcome;
  outcome.report = bench::servo::benchmarkServo(settings, progress, allRight);
  if (outcome.report.parts.empty())
  {
    outcome.wrong =
      "nothing was measured: the falcon runs at 1000 Hz only, and drawing needs a display; choose "
      "other --hands, --loads or --rates";
    return outcome;
  }
  outcome.wrong =
    allRight ? "" : "a force of the servo loop or a round trip is wrong; look for \"wrong\" in the table";
  return outcome;
}

BenchRun addServoOptions(CLI::App& command)
{
  auto options = std::make_shared<ServoOptions>();
  addInteger(
    command, "--points", options->points, 1000, kMostServoPoints, "Points of the cloud; default 543652");
  addNumber(command, "--seconds", options->seconds, { 0.0, kLongestRun, true }, "S",
    "Length of each run; default 10");
  addWords(
    command, "--hands", options->hands, bench::servo::handWords(), false, "Whose hand to run; default all");
  addWords(command, "--loads", options->loads, bench::servo::loadWords(), false,
    "What the machine does meanwhile; default all, drawing where there is a display");
  addWords(command, "--rates", options->rates, bench::servo::rateWords(), false,
    "Ticks a second; default all, the Falcon's at 1000 only");
  return [options](const BenchSettings& shared, const bench::Progress& progress)
  { return runServo(*options, shared, progress); };
}

} // namespace

BenchTask servoTask()
{
  BenchTask task;
  task.name = "servo";
  task.description = "Time the servo loop: step time, jitter, deadline misses; idle, loaded, drawing";
  task.hasThreads = false;
  task.addOptions = addServoOptions;
  return task;
}

} // namespace app
} // namespace pointhaptics
