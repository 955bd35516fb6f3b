#include "Benchmark/Resample/Clouds.h"
#include "Benchmark/Resample/Studies.h"

#include <fmt/format.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cstring>
#include <thread>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

/// The floor under every time: the coordinates, read and written once.
Contestant copyOf(vtkPolyData* cloud, std::vector<float>& target)
{
  const auto bytes = std::size_t(cloud->GetNumberOfPoints()) * 3 * sizeof(float);
  target.assign(bytes / sizeof(float), 0.0f);
  Contestant copy;
  copy.name = "copy";
  copy.run = [cloud, bytes, &target]
  { std::memcpy(target.data(), cloud->GetPoints()->GetVoidPointer(0), bytes); };
  return copy;
}

/// A few milliseconds of arithmetic that leave no unit of a core for another thread. @return what keeps it
/// from being left out.
std::uint64_t compute(std::uint64_t seed)
{
  constexpr int kChains = 8;
  constexpr int kSteps = 500000;
  std::uint64_t chains[kChains];
  for (int i = 0; i < kChains; ++i)
  {
    chains[i] = seed + std::uint64_t(i);
  }
  for (int step = 0; step < kSteps; ++step)
  {
    for (std::uint64_t& x : chains)
    {
      x ^= x << 13;
      x ^= x >> 7;
      x ^= x << 17;
    }
  }
  return *std::max_element(chains, chains + kChains);
}

/// The same arithmetic on each of some threads.
Contestant arithmeticOn(int threads, std::uint64_t& result)
{
  Contestant arithmetic;
  arithmetic.name = "arithmetic";
  arithmetic.run = [threads, &result]
  {
    std::vector<std::uint64_t> results(static_cast<std::size_t>(threads));
    std::vector<std::thread> others;
    for (int i = 1; i < threads; ++i)
    {
      others.emplace_back([&results, i] { results[std::size_t(i)] = compute(std::uint64_t(i) + 1); });
    }
    results[0] = compute(1);
    for (std::thread& other : others)
    {
      other.join();
    }
    result = *std::max_element(results.begin(), results.end());
  };
  return arithmetic;
}

Contestant contestantOf(Rival& rival, const ResampleTask& task, Verdict& verdict)
{
  Contestant contestant;
  contestant.name = rival.name();
  contestant.before = [&rival] { rival.before(); };
  contestant.run = [&rival] { rival.run(); };
  contestant.check = [&rival, &task, &verdict]
  {
    const ResampleAnswer answer = rival.answer();
    verdict = judge(answer, expectedMeans(viewOf(task.cloud), answer.lattice), rival.comparedWith());
    return true; // a wrong one is timed too, and said to be wrong
  };
  return contestant;
}

Rivals thoseThatCan(Rivals rivals, const ResampleTask& task, RaceTable& result)
{
  Rivals able;
  for (std::unique_ptr<Rival>& rival : rivals)
  {
    const std::string why = rival->refusal(task);
    if (why.empty())
    {
      rival->load(task);
      able.push_back(std::move(rival));
    }
    else
    {
      result.leftOut.push_back(rival->name() + ": " + why);
    }
  }
  return able;
}

/// Nothing where PCL did not run.
std::vector<double> pclSeconds(const std::vector<Lap>& laps)
{
  const auto pcl =
    std::find_if(laps.begin(), laps.end(), [](const Lap& lap) { return lap.name.rfind("PCL", 0) == 0; });
  return pcl == laps.end() ? std::vector<double>() : pcl->seconds;
}

RaceSettings settingsOf(const StudyContext& context)
{
  RaceSettings settings;
  settings.rounds = context.options.repetitions;
  settings.warmUps = context.options.warmUps;
  settings.inARow = 2;
  settings.longestSeconds = context.options.longestSeconds;
  return settings;
}

} // namespace

RaceTable raceOn(const ResampleTask& task, Rivals rivals, int threads, StudyContext& context)
{
  RaceTable result;
  const Rivals able = thoseThatCan(std::move(rivals), task, result);
  std::vector<Verdict> verdicts(able.size());
  std::vector<Contestant> contestants;
  for (std::size_t i = 0; i < able.size(); ++i)
  {
    contestants.push_back(contestantOf(*able[i], task, verdicts[i]));
  }
  std::vector<float> target;
  contestants.push_back(copyOf(task.cloud, target));
  std::uint64_t computed = 0;
  if (threads > 1)
  {
    contestants.push_back(arithmeticOn(1, computed));
    contestants.push_back(arithmeticOn(threads, computed));
  }
  std::vector<Lap> laps;
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config(threads), [&] { laps = race(contestants, settingsOf(context)); });
  const Lap& copy = laps[able.size()];
  result.copySeconds = quartiles(copy.seconds).median;
  result.threads = threads;
  if (threads > 1)
  {
    result.timesAlone = pairedRatios(laps.back().seconds, laps[able.size() + 1].seconds);
  }
  for (std::size_t i = 0; i < able.size(); ++i)
  {
    const Lap& lap = laps[i];
    context.allRight =
      context.allRight && (verdicts[i].right || able[i]->comparedWith() == ComparedWith::Means);
    result.rows.push_back(
      { lap.name, verdicts[i], lap, quartiles(lap.seconds), pairedRatios(lap.seconds, laps.front().seconds),
        pairedRatios(pclSeconds(laps), lap.seconds), pairedRatios(lap.seconds, copy.seconds) });
  }
  return result;
}

Rivals allRivals(const StudyContext& context)
{
  Rivals rivals;
  rivals.push_back(makeOurs());
  OursSettings automatic;
  automatic.name = "ours, automatic workspace";
  automatic.automaticWorkspace = true;
  rivals.push_back(makeOurs(automatic));
  for (const std::string& word : context.options.rivals)
  {
    rivals.push_back(makeRival(word));
  }
  return rivals;
}

void setRaceHeader(ReportPart& part, const std::vector<std::string>& leading, const std::string& first)
{
  part.table.header = leading;
  for (const char* title :
    { "contestant", "median ms", "quartiles ms", "after others ms", "first ms", "ns/point" })
  {
    part.table.header.push_back(title);
  }
  for (const std::string& title : { "x " + first, std::string("PCL / it"), std::string("x copy"),
         std::string("voxels"), std::string("answer") })
  {
    part.table.header.push_back(title);
  }
}

namespace
{

std::vector<std::string> raceCells(const RaceRow& row, std::int64_t points)
{
  return { row.name, milliseconds(row.seconds.median), quartilesText(row.seconds),
    milliseconds(quartiles(row.lap.afterOthers).median), milliseconds(row.lap.firstSeconds),
    brief(1e9 * row.seconds.median / double(points)), brief(row.timesOurs.median),
    row.pclTimes.count > 0 ? brief(row.pclTimes.median) : "", brief(row.timesCopy.median),
    grouped(row.verdict.voxels), row.verdict.text };
}

nlohmann::ordered_json raceJson(const RaceRow& row, std::int64_t points)
{
  return { { "contestant", row.name }, { "repetitions", row.seconds.count },
    { "median_seconds", row.seconds.median }, { "lower_quartile_seconds", row.seconds.lower },
    { "upper_quartile_seconds", row.seconds.upper }, { "fastest_seconds", row.seconds.minimum },
    { "after_others_seconds", quartiles(row.lap.afterOthers).median },
    { "first_seconds", row.lap.firstSeconds }, { "ns_per_point", 1e9 * row.seconds.median / double(points) },
    { "times_ours", row.timesOurs.median }, { "times_ours_lower", row.timesOurs.lower },
    { "times_ours_upper", row.timesOurs.upper }, { "pcl_times", row.pclTimes.median },
    { "times_copy", row.timesCopy.median }, { "voxels", row.verdict.voxels },
    { "expected_voxels", row.verdict.expectedVoxels }, { "wrong_voxels", row.verdict.wrongVoxels },
    { "worst_error_voxels", row.verdict.worstError }, { "right", row.verdict.right },
    { "answer", row.verdict.text } };
}

} // namespace

void addRace(ReportPart& part, const RaceTable& race, std::int64_t points,
  const std::vector<std::string>& leadingCells, const nlohmann::ordered_json& leadingNumbers)
{
  for (const RaceRow& row : race.rows)
  {
    std::vector<std::string> cells = leadingCells;
    const std::vector<std::string> more = raceCells(row, points);
    cells.insert(cells.end(), more.begin(), more.end());
    part.table.rows.push_back(cells);
    nlohmann::ordered_json numbers = leadingNumbers;
    numbers.update(raceJson(row, points));
    if (race.timesAlone.count > 0)
    {
      numbers["threads_together_times"] = race.timesAlone.median;
    }
    part.rows.push_back(numbers);
  }
  if (race.timesAlone.count > 0)
  {
    part.remarks.push_back(
      fmt::format("Arithmetic ({}): on {} threads at once took {} ({} - {}) times as long as on one",
        fmt::join(leadingCells, ", "), race.threads, brief(race.timesAlone.median),
        brief(race.timesAlone.lower), brief(race.timesAlone.upper)));
  }
  for (const std::string& line : race.leftOut)
  {
    part.remarks.push_back(fmt::format("Left out ({}): {}", fmt::join(leadingCells, ", "), line));
  }
}

int mostThreads(const StudyContext& context)
{
  return *std::max_element(context.options.threads.begin(), context.options.threads.end());
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
