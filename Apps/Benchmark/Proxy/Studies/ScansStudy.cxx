/// Does the proxy hold on real scans? Whether its force is right there is what `bench touch` asks.
#include "Benchmark/Harness/Statistics.h"
#include "Benchmark/Proxy/Strokes.h"
#include "Benchmark/Proxy/Studies/Studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace proxy
{
namespace
{

/// A tick whose force falls by more than this is a drop, newtons.
constexpr double kDrop = 0.2;

struct ScanFigures
{
  int strokes = 0;
  int drops = 0; ///< Strokes in which a tick lets the force fall by more than kDrop.
  int balls = 0; ///< Strokes in which the ball alone was felt for a tick or more.
  int nonFinite = 0;
  double largestChange = 0.0; ///< Of the force within a tick beyond 2 K |dH|, newtons.
  std::vector<double> steps;  ///< Over K |dH|, sorted.
  std::vector<double> microseconds;
};

void add(const StrokeTrace& trace, ScanFigures& figures)
{
  const double stiffness = ContactParameters().stiffness;
  bool dropped = false;
  std::uint32_t status = 0;
  for (std::size_t i = 0; i < trace.states.size(); ++i)
  {
    const ProxyState& state = trace.states[i];
    figures.nonFinite += !isFinite(state.force) || !isFinite(state.proxy) || !isFinite(state.normal);
    status |= state.status;
    if (i == 0)
    {
      continue;
    }
    const ProxyState& last = trace.states[i - 1];
    const double moved = norm(state.hip - last.hip);
    const double step = norm(state.force - last.force);
    dropped = dropped || norm(last.force) - norm(state.force) > kDrop;
    figures.largestChange = std::max(figures.largestChange, step - 2.0 * stiffness * moved);
    if (moved > kSmallestMove && (state.contact || last.contact))
    {
      figures.steps.push_back(step / (stiffness * moved));
    }
  }
  ++figures.strokes;
  figures.drops += dropped;
  figures.balls += (status & kProxyBallContact) != 0;
  figures.microseconds.insert(
    figures.microseconds.end(), trace.microseconds.begin(), trace.microseconds.end());
}

ScanFigures feelScan(const HapticScene& scene, int count, bool following)
{
  ScanFigures figures;
  for (const Stroke& stroke : strokesOn(scene, count))
  {
    add(feelStroke(scene, stroke, following), figures);
  }
  std::sort(figures.steps.begin(), figures.steps.end());
  std::sort(figures.microseconds.begin(), figures.microseconds.end());
  return figures;
}

double at(const std::vector<double>& sorted, double part)
{
  return sorted.empty() ? 0.0 : quantile(sorted, part);
}

} // namespace

ReportPart studyScans(StudyContext& context)
{
  ReportPart part;
  if (context.options.scans.empty())
  {
    return part;
  }
  part.page = Page::Accuracy;
  part.title = "Real scans";
  part.text = fmt::format(
    "Scans fitted into 95 mm, {} strokes each at random places that can be reached from outside. A\n"
    "stroke is pressed to 1 mm, then slid 10 mm at 10 mm/s, straight on or following the felt surface\n"
    "at 1 mm depth.\n"
    "\n"
    "- drops: strokes in which the force falls by more than {} N within a tick.\n"
    "- ball: strokes in which the ball alone was felt for a tick or more: at rims, edges and folds.\n"
    "- change: the most that a tick changes the force beyond 2 K|dH|. In contact that is the settle\n"
    "  rate, 0.1 N, at most; where a hand comes off an edge or through a hole the force ends at once.\n"
    "- times: every tick is timed once, whatever the machine did meanwhile.",
    context.options.strokes, kDrop);
  part.table.header = { "scan", "points", "hand", "strokes", "drops", "ball", "not finite", "change N",
    "step p50", "p99", "p50 us", "p99", "p99.9" };
  for (const Scan& scan : context.options.scans)
  {
    context.progress("strokes on " + scan.name);
    double scale = 1.0;
    Vec3 middle;
    const Scene scene = sceneOf(fitted(scan.points, scale, middle));
    if (!scene)
    {
      part.remarks.push_back("Left out: " + scan.name + " has no finite points");
      continue;
    }
    for (const bool following : { false, true })
    {
      const ScanFigures f = feelScan(*scene, context.options.strokes, following);
      const std::string hand = following ? "following" : "straight";
      part.table.rows.push_back({ scan.name, grouped(std::int64_t(scan.points.size())), hand,
        fmt::format("{}", f.strokes), fmt::format("{}", f.drops), fmt::format("{}", f.balls),
        fmt::format("{}", f.nonFinite), fmt::format("{:.4f}", f.largestChange), brief(at(f.steps, 0.5)),
        brief(at(f.steps, 0.99)), brief(at(f.microseconds, 0.5)), brief(at(f.microseconds, 0.99)),
        brief(at(f.microseconds, 0.999)) });
      part.rows.push_back({ { "scan", scan.name }, { "points", scan.points.size() }, { "hand", hand },
        { "strokes", f.strokes }, { "drops", f.drops }, { "ball", f.balls }, { "not_finite", f.nonFinite },
        { "largest_change_newton", f.largestChange }, { "step_p50", at(f.steps, 0.5) },
        { "step_p99", at(f.steps, 0.99) }, { "p50_us", at(f.microseconds, 0.5) },
        { "p99_us", at(f.microseconds, 0.99) }, { "p999_us", at(f.microseconds, 0.999) } });
      if (f.nonFinite > 0)
      {
        context.wrong = fmt::format("{}: {} states that are not finite", scan.name, f.nonFinite);
      }
    }
  }
  return part;
}

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
