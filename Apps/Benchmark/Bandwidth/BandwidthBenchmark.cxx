#include "Benchmark/Bandwidth/BandwidthBenchmark.h"

#include "Benchmark/Bandwidth/Studies.h"
#include "Benchmark/Harness/StudyList.h"

#include <vtkSMPTools.h>

#include <algorithm>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

/// In the order of the report.
constexpr Study<StudyContext> kStudies[] = { { "search", studySearch }, { "rules", studyRules },
  { "touch", studyTouch }, { "settling", studySettling }, { "lattice", studyLattice },
  { "truncation", studyTruncation } };

constexpr const char* kMethod =

  "A time is that of the whole work, from points in memory to the finished arrays, the search tree\n"
  "included. Answers are compared with long double before anything is timed. Then all contestants\n"
  "run once a round, in an order shuffled anew, after rounds to warm up. Given are the median and\n"
  "the quartiles; ratios are medians of the ratios within a round. Copying the points into another\n"
  "library's own form is not timed.";

constexpr const char* kAccuracyMethod = "Errors are those against long double, or against the known density "
                                        "of the generated cloud; the times beside "
                                        "them are medians of rounds in shuffled order.";

} // namespace

void BandwidthBenchmarkOptions::makeQuick()
{
  points = 3000;
  latticePoints = 5000;
  values = 3000;
  repetitions = 3;
  warmUps = 1;
  checkedPoints = 50;
}

std::vector<std::string> studyWords()
{
  return wordsOf(kStudies);
}

Report benchmarkBandwidth(const BandwidthBenchmarkOptions& options, const Progress& progress, bool& allRight)
{
  Report report;
  report.task = "bandwidth";
  report.title = "Bandwidth, proxy radius and density";
  report.method = kMethod;
  report.accuracyMethod = kAccuracyMethod;
  report.machine = thisMachine();
  StudyContext context{ options, progress };
  report.parts = runStudies(kStudies, options.studies, context);
  allRight = context.allRight;
  return report;
}

std::vector<Lap> timed(
  const std::vector<Contestant>& contestants, int threads, const StudyContext& context, double part)
{
  RaceSettings settings;
  settings.rounds =
    std::max(std::min(3, context.options.repetitions), int(part * context.options.repetitions));
  settings.warmUps = part < 1.0 ? 1 : context.options.warmUps;
  std::vector<Lap> laps;
  vtkSMPTools::LocalScope(vtkSMPTools::Config(threads), [&] { laps = race(contestants, settings); });
  return laps;
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
