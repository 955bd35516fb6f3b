#include "Benchmark/Render/RenderBenchmark.h"

#include "Benchmark/Harness/Machine.h"
#include "Benchmark/Harness/Statistics.h"
#include "Benchmark/Render/FileBenchmark.h"
#include "Benchmark/Render/WholeProcess.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>

namespace pointhaptics
{
namespace bench
{
namespace render
{
namespace
{

constexpr const char* kMethod =
  "The statue of `pointhaptics generate idol` as a binary PLY file in the page cache, drawn as the viewer "
  "draws it: the points of the file as tilted discs with eye-dome light, the workspace; off the screen, "
  "without the chart. Without a graphics card, Mesa's software renderer draws on all cores.";

struct Context
{
  const RenderBenchmarkOptions& options;
  const Progress& progress;
  std::filesystem::path folder;
  std::string wrong;

  std::string fileOf(std::int64_t points) const
  {
    return (folder / fmt::format("idol-{}.ply", points)).string();
  }
};

double seconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

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
    const double begin = seconds();
    table.turn(kDegreesPerFrame);
    times.push_back(seconds() - begin);
    drawn += double(table.drawnPoints());
  }
  drawn /= frames;
  return quartiles(times);
}

void addTurn(Context& context, std::int64_t points, ReportPart& part, std::vector<Series>& series)
{
  std::string message;
  const std::unique_ptr<Turntable> table = context.options.makeTurntable(
    context.fileOf(points), context.options.width, context.options.height, message);
  if (!table)
  {
    context.wrong = message;
    return;
  }
  for (const bool detail : { false, true })
  {
    context.progress(
      fmt::format("turning {} points {} level of detail", grouped(points), detail ? "with" : "without"));
    table->setDetail(detail);
    double drawn = 0.0;
    const Quartiles q = timeOfFrames(*table, context.options.frames, drawn);
    const double begin = seconds();
    const int refinements = table->rest();
    const double refined = seconds() - begin;
    part.table.rows.push_back({ grouped(points), grouped(table->allPoints()), detail ? "yes" : "no",
      grouped(static_cast<long long>(drawn)), brief(1e3 * q.median),
      fmt::format("{} - {}", brief(1e3 * q.lower), brief(1e3 * q.upper)),
      fmt::format("{:.1f}", 1.0 / q.median),
      detail ? fmt::format("{} in {}", brief(1e3 * refined), refinements) : "-" });
    part.rows.push_back({ { "points", points }, { "all", table->allPoints() }, { "detail", detail },
      { "drawn", drawn }, { "median_seconds", q.median }, { "lower_quartile_seconds", q.lower },
      { "upper_quartile_seconds", q.upper }, { "frames_per_second", 1.0 / q.median },
      { "refining_seconds", refined }, { "refining_frames", refinements } });
    addPoint(series, detail ? "level of detail" : "all points", double(points), 1.0 / q.median);
    if (table->drawnPoints() != table->allPoints())
    {
      context.wrong = "at rest the picture does not show all points; look at LevelOfDetail";
    }
  }
}

ReportPart studyTurning(Context& context)
{
  ReportPart part;
  part.key = "turning";
  part.title = "Turning the camera";
  part.text = fmt::format(
    "{} frames of {} x {} pixels, {} degrees each; half as many before them are not timed. \"drawn\" is the "
    "mean number of points in a frame. \"refined\" is the time from the last frame of the motion to the "
    "picture of all points, and the number of frames, with the {} s of rest before.",
    context.options.frames, context.options.width, context.options.height, kDegreesPerFrame, 0.15);
  part.table.header = { "points in the file", "points drawn at rest", "level of detail", "drawn", "median ms",
    "quartiles ms", "fps", "refined ms" };
  std::vector<Series> series;
  for (const std::int64_t points : context.options.points)
  {
    addTurn(context, points, part, series);
  }
  Chart chart;
  chart.fileName = "render-turning";
  chart.title = fmt::format("Turning, {} x {}", context.options.width, context.options.height);
  chart.x.title = "points in the file";
  chart.y.title = "frames per second";
  chart.series = series;
  part.charts.push_back(chart);
  return part;
}

void addFirstPicture(Context& context, std::int64_t points, ReportPart& part)
{
  const std::string file = context.fileOf(points);
  const std::string picture = (context.folder / "picture.png").string();
  const std::string size = fmt::format("{}x{}", context.options.width, context.options.height);
  struct Program
  {
    std::string name;
    std::vector<std::string> words;
    std::vector<double> seconds;
    std::int64_t peakBytes = 0;
    bool failed = false;
  };
  std::vector<Program> programs = { { "pointhaptics view",
    { viewerProgram(), "view", file, "--screenshot", picture, "--size", size }, {}, 0, false } };
  if (context.options.withF3d && programExists("f3d"))
  {
    programs.push_back({ "f3d",
      { "f3d", file, "--output=" + picture,
        fmt::format("--resolution={},{}", context.options.width, context.options.height) },
      {}, 0, false });
  }
  // Round by round: what slows the machine for a while slows all.
  for (int round = 0; round <= context.options.repetitions; ++round)
  {
    for (Program& program : programs)
    {
      context.progress(fmt::format("first picture of {} points: {}", grouped(points), program.name));
      const ProcessRun run = runProcess(program.words);
      program.failed = program.failed || run.exitCode != 0;
      program.peakBytes = std::max(program.peakBytes, run.peakBytes);
      if (round > 0) // the first one warms the caches
      {
        program.seconds.push_back(run.seconds);
      }
    }
  }
  for (const Program& program : programs)
  {
    const Quartiles q = quartiles(program.seconds);
    const double ratio = pairedRatios(program.seconds, programs.front().seconds).median;
    part.table.rows.push_back({ grouped(points), program.name, brief(q.median),
      fmt::format("{} - {}", brief(q.lower), brief(q.upper)), brief(ratio),
      brief(double(program.peakBytes) / 1e6), program.failed ? "failed" : "done" });
    part.rows.push_back({ { "points", points }, { "program", program.name }, { "median_seconds", q.median },
      { "lower_quartile_seconds", q.lower }, { "upper_quartile_seconds", q.upper }, { "times_ours", ratio },
      { "peak_bytes", program.peakBytes }, { "failed", program.failed } });
  }
  if (programs.front().failed)
  {
    context.wrong = "`pointhaptics view --screenshot` failed; run it by hand to see why";
  }
}

ReportPart studyFirstPicture(Context& context)
{
  ReportPart part;
  part.key = "first_picture";
  part.title = "Time to the first picture, and memory";
  part.text = fmt::format(
    "The whole process, from its start until the picture of {} x {} pixels is written and it has ended. Both "
    "show all points. Memory is the highest that was resident, libraries included.",
    context.options.width, context.options.height);
  part.table.header = { "points", "program", "median s", "quartiles s", "x ours", "peak MB", "" };
  for (const std::int64_t points : context.options.points)
  {
    addFirstPicture(context, points, part);
  }
  if (!context.options.withF3d || !programExists("f3d"))
  {
    part.remarks.push_back("f3d was not run.");
  }
  return part;
}

void addResponse(Context& context, std::int64_t points, ReportPart& part)
{
  std::string message;
  const std::unique_ptr<ModelMover> mover = context.options.makeModelMover(
    context.fileOf(points), context.options.width, context.options.height, message);
  if (!mover)
  {
    context.wrong = message;
    return;
  }
  struct Action
  {
    const char* name;
    const char* keys[2]; // there and back
  };
  for (const Action& action : { Action{ "rotate", { "y", "Y" } }, Action{ "translate", { "Left", "Right" } },
         Action{ "scale", { "plus", "minus" } } })
  {
    context.progress(fmt::format("response of {} points: {}", grouped(points), action.name));
    std::vector<double> moved;
    std::vector<double> near;
    std::vector<double> whole;
    for (int i = 0; i < context.options.presses; ++i)
    {
      const ModelMover::Response response = mover->press(action.keys[i % 2]);
      if (response.wholeSeconds < 0.0)
      {
        context.wrong = "a key was pressed and no scene came of it; look at SceneWorker";
        return;
      }
      moved.push_back(response.movedSeconds);
      near.push_back(response.nearSeconds);
      whole.push_back(response.wholeSeconds);
    }
    const auto sorted = [](std::vector<double>& times, double fraction)
    {
      std::sort(times.begin(), times.end());
      return times[std::size_t(fraction * double(times.size() - 1) + 0.5)];
    };
    part.table.rows.push_back(
      { grouped(points), action.name, fmt::format("{}", moved.size()), brief(1e3 * sorted(moved, 0.5)),
        brief(1e3 * sorted(moved, 0.95)), brief(1e3 * sorted(near, 0.5)), brief(1e3 * sorted(near, 0.95)),
        brief(1e3 * near.back()), brief(1e3 * sorted(whole, 0.5)), brief(1e3 * sorted(whole, 0.95)) });
    part.rows.push_back({ { "points", points }, { "action", action.name }, { "presses", moved.size() },
      { "moved_median_seconds", sorted(moved, 0.5) }, { "moved_p95_seconds", sorted(moved, 0.95) },
      { "near_median_seconds", sorted(near, 0.5) }, { "near_p95_seconds", sorted(near, 0.95) },
      { "near_largest_seconds", near.back() }, { "whole_median_seconds", sorted(whole, 0.5) },
      { "whole_p95_seconds", sorted(whole, 0.95) } });
  }
}

ReportPart studyResponse(Context& context)
{
  ReportPart part;
  part.key = "response";
  part.title = "From a key to the hand";
  part.text = fmt::format(

    "Keys that rotate the model by 5 degrees, translate it by 2 % of the workspace and scale it by 10\n"
    "%, and back, in a window of {} x {} pixels, off the screen, with level of detail and a servo\n"
    "loop of 1 kHz. The hand stays where it is, at first 1 mm deep in the front of the statue. The\n"
    "viewer's timer goes on meanwhile and renders. Each key is pressed after all that the last one\n"
    "asked for has come. Times are from the key's event until the servo thread had the scene.\n"
    "\n"
    "- moved: the old voxels are felt where the model is now.\n"
    "- at the hand: new voxel means under the new transform, with covariance and the fields of radii,\n"
    "  of what the hand can reach: 4 mm around it and the contact, where forces are those of the\n"
    "  whole cloud. A hand that goes further feels the moved voxels until the rest is there.\n"
    "- whole: the same of the whole cloud; its time stands in both where it came first.",
    context.options.width, context.options.height);
  part.table.header = { "points in the file", "key", "presses", "moved p50 ms", "moved p95 ms",
    "at the hand p50 ms", "at the hand p95 ms", "largest ms", "whole p50 ms", "whole p95 ms" };
  for (const std::int64_t points : context.options.points)
  {
    addResponse(context, points, part);
  }
  return part;
}

bool makeFiles(Context& context)
{
  for (const std::int64_t points : context.options.points)
  {
    context.progress(fmt::format("making {} points", grouped(points)));
    const ProcessRun run = runProcess(
      { viewerProgram(), "generate", "idol", "-n", fmt::format("{}", points), "-o", context.fileOf(points) });
    if (run.exitCode != 0)
    {
      context.wrong = fmt::format(
        "a file of {} points cannot be made in {}; free some space there, or set TMPDIR to another folder",
        grouped(points), context.folder.string());
      return false;
    }
  }
  return true;
}

} // namespace

void RenderBenchmarkOptions::makeQuick()
{
  points = { 100000 };
  frames = 6;
  presses = 4;
  repetitions = 1;
  width = 320;
  height = 180;
  fileHeight = 200;
}

Report benchmarkRender(const RenderBenchmarkOptions& options, const Progress& progress, std::string& wrong)
{
  if (!options.files.empty())
  {
    return benchmarkFiles(options, progress, wrong);
  }
  Report report;
  report.task = "render";
  report.title = "The viewer's picture";
  report.method = kMethod;
  report.machine = thisMachine();
  std::string name = (std::filesystem::temp_directory_path() / "pointhaptics-render-XXXXXX").string();
  if (!::mkdtemp(name.data()))
  {
    wrong = fmt::format("{}: no folder can be made there; set TMPDIR to one that can be written",
      std::filesystem::temp_directory_path().string());
    return report;
  }
  Context context{ options, progress, name, {} };
  if (makeFiles(context))
  {
    // Processes first: this one is small then.
    ReportPart first = studyFirstPicture(context);
    report.parts.push_back(studyTurning(context));
    report.parts.push_back(studyResponse(context));
    report.parts.push_back(std::move(first));
  }
  std::error_code ignored;
  std::filesystem::remove_all(context.folder, ignored);
  wrong = context.wrong;
  return report;
}

} // namespace render
} // namespace bench
} // namespace pointhaptics
