/// What does an update take with each of the instruction sets this machine has?
#include "Benchmark/Harness/Instructions.h"
#include "Benchmark/Harness/Statistics.h"
#include "Benchmark/Proxy/Strokes.h"
#include "Benchmark/Proxy/Studies/Studies.h"

#include "Core/Surface/SurfaceFit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

namespace pointhaptics
{
namespace bench
{
namespace proxy
{
namespace
{

constexpr int kFits = 200;
constexpr int kRoundsOfFits = 50;

/// The fastest first: the others are compared with it.
std::vector<NamedInstructionSet> setsOfThisMachine()
{
  std::vector<NamedInstructionSet> sets;
  std::copy_if(std::begin(kInstructionSets), std::end(kInstructionSets), std::back_inserter(sets),
    [](const NamedInstructionSet& one) { return hasInstructions(one.set); });
  return sets;
}

double microsecondsNow()
{
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch())
    .count();
}

struct SetFigures
{
  double fit = 0.0;          ///< Microseconds of a fit whose cells are gathered already, with all its terms.
  double built = 0.0;        ///< Seconds from points in memory to the scene.
  std::vector<double> ticks; ///< Microseconds in contact, sorted.
  double firstContact = 0.0; ///< The longest out of contact or into it.
  std::vector<ProxyState> states;
};

/// At the cell in the middle of the scene's list, the fastest of many rounds.
double timeOfFit(const HapticScene& scene, InstructionSet set)
{
  const auto memory = std::make_unique<FitCells>(set);
  const std::vector<Cell>& cells = scene.pyramid().level(0).cells;
  const LocalScale scale = scene.fitScale(cells[cells.size() / 2].mean);
  SurfaceFrame frame;
  frame.origin = cells[cells.size() / 2].mean;
  Vec3 normal = frame.normal;
  static_cast<void>(principalNormal(scene.pyramid(), frame.origin, scale.radius, *memory, normal));
  frame.turnTo(normal);
  FitSettings settings;
  settings.radius = scale.radius;
  settings.gate = scale.gate;
  TracedSlopes slopes;
  slopes.strength = 1.0;
  double best = INFINITY;
  for (int round = 0; round < kRoundsOfFits; ++round)
  {
    const double before = microsecondsNow();
    for (int i = 0; i < kFits; ++i)
    {
      static_cast<void>(fitSurface(scene.pyramid(), frame, settings, *memory, &slopes));
    }
    best = std::min(best, (microsecondsNow() - before) / kFits);
  }
  return best;
}

bool areSame(const std::vector<ProxyState>& a, const std::vector<ProxyState>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const ProxyState& x, const ProxyState& y)
    { return x.force == y.force && x.proxy == y.proxy && x.normal == y.normal && x.status == y.status; });
}

/// A row for each set. @p feel fills in ticks, states and the first contact.
template <typename Feel>
void addSets(StudyContext& context, ReportPart& part, const std::string& name,
  const std::vector<Vec3>& points, const Feel& feel)
{
  std::vector<ProxyState> expected;
  double fastestFit = 0.0;
  double fastestTick = 0.0;
  for (const NamedInstructionSet& one : setsOfThisMachine())
  {
    context.progress(fmt::format("{} with {}", name, one.name));
    SceneSettings sceneSettings;
    sceneSettings.instructions = one.set;
    SetFigures f;
    const double before = microsecondsNow();
    const Scene scene = sceneOf(points, sceneSettings);
    f.built = 1e-6 * (microsecondsNow() - before);
    if (!scene)
    {
      part.remarks.push_back("Left out: " + name + " has no finite points");
      return;
    }
    f.fit = timeOfFit(*scene, one.set);
    feel(*scene, one.set, f);
    std::sort(f.ticks.begin(), f.ticks.end());
    const auto at = [&f](double fraction) { return f.ticks.empty() ? 0.0 : quantile(f.ticks, fraction); };
    if (expected.empty())
    {
      expected = f.states;
      fastestFit = f.fit;
      fastestTick = at(0.5);
    }
    else if (!areSame(f.states, expected))
    {
      context.wrong = fmt::format("{}: other forces with {} than with the first set", name, one.name);
    }
    const auto ratio = [](double time, double fastest) { return fastest > 0.0 ? time / fastest : 0.0; };
    part.table.rows.push_back({ name, grouped(std::int64_t(points.size())), one.name, brief(f.fit),
      brief(ratio(f.fit, fastestFit)), brief(at(0.5)), brief(ratio(at(0.5), fastestTick)), brief(at(0.99)),
      brief(at(0.999)), brief(f.firstContact), brief(f.built) });
    part.rows.push_back({ { "cloud", name }, { "points", points.size() }, { "instructions", one.name },
      { "fit_us", f.fit }, { "p50_us", at(0.5) }, { "p99_us", at(0.99) }, { "p999_us", at(0.999) },
      { "first_contact_us", f.firstContact }, { "built_seconds", f.built } });
  }
}

void feelSphere(StudyContext& context, const HapticScene& scene, InstructionSet set, SetFigures& f)
{
  const Trial trial = runTrial(
    scene, {}, slideCourse(Shape::Sphere),
    [](const Vec3& hip) { return exactContact(Shape::Sphere, hip, ContactParameters().stiffness); },
    context.options.repetitions, set);
  f.ticks = trial.microseconds;
  f.states = trial.states;
  f.firstContact = trial.figures.firstContact;
}

void feelStrokes(StudyContext& context, const HapticScene& scene, InstructionSet set, SetFigures& f)
{
  for (const Stroke& stroke : strokesOn(scene, context.options.strokes))
  {
    StrokeTrace trace = feelStroke(scene, stroke, false, set);
    for (int i = 1; i < context.options.repetitions; ++i)
    {
      const StrokeTrace again = feelStroke(scene, stroke, false, set);
      std::transform(trace.microseconds.begin(), trace.microseconds.end(), again.microseconds.begin(),
        trace.microseconds.begin(), [](double a, double b) { return std::min(a, b); });
    }
    for (std::size_t i = 0; i < trace.states.size(); ++i)
    {
      const bool first = !trace.states[i].contact || i == 0 || !trace.states[i - 1].contact;
      if (first)
      {
        f.firstContact = std::max(f.firstContact, trace.microseconds[i]);
      }
      else
      {
        f.ticks.push_back(trace.microseconds[i]);
      }
    }
    f.states.insert(f.states.end(), trace.states.begin(), trace.states.end());
  }
}

} // namespace

ReportPart studyInstructions(StudyContext& context)
{
  ReportPart part;
  part.title = "The update's time with each instruction set";
  part.text =

    "`surface-fit` with each of the sets this machine has, one after the other in one run. Every\n"
    "force is the same, to the last bit. Ratios are to the first set's time.\n"
    "\n"
    "- fit: one local fit with all its terms, its cells gathered already, the fastest of many rounds.\n"
    "- sphere: the slide as above; scans: straight strokes, all ticks in contact.\n"
    "- finding: the longest update out of contact or into it.\n"
    "- built: from points in memory to a scene that can be felt, on one thread. Only the choice of\n"
    "  its radii is held to the set.";
  part.table.header = { "cloud", "points", "instructions", "fit us", "ratio", "p50 us", "ratio", "p99",
    "p99.9", "finding us", "built s" };
  for (const double noise : { 0.0, context.options.noises.back() })
  {
    addSets(context, part, "sphere, " + noiseName(noise), pointsOf(Shape::Sphere, mostPoints(context), noise),
      [&](const HapticScene& scene, InstructionSet set, SetFigures& f)
      { feelSphere(context, scene, set, f); });
  }
  for (const Scan& scan : context.options.scans)
  {
    double scale = 1.0;
    Vec3 middle;
    addSets(context, part, scan.name, fitted(scan.points, scale, middle),
      [&](const HapticScene& scene, InstructionSet set, SetFigures& f)
      { feelStrokes(context, scene, set, f); });
  }
  return part;
}

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
