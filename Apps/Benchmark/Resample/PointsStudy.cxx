#include "Benchmark/Resample/Clouds.h"
#include "Benchmark/Resample/Studies.h"

#include <fmt/format.h>
#include <vtkPolyData.h>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

/// What a point costs at the height of a race: the input, its copies in four forms, and scratch.
constexpr double kBytesPerPoint = 220.0;

bool fitsIntoMemory(std::int64_t points)
{
  const std::int64_t available = availableMemory();
  return available == 0 || kBytesPerPoint * double(points) < double(available);
}

struct Lines
{
  std::vector<Series> points;  ///< Time of a point against points: random order, most threads.
  std::vector<Series> threads; ///< Time against threads: random order, most points.
};

void addToLines(
  const RaceTable& race, std::int64_t count, int threads, const StudyContext& context, Lines& lines)
{
  const bool mostPoints = count == context.options.points.back();
  for (const RaceRow& row : race.rows)
  {
    if (threads == mostThreads(context))
    {
      addPoint(lines.points, row.name, double(count), 1e9 * row.seconds.median / double(count));
    }
    if (mostPoints)
    {
      addPoint(lines.threads, row.name, threads, 1e3 * row.seconds.median);
    }
  }
  if (threads == mostThreads(context))
  {
    addPoint(lines.points, "copy of the coordinates", double(count), 1e9 * race.copySeconds / double(count));
  }
}

void racePoints(std::int64_t count, PointOrder order, StudyContext& context, ReportPart& part, Lines& lines)
{
  const auto cloud = sphereCloud(count, order);
  const ResampleTask task = taskOn(cloud, context.options.dimension);
  for (const int threads : context.options.threads)
  {
    context.progress(fmt::format("{} points, {} order, {} threads", count, orderName(order), threads));
    const RaceTable race = raceOn(task, allRivals(context), threads, context);
    addRace(part, race, count, { grouped(count), orderName(order), std::to_string(threads) },
      { { "points", count }, { "order", orderName(order) }, { "dimension", task.dimension },
        { "threads", threads } });
    if (order == PointOrder::Random)
    {
      addToLines(race, count, threads, context, lines);
    }
  }
}

} // namespace

ReportPart studyPoints(StudyContext& context)
{
  ReportPart part;
  part.title = "Against points, order and threads";
  part.text = fmt::format("Points on a sphere of radius {} m in a workspace of {} m, {} voxels on an axis. "
                          "Order: as drawn at random, or row by row as a scanner gives them.",
    kSphereRadius, kWorkspaceEdge, context.options.dimension);
  setRaceHeader(part, { "points", "order", "threads" });
  Lines lines;
  for (const std::int64_t count : context.options.points)
  {
    if (!fitsIntoMemory(count))
    {
      part.remarks.push_back(fmt::format("Left out: {} points would not fit into memory", grouped(count)));
      continue;
    }
    racePoints(count, PointOrder::Random, context, part, lines);
    racePoints(count, PointOrder::Scan, context, part, lines);
  }
  part.charts.push_back({ "resample-points", "Time of a point, random order",
    { "points", true, std::vector<double>(context.options.points.begin(), context.options.points.end()) },
    { "time of a point (ns)", true }, lines.points });
  if (context.options.threads.size() > 1)
  {
    part.charts.push_back(
      { "resample-threads", fmt::format("Update of {} points", grouped(context.options.points.back())),
        { "threads", false,
          std::vector<double>(context.options.threads.begin(), context.options.threads.end()) },
        { "time (ms)", true }, lines.threads });
  }
  return part;
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
