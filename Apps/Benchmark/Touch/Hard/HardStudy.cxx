/// Is a hand let go, does it get no energy, and does it not fall through, on the clouds that make it hardest?
#include "Benchmark/Touch/Hard/HandInTheLoop.h"
#include "Benchmark/Touch/Hard/HardFigures.h"
#include "Benchmark/Touch/Studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>

namespace pointhaptics::bench::touch
{
namespace
{

using namespace hard;

/// A row whose name begins with @p rows misses this limit where @p figure (its key in JSON) is above it. Of
/// several limits for a row's figure the last one holds.
struct Limit
{
  const char* rows;
  const char* figure;
  double most;
};

/// The one place of the limits. Rows of all names: a hand is let go, gets no energy, and never more than the
/// limit of the force. The others: what was asked of each family.
constexpr Limit kLimits[] = {
  { "", "non_finite", 0.0 },
  { "", "held", 0.0 },
  { "", "not_let_go", 0.0 },
  { "", "energy_mj", 0.2 },
  { "", "largest_newton", 8.0 + 1e-9 },
  { "", "oscillating", 0.0 },
  { "", "energy_over_plane_mj", 0.1 },
  { "rim", "held", 2.0 },
  { "leaves", "held", 2.0 },
  { "leaves", "phantom_percent", 6.0 },
  { "leaves", "lost_percent", 15.0 },
  { "fog", "contact_spacings", 2.0 },
  { "fog", "build_seconds", 3.0 },
  { "fog", "local_build_ms", 10.0 },
  { "sheet", "fell_through", 0.0 },
  { "steps 1:4", "fell_through", 0.0 },
  { "steps 1:6", "fell_through", 0.0 },
  { "steps 1:8", "fell_through", 0.0 },
  { "bracket", "median_percent", 1e-3 },
  { "bracket 47516", "phantom_newton", 1.0 },
  { "bracket 47516", "p95_percent", 40.0 },
  { "bracket 543652", "phantom_newton", 0.3 },
  { "bracket 543652", "p95_percent", 15.0 },
  { "gear", "median_percent", 1e-3 },
  { "gear", "phantom_newton", 1.0 },
  { "gear 543652", "phantom_newton", 0.3 },
  { "gear 543652", "p95_percent", 30.0 },
  { "teeth", "median_percent", 30.0 },
  { "teeth 543652", "phantom_newton", 0.3 },
  { "teeth 543652", "p95_percent", 30.0 },
  { "scan vertices lucy", "median_percent", 6.5 },
  { "scan vertices lucy", "phantom_newton", 2.0 },
  { "scan vertices lucy", "p95_percent", 50.0 },
  { "scan", "p50_us", 4.0 },
  { "scan", "p99_us", 25.0 },
};

/// A row's figures. One that is not finite is null in JSON: the row has no such figure.
struct Row
{
  std::string name;
  std::size_t points = 0;
  HardFigures figures;
  double buildSeconds = HardFigures::kNone;
  double localBuildMs = HardFigures::kNone; ///< Longest of a local scene, processor time.
  double oscillating = HardFigures::kNone;  ///< Runs of the hand in the loop that tremble.
  double energyOverPlane = HardFigures::kNone;
  bool isLoop() const { return std::isfinite(oscillating); }
};

/// Processor time of this thread: other work on the machine does not count.
double threadSeconds()
{
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Measures the processor time of prepare(), which makes the scenes near the hand.
class TimedMethod : public TouchMethod
{
public:
  explicit TimedMethod(const ContactParameters& contact, InstructionSet instructions)
    : method_(proxyWithoutPrefetch(contact, instructions))
  {
  }
  void reset(const TouchScene& scene) override { method_->reset(scene); }
  void prepare(const Vec3& hip) override
  {
    const double before = threadSeconds();
    method_->prepare(hip);
    longest_ = std::max(longest_, 1e3 * (threadSeconds() - before));
  }
  ProxyState step(const Vec3& hip, double dt) override { return method_->step(hip, dt); }
  double longest() const { return longest_; }

private:
  std::unique_ptr<TouchMethod> method_;
  double longest_ = 0.0;
};

Json numberOrNull(double value)
{
  return std::isfinite(value) ? Json(value) : Json();
}

/// "held 3 > 0" for each limit that @p row misses.
std::vector<std::string> missedBy(const std::string& name, const Json& row)
{
  std::vector<std::string> missed;
  std::map<std::string, double> limits;
  for (const Limit& limit : kLimits)
  {
    if (name.rfind(limit.rows, 0) == 0)
    {
      limits[limit.figure] = limit.most;
    }
  }
  for (const auto& [figure, most] : limits)
  {
    const Json& value = row.at(figure);
    if (value.is_number() && value.get<double>() > most)
    {
      missed.push_back(fmt::format("{} {:.3g} > {:.3g}", figure, value.get<double>(), most));
    }
  }
  return missed;
}

/// Rounding of a path's energy is no energy, and -0 no figure.
double milliJoule(double joule)
{
  return std::abs(joule) < 1e-12 ? 0.0 : 1e3 * joule;
}

/// The keys are stable. A figure that a row does not have is null: those of a truth where there is none,
/// those of strokes in rows of the hand in the loop ("loop ..."), and the other way round.
Json toJson(const Row& row)
{
  const HardFigures& f = row.figures;
  Json json{ { "name", row.name }, { "points", row.points }, { "strokes", f.strokes }, { "held", f.held },
    { "not_let_go", f.notLetGo }, { "truth_held", f.truthHeld }, { "fell_through", f.fellThrough },
    { "non_finite", f.nonFinite }, { "phantom_percent", numberOrNull(f.phantomPercent) },
    { "phantom_newton", numberOrNull(f.phantomNewton) }, { "lost_percent", numberOrNull(f.lostPercent) },
    { "median_percent", numberOrNull(f.medianPercent) }, { "p95_percent", numberOrNull(f.p95Percent) },
    { "energy_mj", milliJoule(f.energyJoule) }, { "largest_newton", f.largestNewton },
    { "contact_spacings", f.contactSpacings }, { "p50_us", f.p50 }, { "p99_us", f.p99 } };
  if (row.isLoop() || !f.hasTruth())
  {
    json["truth_held"] = json["fell_through"] = nullptr;
  }
  if (row.isLoop())
  {
    for (const char* key :
      { "held", "not_let_go", "energy_mj", "largest_newton", "contact_spacings", "p50_us", "p99_us" })
    {
      json[key] = nullptr;
    }
  }
  json.update({ { "build_seconds", numberOrNull(row.buildSeconds) },
    { "local_build_ms", numberOrNull(row.localBuildMs) }, { "oscillating", numberOrNull(row.oscillating) },
    { "energy_over_plane_mj", numberOrNull(row.energyOverPlane) } });
  json["status_percent"] = statusOf(f.statusPercent);
  return json;
}

void addRow(StudyContext& context, const Row& row)
{
  Json json = toJson(row);
  const std::vector<std::string> missed = missedBy(row.name, json);
  json["pass"] = missed.empty();
  json["missed"] = missed;
  context.run.add("hard", std::move(json));
}

Row strokesRow(StudyContext& context, const HardScene& hard, const TouchScene& scene)
{
  const ContactParameters contact;
  const CloudDistance distance(*scene.points);
  const std::vector<TouchTruth> truths = hardTruths(hard, contact.stiffness);
  TimedMethod method(contact, context.options.instructions);
  HardJudge judge(hard, distance, contact.stiffness);
  for (std::size_t i = 0; i < hard.strokes.size(); ++i)
  {
    const TouchTruth* truth = truths.empty() ? nullptr : &truths[i];
    const std::size_t ticks = truth ? truth->ticks.size() : hard.strokes[i].hip.size();
    judge.add(walk(method, scene, hard.strokes[i], ticks, 1), truth);
  }
  Row row;
  row.name = hard.name;
  row.points = scene.points->size();
  row.figures = judge.figures();
  row.localBuildMs = method.longest();
  return row;
}

/// Hands in the loop at the scene's places, beside the same ones on planes there.
Row loopRow(StudyContext& context, const HardScene& hard, const TouchScene& scene)
{
  constexpr double kTrembles = 10e-6;
  constexpr double kIsStill = 5e-6; ///< A plane's; half, so that no run hangs on a micrometre.
  Row row;
  row.name = "loop " + hard.name;
  row.points = scene.points->size();
  row.oscillating = 0.0;
  row.energyOverPlane = -INFINITY;
  for (const LoopHand& hand : loopHands(context.options.quick))
  {
    ContactParameters contact;
    contact.stiffness = hand.stiffness;
    TimedMethod method(contact, context.options.instructions);
    for (const TouchPlace& place : hard.loopPlaces)
    {
      method.reset(scene);
      const LoopFigures felt = runLoop(hand, place,
        [&](const Vec3& hip)
        {
          method.prepare(hip);
          return method.step(hip, kTickSeconds).force;
        });
      const LoopFigures plane = runOnPlane(hand, place);
      row.oscillating += felt.oscillation > kTrembles && plane.oscillation <= kIsStill;
      row.energyOverPlane = std::max(row.energyOverPlane, milliJoule(felt.energyJoule - plane.energyJoule));
      ++row.figures.strokes;
    }
  }
  return row;
}

void addScene(StudyContext& context, HardScene hard)
{
  const double before = secondsNow();
  const TouchScene scene = makeTouchScene(std::move(hard.points), sceneSettings(context.options));
  if (!scene.scene)
  {
    context.run.remark("hard", "Left out: " + hard.name + " has no finite points");
    return;
  }
  const double seconds = secondsNow() - before;
  context.run.say("hands on " + hard.name);
  Row row = strokesRow(context, hard, scene);
  row.buildSeconds = seconds;
  addRow(context, row);
  if (!hard.loopPlaces.empty())
  {
    context.run.say("hands in the loop on " + hard.name);
    addRow(context, loopRow(context, hard, scene));
  }
}

} // namespace

void studyHard(StudyContext& context)
{
  for (const HardSceneMaker& maker : hardScenes(context.options))
  {
    addScene(context, maker.make());
  }
  if (!context.run.parts().contains("hard"))
  {
    return;
  }
  const Json& rows = context.run.parts()["hard"]["rows"];
  const auto misses =
    std::count_if(rows.begin(), rows.end(), [](const Json& row) { return !row["missed"].empty(); });
  if (misses > 0)
  {
    context.run.fault(fmt::format("{} of {} rows of the hard scenes miss a limit", misses, rows.size()));
  }
}

} // namespace pointhaptics::bench::touch
