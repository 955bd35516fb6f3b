#include "Benchmark/Resample/ResampleBenchmark.h"

#include "Benchmark/Resample/Studies.h"

#include <algorithm>
#include <iterator>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

struct Study
{
  const char* word;
  ReportPart (*run)(StudyContext&);
};

/// In the order of the report.
constexpr Study kStudies[] = { { "points", studyPoints }, { "voxels", studyVoxels },
  { "attributes", studyAttributes }, { "instructions", studyInstructions }, { "zoom", studyZoom },
  { "memory", studyMemory }, { "accumulators", studyAccumulators } };

constexpr const char* kMethod =
  "Each time is a whole `Update()` (of other libraries: the call that does the same), from points in memory "
  "to "
  "the finished result, with the input marked as modified. The answer is compared with long double before "
  "anything is timed. Then all contestants run once a round, in an order shuffled anew, after rounds to warm "
  "up; the first call is reported apart. Given are the median and the quartiles; ratios are medians of the "
  "ratios within a round. \"x ours\" is the time over ours, \"PCL / it\" how many times as fast as PCL a "
  "contestant is, \"x copy\" the time over that of copying the coordinates on one thread, the "
  "floor "
  "of any method. Loading the points into another library's own form is not timed. PCL's VoxelGrid and "
  "Open3D's VoxelDownSample run on one thread whatever they are given.";

} // namespace

void ResampleBenchmarkOptions::makeQuick()
{
  points = { 2000, 20000 };
  dimensions = { 20, 75, 1200 };
  voxelPoints = 20000;
  zoomPoints = 50000;
  accumulatorPoints = 20000;
  dimension = 75;
  repetitions = 3;
  warmUps = 1;
}

std::vector<std::string> studyWords()
{
  std::vector<std::string> words;
  std::transform(std::begin(kStudies), std::end(kStudies), std::back_inserter(words),
    [](const Study& study) { return std::string(study.word); });
  return words;
}

Report benchmarkResample(const ResampleBenchmarkOptions& options, const Progress& progress, bool& allRight)
{
  Report report;
  report.task = "resample";
  report.title = "Mean resampling";
  report.method = kMethod;
  report.machine = thisMachine();
  StudyContext context{ options, progress };
  // Memory first: it needs children of a process without threads, and loops leave threads behind.
  std::vector<ReportPart> parts(std::size(kStudies));
  for (const bool memoryTurn : { true, false })
  {
    for (std::size_t i = 0; i < std::size(kStudies); ++i)
    {
      const std::string word = kStudies[i].word;
      const bool wanted = options.studies.empty() ||
        std::find(options.studies.begin(), options.studies.end(), word) != options.studies.end();
      if (wanted && (word == "memory") == memoryTurn)
      {
        parts[i] = kStudies[i].run(context);
      }
    }
  }
  std::copy_if(std::make_move_iterator(parts.begin()), std::make_move_iterator(parts.end()),
    std::back_inserter(report.parts), [](const ReportPart& part) { return !part.key.empty(); });
  allRight = context.allRight;
  return report;
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
