/// @file
/// The studies of the resampling benchmark: each asks one question and gives one part of the report.
#pragma once

#include "Benchmark/Harness/Race.h"
#include "Benchmark/Report/Report.h"
#include "Benchmark/Resample/Expected.h"
#include "Benchmark/Resample/ResampleBenchmark.h"
#include "Benchmark/Resample/Rivals/Rival.h"

#include <memory>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace resample
{

/// What the studies share.
struct StudyContext
{
  const ResampleBenchmarkOptions& options;
  const Progress& progress;
  bool allRight = true;
};

/// One contestant of one race.
struct RaceRow
{
  std::string name;
  Verdict verdict;
  Lap lap;
  Quartiles seconds;
  Quartiles timesOurs; ///< Its time over that of the first contestant; 1 for that one.
  Quartiles pclTimes;  ///< PCL's time over its: how many times as fast as PCL; empty where PCL did not run.
  Quartiles timesCopy; ///< Its time over that of a copy of the coordinates.
};

struct RaceTable
{
  std::vector<RaceRow> rows;        ///< The first contestant's first.
  std::vector<std::string> leftOut; ///< "NAME: why".
  double copySeconds = 0.0;         ///< Median of copying the coordinates.
  int threads = 1;
  /// Time of arithmetic on all threads at once over that of as much on one: 1 where each has a core of its
  /// own. Empty with one thread.
  Quartiles timesAlone;
};

using Rivals = std::vector<std::unique_ptr<Rival>>;

/// Loads, checks and times all of @p rivals on one task with @p threads threads. What they hold is freed.
/// Clears context.allRight where one that must be exact is wrong.
RaceTable raceOn(const ResampleTask& task, Rivals rivals, int threads, StudyContext& context);

/// Ours, first, and the rivals that were asked for.
Rivals allRivals(const StudyContext& context);

/// Columns @p leading, then contestant, times, "x FIRST", "PCL / it", "x copy", voxels and answer.
void setRaceHeader(
  ReportPart& part, const std::vector<std::string>& leading, const std::string& first = "ours");
/// Adds the rows of @p race to @p part, each behind the cells and numbers of @p leading, and what was left
/// out.
void addRace(ReportPart& part, const RaceTable& race, std::int64_t points,
  const std::vector<std::string>& leadingCells, const nlohmann::ordered_json& leadingNumbers);

/// Threads of the studies that do not vary them: the most of those asked for.
int mostThreads(const StudyContext& context);

ReportPart studyPoints(StudyContext& context);
ReportPart studyVoxels(StudyContext& context);
ReportPart studyAttributes(StudyContext& context);
/// Without a key where the filter has one path only.
ReportPart studyInstructions(StudyContext& context);
ReportPart studyZoom(StudyContext& context);
ReportPart studyMemory(StudyContext& context);
ReportPart studyAccumulators(StudyContext& context);

} // namespace resample
} // namespace bench
} // namespace pointhaptics
