/// How fast does the viewer's picture turn, and how soon is there one?
#include "Benchmark/Harness/Race.h"
#include "Benchmark/Render/Turntable.h"
#include "Benchmark/Render/WholeProcess.h"
#include "Benchmark/Tasks.h"
#include "Options/OptionParsing.h"
#include "ViewDisplay.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace pointhaptics::bench::render
{
namespace
{

using namespace app;

constexpr double kMostPoints = 1e8;
constexpr double kDegreesPerFrame = 2.0;

struct Options
{
  std::vector<double> points;
  std::vector<std::string> files;
  bool noF3d = false;
};

/// The files to draw, and the pictures of each.
struct Plan
{
  std::vector<std::string> files;
  int width = 1280;
  int height = 720;
  int frames = 60; ///< Frames of a turn; half as many come before, untimed, for the budget to settle.
  bool withF3d = true;
};

Quartiles timeOfFrames(Turntable& table, int frames, double& drawn)
{
  for (int i = 0; i < frames / 2; ++i)
  {
    table.turn(kDegreesPerFrame);
  }
  std::vector<double> times;
  drawn = 0.0;
  for (int i = 0; i < frames; ++i)
  {
    const double begin = secondsNow();
    table.turn(kDegreesPerFrame);
    times.push_back(secondsNow() - begin);
    drawn += double(table.drawnPoints()) / frames;
  }
  return quartiles(times);
}

/// Frames in motion without and with level of detail, and the picture at rest after them.
void studyTurning(Run& run, const Plan& plan, const std::string& file)
{
  const std::string name = std::filesystem::path(file).filename().string();
  Turntable table;
  std::string message;
  if (!table.open(file, plan.width, plan.height, message))
  {
    run.fault(message);
    return;
  }
  for (const bool detail : { false, true })
  {
    run.say(fmt::format("turning {} {} level of detail", name, detail ? "with" : "without"));
    table.setDetail(detail);
    double drawn = 0.0;
    const Quartiles q = timeOfFrames(table, plan.frames, drawn);
    double begin = secondsNow();
    const int refinements = table.rest();
    const double refined = secondsNow() - begin;
    if (!table.showsAll())
    {
      run.fault("at rest the picture is not as fine as it can be; look at LevelOfDetail");
    }
    begin = secondsNow();
    table.turnToStill(kDegreesPerFrame);
    run.add("turning",
      { { "file", name }, { "kind", table.kind() }, { "all", table.allPoints() }, { "detail", detail },
        { "drawn", drawn }, { "median_seconds", q.median }, { "lower_quartile_seconds", q.lower },
        { "upper_quartile_seconds", q.upper }, { "frames_per_second", 1.0 / q.median },
        { "refining_seconds", refined }, { "refining_frames", refinements },
        { "still_seconds", secondsNow() - begin } });
  }
}

/// The whole process, from its start until the picture is written and it has ended.
void studyFirstPicture(Run& run, const Plan& plan, const std::string& file)
{
  const std::string picture = file + ".png";
  struct Program
  {
    std::string name;
    std::vector<std::string> words;
    std::vector<double> seconds = {};
    std::int64_t peakBytes = 0;
    bool failed = false;
  };
  std::vector<Program> programs{ { "pointhaptics view",
    { viewerProgram(), "view", file, "--screenshot", picture, "--size",
      fmt::format("{}x{}", plan.width, plan.height) } } };
  if (plan.withF3d && programExists("f3d"))
  {
    programs.push_back({ "f3d",
      { "f3d", file, "--output=" + picture, fmt::format("--resolution={},{}", plan.width, plan.height) } });
  }
  // Round by round: what slows the machine for a while slows all. The first round warms the caches.
  for (int round = 0; round <= run.repetitions; ++round)
  {
    for (Program& program : programs)
    {
      run.say("first picture: " + program.name);
      const ProcessRun process = runProcess(program.words);
      program.failed = program.failed || process.exitCode != 0;
      program.peakBytes = std::max(program.peakBytes, process.peakBytes);
      program.seconds.insert(program.seconds.end(), round > 0 ? 1 : 0, process.seconds);
    }
  }
  for (const Program& program : programs)
  {
    const Quartiles q = quartiles(program.seconds);
    run.add("first_picture",
      { { "file", std::filesystem::path(file).filename().string() }, { "program", program.name },
        { "median_seconds", q.median }, { "lower_quartile_seconds", q.lower },
        { "upper_quartile_seconds", q.upper },
        { "times_ours", pairedRatios(program.seconds, programs.front().seconds).median },
        { "peak_bytes", program.peakBytes }, { "failed", program.failed } });
  }
  if (programs.front().failed)
  {
    run.fault("`pointhaptics view --screenshot` failed; run it by hand to see why");
  }
}

/// The statue with each number of points, as files in @p folder.
bool makeFiles(Run& run, const std::vector<double>& points, const std::string& folder, Plan& plan)
{
  for (const double count : points)
  {
    run.say(fmt::format("making {} points", count));
    plan.files.push_back(fmt::format("{}/idol-{:.0f}.ply", folder, count));
    const ProcessRun made = runProcess(
      { viewerProgram(), "generate", "idol", "-n", fmt::format("{:.0f}", count), "-o", plan.files.back() });
    if (made.exitCode != 0)
    {
      run.fault(
        plan.files.back() + ": cannot be made; free some space there, or set TMPDIR to another folder");
      return false;
    }
  }
  return true;
}

void measure(const Options& options, Run& run)
{
  if (std::string whyNot; !displayIsAvailable(whyNot))
  {
    run.fault(whyNot);
    return;
  }
  Plan plan;
  if (run.quick)
  {
    plan = { {}, 320, 180, 6, true };
  }
  plan.withF3d = !options.noF3d;
  if (!options.files.empty())
  {
    for (const std::string& file : options.files)
    {
      studyTurning(run, plan, file);
    }
    return;
  }
  std::string folder = (std::filesystem::temp_directory_path() / "pointhaptics-render-XXXXXX").string();
  if (!::mkdtemp(folder.data()))
  {
    run.fault(folder + ": cannot be made; set TMPDIR to a folder that can be written");
    return;
  }
  if (makeFiles(run, run.chosen(options.points, { 543652, 5e6 }, { 1e5 }), folder, plan))
  {
    // Processes first: this one is small then.
    const std::pair<const char*, void (*)(Run&, const Plan&, const std::string&)> studies[] = {
      { "first_picture", studyFirstPicture }, { "turning", studyTurning }
    };
    for (const auto& [word, study] : studies)
    {
      for (std::size_t i = 0; run.wants(word) && i < plan.files.size(); ++i)
      {
        study(run, plan, plan.files[i]);
      }
    }
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
}

TaskRun addOptions(CLI::App& command)
{
  auto options = std::make_shared<Options>();
  addWholeNumbers(command, "--points", options->points, kMostPoints,
    "Points of the clouds that are drawn; default 543652,5000000");
  addFiles(command, "--file", options->files, "Clouds of your own to turn; nothing else is measured then");
  command.add_flag("--no-f3d", options->noF3d, "Leave out f3d, which runs beside ours where it is installed");
  return [options](Run& run) { measure(*options, run); };
}

} // namespace
} // namespace pointhaptics::bench::render

namespace pointhaptics::bench
{

Task renderTask()
{
  return { "render", "Time the viewer's picture: turning with and without level of detail, the first picture",
    5, 1, false, { "turning", "first_picture" }, {}, render::addOptions };
}

} // namespace pointhaptics::bench
