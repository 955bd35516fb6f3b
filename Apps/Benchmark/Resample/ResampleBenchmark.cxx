#include "Benchmark/Resample/ResampleBenchmark.h"

#include "Benchmark/Harness/StudyList.h"
#include "Benchmark/Resample/Studies.h"

#include <fmt/format.h>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

/// In the order of the report.
constexpr Study<StudyContext> kStudies[] = { { "points", studyPoints }, { "voxels", studyVoxels },
  { "attributes", studyAttributes }, { "instructions", studyInstructions }, { "zoom", studyZoom },
  { "memory", studyMemory, true }, { "accumulators", studyAccumulators } };

constexpr char kMethod[] =

  "A time is that of a whole `Update()` (of other libraries: the call that does the same), from\n"
  "points in memory to the finished result, with the input marked as modified. The answer is\n"
  "compared with long double before anything is timed. Then all contestants run once a round, in an\n"
  "order shuffled anew, after rounds to warm up; the first call is reported apart. A contestant\n"
  "that has run for {:g} seconds sits out the rounds left: at 50 million points the slow ones have\n"
  "three.\n"
  "\n"
  "- Given are the median and the quartiles; ratios are medians of the ratios within a round.\n"
  "- \"x ours\" is the time over ours; \"PCL / it\" how many times as fast as PCL a contestant is; \"x\n"
  "  copy\" the time over that of copying the coordinates on one thread, the floor of any method.\n"
  "- Loading the points into another library's own form is not timed. PCL's VoxelGrid and Open3D's\n"
  "  VoxelDownSample run on one thread whatever they are given.\n"
  "- Two threads of a virtual machine may have to share a core for a while. Below a table is how\n"
  "  long arithmetic on all threads took, in the same rounds, over that on one.";

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
  return wordsOf(kStudies);
}

Report benchmarkResample(const ResampleBenchmarkOptions& options, const Progress& progress, bool& allRight)
{
  Report report;
  report.task = "resample";
  report.title = "Mean resampling";
  report.method = fmt::format(kMethod, options.longestSeconds);
  report.machine = thisMachine();
  StudyContext context{ options, progress };
  report.parts = runStudies(kStudies, options.studies, context);
  allRight = context.allRight;
  return report;
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
