#include "Benchmark/Render/FileBenchmark.h"

#include "Benchmark/Harness/Machine.h"
#include "Benchmark/Harness/Statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <filesystem>
#include <functional>

namespace pointhaptics
{
namespace bench
{
namespace render
{
namespace
{

/// Frames of all points are slow: so many less are drawn.
constexpr int kFewer = 4;

struct Times
{
  Quartiles wall;         ///< Seconds of a frame.
  double processor = 0.0; ///< The same that all threads work, the least.
};

/// Of @p frame, which is called @p count times.
Times timesOf(int count, const std::function<void()>& frame)
{
  std::vector<double> wall;
  std::vector<double> processor;
  for (int i = 0; i < count; ++i)
  {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t work = std::clock();
    frame();
    processor.push_back(double(std::clock() - work) / CLOCKS_PER_SEC);
    wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return { quartiles(wall), quartiles(processor).minimum };
}

/// In the order of Effect.
constexpr std::array<const char*, 4> kEffects = { "discs", "sizes", "tilt", "shading" };

struct FileCost
{
  std::int64_t drawn = 0; ///< In a frame in motion.
  Times motion;           ///< Of a frame with level of detail.
  /// Of a frame of all points with the effects up to each, processor seconds.
  std::array<double, kEffects.size()> upTo{};
  double still = 0.0; ///< Shortest seconds of the picture at rest.
};

/// Effects are told in the time that all threads work: what else the machine does changes that least.
FileCost measure(Turntable& table, int frames)
{
  const auto turn = [&table] { table.turn(kDegreesPerFrame); };
  FileCost cost{};
  table.setDetail(true);
  timesOf(frames / 2, turn); // the budget settles, and the levels are uploaded
  double drawn = 0.0;
  cost.motion = timesOf(frames,
    [&]
    {
      turn();
      drawn += double(table.drawnPoints()) / frames;
    });
  cost.drawn = std::int64_t(drawn);
  table.setDetail(false);
  for (std::size_t i = 0; i < kEffects.size(); ++i)
  {
    table.setEffects(Effect(i));
    turn(); // what changed is uploaded
    cost.upTo[i] = timesOf(std::max(2, frames / kFewer), turn).processor;
  }
  cost.still = timesOf(3, [&table] { table.turnToStill(kDegreesPerFrame); }).wall.minimum;
  return cost;
}

void addRow(ReportPart& part, const std::string& file, const Turntable& table, const FileCost& cost)
{
  std::vector<std::string> cells{ file, table.kind(), grouped(table.allPoints()),
    fmt::format("{:.1f}", 1.0 / cost.motion.wall.median), grouped(cost.drawn),
    brief(1e3 * cost.motion.processor), brief(1e3 * cost.still) };
  nlohmann::ordered_json row{ { "file", file }, { "kind", table.kind() }, { "points", table.allPoints() },
    { "frames_per_second", 1.0 / cost.motion.wall.median },
    { "motion_median_seconds", cost.motion.wall.median },
    { "motion_upper_quartile_seconds", cost.motion.wall.upper },
    { "motion_processor_seconds", cost.motion.processor }, { "drawn", cost.drawn },
    { "still_seconds", cost.still } };
  for (std::size_t i = 0; i < kEffects.size(); ++i)
  {
    row[std::string(kEffects[i]) + "_seconds"] = cost.upTo[i];
    cells.push_back(
      i == 0 ? brief(1e3 * cost.upTo[0]) : fmt::format("{:+.1f}", 1e3 * (cost.upTo[i] - cost.upTo[i - 1])));
  }
  cells.push_back(brief(1e3 * cost.upTo.back()));
  part.table.rows.push_back(std::move(cells));
  part.rows.push_back(std::move(row));
}

} // namespace

Report benchmarkFiles(const RenderBenchmarkOptions& options, const Progress& progress, std::string& wrong)
{
  Report report;
  report.task = "render-files";
  report.title = "The picture by kind of cloud";
  report.method =
    "Each file drawn as the viewer draws it, with the look it chooses for that kind of cloud; off "
    "the screen, without words. Without a graphics card, Mesa's software renderer draws on all "
    "cores.";
  report.machine = thisMachine();
  ReportPart part;
  part.key = "files";
  part.title = "Frames in motion, at rest, and what each effect costs";
  part.text = fmt::format(
    "Frames of {} x {} pixels, {} degrees each. \"fps\" is that of the median of {} frames in motion with "
    "level of "
    "detail, \"drawn\" the mean number of points in one, \"still ms\" the time of the picture at rest: all "
    "points, "
    "blended. All other columns are the time that all threads together work on a frame, the "
    "least "
    "that was seen: \"motion\" with level of detail, and of {} frames of all points without it round discs "
    "of 3 "
    "pixels; what sizes by the spacing add; light, tilt and depth by the normals, and the blending; "
    "eye-dome light; and the sum.",
    options.width, options.fileHeight, kDegreesPerFrame, options.frames,
    std::max(2, options.frames / kFewer));
  part.table.header = { "file", "kind", "points", "fps", "drawn", "motion ms", "still ms", "discs ms",
    "sizes", "tilt", "shading", "all ms" };
  for (const std::string& file : options.files)
  {
    const std::string name = std::filesystem::path(file).filename().string();
    progress("drawing " + name);
    std::string message;
    const std::unique_ptr<Turntable> table =
      options.makeTurntable(file, options.width, options.fileHeight, message);
    if (!table)
    {
      wrong = message;
      break;
    }
    addRow(part, name, *table, measure(*table, options.frames));
  }
  if (wrong.empty())
  {
    report.parts.push_back(std::move(part));
  }
  return report;
}

} // namespace render
} // namespace bench
} // namespace pointhaptics
