#include "Benchmark/Proxy/ProxyBenchmark.h"

#include "Benchmark/Harness/StudyList.h"
#include "Benchmark/Proxy/Studies/Studies.h"

#include <fmt/format.h>

#include <algorithm>

namespace pointhaptics
{
namespace bench
{
namespace proxy
{
namespace
{

/// In the order of the report.
constexpr Study<StudyContext> kStudies[] = { { "shapes", studyShapes }, { "methods", studyMethods },
  { "validation", studyValidation }, { "paper", studyPaper }, { "paths", studyPaths }, { "size", studySize },
  { "instructions", studyInstructions }, { "scans", studyScans } };

constexpr const char* kMethod =

  "A hand moves over shapes whose nearest points are known exactly, one tick a millisecond, K = 800\n"
  "N/m, with voxels of 1/3 mm unless said otherwise. The columns:\n"
  "\n"
  "- RMS %, max %: length of the difference between force and exact force, in percent of the RMS\n"
  "  exact force of the path, over all ticks at least 20 um deep.\n"
  "- dir: angle between the two, in degrees.\n"
  "- step: largest change of the force within a tick over K times the way of the hand; 1 is that of\n"
  "  a plane.\n"
  "- energy: what the difference of the forces returns to the hand over one closed turn without\n"
  "  friction.\n"
  "- >100 Hz: RMS of that difference above 100 Hz.\n"
  "- pops: ticks deeper than 20 um without contact; false: ticks with a force more than 20 um\n"
  "  outside.\n"
  "- times: the proxy's whole update in contact, in microseconds, of each tick the fastest of\n"
  "  several walks. So the machine's other work is left out, and rare work of the method is not.";

constexpr const char* kTimeMethod =

  "A hand slides over clouds, one tick a millisecond, K = 800 N/m, with voxels of 1/3 mm. Times are\n"
  "of the proxy's whole update in contact, in microseconds, of each tick the fastest of several\n"
  "walks. So the machine's other work is left out, and rare work of the method is not. Errors are\n"
  "those of [Accuracy.md](Accuracy.md#the-proxy).";

} // namespace

void ProxyBenchmarkOptions::makeQuick()
{
  points = { 20000 };
  noises = { 0.0, 20e-6 };
  shapes = { Shape::Sphere, Shape::Saddle };
  sizes = { 5000, 20000 };
  repetitions = 1;
  strokes = 3;
}

std::vector<std::string> studyWords()
{
  return wordsOf(kStudies);
}

Report benchmarkProxy(const ProxyBenchmarkOptions& options, const Progress& progress, std::string& wrong)
{
  Report report;
  report.task = "proxy";
  report.title = "The proxy";
  report.accuracyMethod = kMethod;
  report.method = kTimeMethod;
  report.machine = thisMachine();
  StudyContext context{ options, progress, {} };
  report.parts = runStudies(kStudies, options.studies, context);
  wrong = context.wrong;
  return report;
}

std::int64_t mostPoints(const StudyContext& context)
{
  return *std::max_element(context.options.points.begin(), context.options.points.end());
}

void setFigureHeader(ReportPart& part, const std::vector<std::string>& leading)
{
  part.table.header = leading;
  for (const char* name : { "RMS %", "max %", "dir RMS", "dir max", "step", "energy J", ">100 Hz mN", "pops",
         "false", "p50 us", "p99", "p99.9", "max us" })
  {
    part.table.header.emplace_back(name);
  }
}

void addFigures(ReportPart& part, const std::vector<std::string>& leadingCells,
  const nlohmann::ordered_json& leadingNumbers, const TrialFigures& f)
{
  const auto percent = [](double value)
  { return value < 0.00005 ? fmt::format("{:.1g}", value) : fmt::format("{:.4f}", value); };
  std::vector<std::string> cells = leadingCells;
  cells.insert(cells.end(),
    { percent(f.rmsPercent), percent(f.maximumPercent), fmt::format("{:.4f}", f.directionRmsDegrees),
      fmt::format("{:.4f}", f.directionMaximumDegrees), fmt::format("{:.2f}", f.largestStep),
      fmt::format("{:.1e}", f.energyJoule), fmt::format("{:.4f}", 1e3 * f.above100Hz),
      fmt::format("{}", f.popThroughs), fmt::format("{}", f.falseTicks), fmt::format("{:.2f}", f.p50),
      fmt::format("{:.2f}", f.p99), fmt::format("{:.2f}", f.p999), fmt::format("{:.2f}", f.maximum) });
  part.table.rows.push_back(std::move(cells));
  nlohmann::ordered_json row = leadingNumbers;
  row.update({ { "rms_percent", f.rmsPercent }, { "max_percent", f.maximumPercent },
    { "direction_rms_degrees", f.directionRmsDegrees },
    { "direction_max_degrees", f.directionMaximumDegrees }, { "largest_step", f.largestStep },
    { "exact_step", f.exactStep }, { "energy_joule", f.energyJoule }, { "above_100_hz_newton", f.above100Hz },
    { "pop_throughs", f.popThroughs }, { "false_ticks", f.falseTicks }, { "contact_ticks", f.contactTicks },
    { "capped_ticks", f.cappedTicks }, { "status", f.status }, { "p50_us", f.p50 }, { "p99_us", f.p99 },
    { "p999_us", f.p999 }, { "max_us", f.maximum }, { "free_p50_us", f.freeP50 },
    { "first_contact_us", f.firstContact } });
  part.rows.push_back(std::move(row));
}

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
