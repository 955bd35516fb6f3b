#include "Benchmark/Bandwidth/Clouds.h"
#include "Benchmark/Bandwidth/Expected.h"
#include "Benchmark/Bandwidth/Studies.h"

#include <fmt/format.h>
#include <vtkPolyData.h>

#include <memory>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

/// A rival in a race: its loop on one thread, or on as many as ours.
struct Entry
{
  std::unique_ptr<Rival> rival;
  std::string name;
  bool parallel = false;
  Verdict verdict;
};

std::vector<std::unique_ptr<Entry>> entriesFor(int threads, const StudyContext& context)
{
  std::vector<std::unique_ptr<Entry>> entries;
  const auto add = [&](std::unique_ptr<Rival> rival, bool parallel, const std::string& suffix)
  {
    auto entry = std::make_unique<Entry>();
    entry->name = rival->name() + suffix;
    entry->rival = std::move(rival);
    entry->parallel = parallel;
    entries.push_back(std::move(entry));
  };
  add(makeOurs(), true, "");
  for (const std::string& word : context.options.rivals)
  {
    add(makeRival(word), false, ", loop on 1 thread");
    if (threads > 1)
    {
      add(makeRival(word), true, fmt::format(", loop on {} threads", threads));
    }
  }
  return entries;
}

Contestant contestantOf(Entry& entry, const std::vector<ExpectedPoint>& expected)
{
  Contestant contestant;
  contestant.name = entry.name;
  contestant.run = [&entry] { entry.rival->run(entry.parallel); };
  contestant.check = [&entry, &expected]
  {
    entry.verdict = judge(entry.rival->answer(), expected, entry.rival->isOurs());
    return true; // a wrong one is timed too, and said to be wrong
  };
  return contestant;
}

void raceOn(const NamedCloud& cloud, int threads, const std::vector<ExpectedPoint>& expected,
  const BandwidthTask& task, StudyContext& context, ReportPart& part, std::vector<Series>& lines)
{
  context.progress(fmt::format("{} points of {}, {} threads", cloud.size(), cloud.name, threads));
  const auto entries = entriesFor(threads, context);
  std::vector<Contestant> contestants;
  for (const auto& entry : entries)
  {
    entry->rival->load(task);
    contestants.push_back(contestantOf(*entry, expected));
  }
  const std::vector<Lap> laps = timed(contestants, threads, context);
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    const Verdict& verdict = entries[i]->verdict;
    const bool ours = entries[i]->rival->isOurs();
    context.allRight = context.allRight && (verdict.right || !ours);
    const Quartiles seconds = quartiles(laps[i].seconds);
    const Quartiles times = pairedRatios(laps[i].seconds, laps[0].seconds);
    part.table.rows.push_back({ cloud.name, grouped(cloud.size()), std::to_string(threads), laps[i].name,
      milliseconds(seconds.median), quartilesText(seconds), milliseconds(laps[i].firstSeconds),
      brief(1e9 * seconds.median / double(cloud.size())), brief(times.median), verdict.text });
    part.rows.push_back({ { "cloud", cloud.name }, { "points", cloud.size() },
      { "neighbors", task.neighbors }, { "threads", threads }, { "contestant", laps[i].name },
      { "repetitions", seconds.count }, { "median_seconds", seconds.median },
      { "lower_quartile_seconds", seconds.lower }, { "upper_quartile_seconds", seconds.upper },
      { "first_seconds", laps[i].firstSeconds }, { "times_ours", times.median },
      { "times_ours_lower", times.lower }, { "times_ours_upper", times.upper },
      { "worst_relative_error", verdict.worstError }, { "right", verdict.right } });
    if (threads == context.mostThreads() && (ours || entries[i]->parallel || threads == 1))
    {
      addPoint(lines, entries[i]->rival->name(), verdict.worstError, 1e3 * seconds.median);
    }
  }
}

} // namespace

ReportPart studySearch(StudyContext& context)
{
  ReportPart part;
  part.title = "Bandwidth and radius of every point, beside loops over other libraries' searches";
  part.text = fmt::format(
    "{} neighbours. The loops over the points of the other libraries run on one thread, as their examples "
    "do, "
    "and on as many threads as ours. Answers are compared at {} points; where neighbours are equally far, as "
    "among duplicates, others may choose differently.",
    context.options.neighbors, context.options.checkedPoints);
  part.table.header = { "cloud", "points", "threads", "contestant", "median ms", "quartiles ms", "first ms",
    "ns/point", "x ours", "answer" };
  std::vector<NamedCloud> clouds;
  clouds.push_back(shapeCloud(Shape::Sphere, context.options.points));
  clouds.push_back(shapeCloud(Shape::DensityStep, context.options.points));
  if (!context.options.file.empty())
  {
    clouds.push_back(fileCloud(context.options.file, context.options.points));
  }
  for (const NamedCloud& cloud : clouds)
  {
    BandwidthTask task;
    task.cloud = cloud.polyData;
    task.points = cloud.view();
    task.neighbors = context.options.neighbors;
    const std::vector<ExpectedPoint> expected = expectedPoints(task, context.options.checkedPoints);
    std::vector<Series> lines;
    for (const int threads : context.options.threads)
    {
      raceOn(cloud, threads, expected, task, context, part, lines);
    }
    if (&cloud == &clouds.front())
    {
      part.charts.push_back({ "bandwidth-search",
        fmt::format(
          "Bandwidth and radius of {} points, {} threads", grouped(cloud.size()), context.mostThreads()),
        { "largest relative error", true }, { "time (ms)", true }, lines });
    }
  }
  return part;
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
