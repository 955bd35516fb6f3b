#include "Benchmark/Touch/TouchBenchmark.h"

#include "Benchmark/Harness/Instructions.h"
#include "Benchmark/Harness/StudyList.h"
#include "Benchmark/Touch/Studies.h"

#include <fmt/format.h>

#include <algorithm>

namespace pointhaptics
{
namespace bench
{
namespace touch
{
namespace
{

constexpr const char* kHard = "hard";

/// In the order of the report.
constexpr Study<StudyContext> kStudies[] = { { "scans", studyScans }, { "edges", studyEdges },
  { "thin", studyThin }, { "local", studyLocal }, { "size", studySizes }, { kHard, studyHard } };

constexpr const char* kMethod =
  "Hands press, slide and lift on clouds that were sampled from triangle meshes, K = 800 N/m, one tick a "
  "millisecond. The truth is the force of a god object on the mesh itself, whose facets are met from their "
  "front only. At edges it is bistable: so a tick is judged where eight god objects, whose hands are shifted "
  "by 10 um (four) and 50 um (four), feel the same within 25 %, and a force above 0.04 N. Judged: their "
  "share "
  "of the ticks in contact. Errors: in percent of the force of the tick, RMS of the RMS force. Direction: "
  "the "
  "angle between the two, 95th percentile, degrees. Lost: judged ticks without force. Pops: strokes with a "
  "judged tick that has no force or one that pulls. Phantom: the largest force where all nine god objects "
  "are "
  "free. Held: strokes whose last 50 ticks are free and have a force above 0.05 N. Step: the change of the "
  "force within a tick over K times the way of the hand. Energy: median of what a stroke returns to the hand "
  "beyond the truth's own. The judgement of a stroke ends where the god object leaps from contact to contact "
  "(by more than 4 times the way of the hand and 0.2 mm); phantom and held of the rest of the stroke stand "
  "after a plus sign, and tell less. A stroke ends where a hand that fell through a hole of a scan comes out "
  "through its wall. Before each tick its step is prefetched in the scene that it will be in, as the servo "
  "loop does. Times are of each tick the fastest of the walks: median and p99 in "
  "contact, finding: the longest out of contact or into it, the maximum of all ticks. Status: percent of the "
  "ticks that set each bit of ProxyState::status, that is how often each mechanism spoke. Rounds, step-limit "
  "and cells: a bound of a tick's work. Ball: fit and ball disagree, and the ball is felt. Settling: a "
  "surface that moved by itself is followed at the limited rate. Led: the fit takes the ball over bumps. "
  "Around: the ball goes around an edge to the face that the hand came out of. Seeking: a fit is sought, in "
  "parts. Gliding: the ball goes over bumps. Crowded: it has no room for its radius. Fallback: the hand left "
  "the finer scene before the next came. Releases: ticks in which contact ends.";

/// Names of the bits of ProxyState::status, in their order.
constexpr const char* kStatusNames[] = { "non-finite", "rounds", "step-limit", "ball", "bit4", "no-scene",
  "cells", "settling", "stiffness", "led", "around", "seeking", "gliding", "crowded", "fallback" };

/// "1 + 2": before and after the leaps, where there are some.
std::string withLater(const std::string& before, const std::string& later, const TouchFigures& f)
{
  return f.leaps > 0 ? before + " + " + later : before;
}

std::string statusText(const TouchFigures& f)
{
  std::string text;
  for (std::size_t bit = 0; bit < kStatusBits; ++bit)
  {
    if (f.statusPercent[bit] > 0.0)
    {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", statusName(bit), brief(f.statusPercent[bit]));
    }
  }
  return text;
}

} // namespace

void TouchBenchmarkOptions::makeQuick()
{
  quick = true;
  points = 20000;
  sizes = { 2000, 20000 };
  strokes = 2;
  meshes = { "box" };
  repetitions = 1;
}

std::vector<std::string> studyWords()
{
  return wordsOf(kStudies);
}

Report benchmarkTouch(const TouchBenchmarkOptions& options, const Progress& progress, std::string& wrong)
{
  Report report;
  report.task = "touch";
  report.title = "Touch at edges and on scans";
  report.accuracyMethod = kMethod;
  report.method = kMethod;
  report.machine = thisMachine();
  StudyContext context{ options, progress, {} };
  std::vector<std::string> wanted = options.studies;
  if (wanted.empty())
  {
    wanted = studyWords();
    wanted.erase(std::remove(wanted.begin(), wanted.end(), kHard), wanted.end());
  }
  report.parts = runStudies(kStudies, wanted, context);
  wrong = context.wrong;
  return report;
}

std::string statusName(std::size_t bit)
{
  return bit < std::size(kStatusNames) ? kStatusNames[bit] : fmt::format("bit{}", bit);
}

void setFigureHeader(
  ReportPart& part, const std::vector<std::string>& leading, const std::vector<std::string>& own)
{
  part.table.header = leading;
  part.table.header.insert(part.table.header.end(), own.begin(), own.end());
  for (const char* name :
    { "median %", "p95 %", "RMS %", "dir p95", "lost %", "pops", "phantom N", "held", "strokes", "judged %",
      "releases", "step p99", "max", "energy mJ", "p50 us", "p99", "finding us", "max us", "status %" })
  {
    part.table.header.emplace_back(name);
  }
}

void addFigures(StudyContext& context, ReportPart& part, std::vector<std::string> leadingCells,
  const nlohmann::ordered_json& leadingNumbers, const TouchFigures& f)
{
  leadingCells.insert(leadingCells.end(),
    { brief(f.medianPercent), brief(f.p95Percent), brief(f.rmsPercent), brief(f.directionP95Degrees),
      brief(f.lostPercent), fmt::format("{}", f.pops),
      withLater(brief(f.phantomNewton), brief(f.laterPhantomNewton), f),
      withLater(fmt::format("{}", f.held), fmt::format("{}", f.laterHeld), f), fmt::format("{}", f.strokes),
      fmt::format("{:.0f}", f.judgedPercent), fmt::format("{}", f.releases), fmt::format("{:.2f}", f.stepP99),
      fmt::format("{:.1f}", f.largestStep), brief(1e3 * f.energyJoule), brief(f.p50), brief(f.p99),
      brief(f.firstContact), brief(f.maximum), statusText(f) });
  part.table.rows.push_back(std::move(leadingCells));
  nlohmann::ordered_json row = leadingNumbers;
  row.update(
    { { "median_percent", f.medianPercent }, { "p95_percent", f.p95Percent }, { "rms_percent", f.rmsPercent },
      { "direction_p95_degrees", f.directionP95Degrees }, { "lost_percent", f.lostPercent },
      { "pops", f.pops }, { "phantom_newton", f.phantomNewton }, { "held", f.held },
      { "phantom_after_leap_newton", f.laterPhantomNewton }, { "held_after_leap", f.laterHeld },
      { "strokes", f.strokes }, { "leaps", f.leaps }, { "releases", f.releases }, { "ticks", f.ticks },
      { "contact_ticks", f.contacts }, { "judged_ticks", f.judged }, { "judged_percent", f.judgedPercent },
      { "step_p99", f.stepP99 }, { "largest_step", f.largestStep }, { "energy_joule", f.energyJoule },
      { "p50_us", f.p50 }, { "p99_us", f.p99 }, { "first_contact_us", f.firstContact },
      { "max_us", f.maximum }, { "instructions", usedInstructions(context.options.instructions) } });
  nlohmann::ordered_json status = nlohmann::ordered_json::object();
  for (std::size_t bit = 0; bit < kStatusBits; ++bit)
  {
    if (bit < std::size(kStatusNames) || f.statusPercent[bit] > 0.0)
    {
      status[statusName(bit)] = f.statusPercent[bit];
    }
  }
  row["status_percent"] = std::move(status);
  part.rows.push_back(std::move(row));
  if (f.nonFinite > 0)
  {
    context.wrong = fmt::format("{}: {} states that are not finite", leadingNumbers.dump(), f.nonFinite);
  }
}

std::vector<TouchMesh> meshesOf(const TouchBenchmarkOptions& options)
{
  std::vector<TouchMesh> meshes;
  for (TouchMesh mesh : options.scans)
  {
    double scale = 1.0;
    Vec3 middle;
    mesh.points = proxy::fitted(std::move(mesh.points), scale, middle);
    orientOutward(mesh);
    meshes.push_back(std::move(mesh));
  }
  for (const std::string& name : options.meshes)
  {
    meshes.push_back(generatedMesh(name));
  }
  return meshes;
}

std::vector<Vec3> samplesToTouch(const TouchMesh& mesh, std::int64_t count)
{
  constexpr std::uint64_t kSeed = 28;
  return samplesOf(mesh, count, kSeed);
}

TouchSceneSettings sceneSettings(const TouchBenchmarkOptions& options)
{
  TouchSceneSettings settings;
  settings.raw = options.raw;
  settings.local = options.local;
  settings.lateTicks = options.lateTicks;
  return settings;
}

std::string sceneText(const TouchBenchmarkOptions& options)
{
  if (options.raw)
  {
    return "the points themselves";
  }
  const std::string near = !options.local ? "everywhere"
    : options.lateTicks == 0
    ? "and finer near the hand in the tick that it comes there"
    : fmt::format("and finer near the hand {} ms after a look at it", options.lateTicks);
  return "voxels of 1/3 mm, " + near;
}

std::vector<TouchTask> tasksOn(const TriangleTree& tree, std::vector<TouchStroke> strokes)
{
  std::vector<TouchTask> tasks;
  for (TouchStroke& stroke : strokes)
  {
    TouchTask task;
    task.truth = truthOf(tree, stroke, ContactParameters().stiffness, 100 + tasks.size());
    task.stroke = std::move(stroke);
    tasks.push_back(std::move(task));
  }
  return tasks;
}

TouchFigures judge(StudyContext& context, const Contestant& contestant, const TouchScene& scene,
  const std::vector<TouchTask>& tasks, const TouchObserver& observer)
{
  const std::unique_ptr<TouchMethod> method = contestant.make();
  TouchJudge judge(ContactParameters().stiffness);
  for (std::size_t i = 0; i < tasks.size(); ++i)
  {
    const TouchTrace trace =
      walk(*method, scene, tasks[i].stroke, tasks[i].truth.ticks.size(), context.options.repetitions);
    judge.add(trace, tasks[i].truth);
    if (observer)
    {
      observer(i, trace);
    }
  }
  return judge.figures();
}

} // namespace touch
} // namespace bench
} // namespace pointhaptics
