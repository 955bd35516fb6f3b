#include "Benchmark/Resample/Clouds.h"
#include "Benchmark/Resample/Rivals/Ours.h"
#include "Benchmark/Resample/Studies.h"

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

constexpr double kFractions[4] = { 0.001, 0.01, 0.1, 1.0 };
/// Views of a row, through which an update goes after the other and begins again.
constexpr int kViews = 16;
/// How far the workspace moves between two updates, as a fraction of its edge.
constexpr double kStep = 0.1;
/// The same where all points stay inside: enough to be another workspace.
constexpr double kSmallStep = 1e-6;
/// Updates in a row, the last of which is measured: what is warm is what a moving view finds warm.
constexpr int kInARow = 8;

/// The whole workspace, moved by @p step.
Bounds wholeView(double step)
{
  const double half = 0.5 * kWorkspaceEdge;
  Bounds box;
  box.include({ step - half, step - half, step - half });
  box.include({ step + half, step + half, step + half });
  return box;
}

/// A cube about a point of the sphere that holds @p fraction of the points. @p turn: of the point, about z.
Bounds viewOfFraction(const PointView& points, double fraction, double turn)
{
  const double x = kSphereRadius * 0.6;
  const double y = kSphereRadius * 0.48;
  const Vec3 center{ x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn),
    kSphereRadius * 0.64 };
  std::vector<float> distances;
  distances.reserve(std::size_t(points.size()));
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Vec3 d = points[i] - center;
    distances.push_back(float(std::max({ std::abs(d.x), std::abs(d.y), std::abs(d.z) })));
  }
  const auto middle = distances.begin() + std::ptrdiff_t(fraction * double(points.size()));
  std::nth_element(distances.begin(), middle, distances.end());
  const double half = double(*middle);
  Bounds box;
  box.include(center - Vec3(half, half, half));
  box.include(center + Vec3(half, half, half));
  return box;
}

/// Views that hold @p fraction of the points, each kStep on from the one before along the surface.
std::vector<Bounds> viewsOfFraction(const PointView& points, double fraction)
{
  std::vector<Bounds> views;
  if (fraction >= 1.0)
  {
    return { wholeView(0.0), wholeView(kSmallStep * kWorkspaceEdge) };
  }
  double turn = 0.0;
  for (int i = 0; i < kViews; ++i)
  {
    views.push_back(viewOfFraction(points, fraction, turn));
    turn += kStep * views.back().extent().x / (kSphereRadius * std::hypot(0.6, 0.48));
  }
  return views;
}

/// A moving view of the cloud: after the first time only the workspace changes, unless the input does too.
class View
{
public:
  View(const ResampleTask& task, const std::vector<Bounds>& workspaces, bool inputChanges)
    : task_(task)
    , workspaces_(workspaces)
    , inputChanges_(inputChanges)
  {
    input_->SetPoints(task.cloud->GetPoints());
    filter_->SetInputData(input_);
    filter_->SetUsePointIndex(!inputChanges);
  }
  void before()
  {
    if (inputChanges_)
    {
      input_->Modified();
    }
    task_.workspace = workspaces_[next_++ % workspaces_.size()];
    setTask(filter_, task_, false);
  }
  void run() { filter_->Update(); }
  Verdict check() const
  {
    const ResampleAnswer answer = answerOf(filter_->GetOutput());
    return judge(answer, expectedMeans(viewOf(task_.cloud), answer.lattice), ComparedWith::ExactMeans);
  }

private:
  ResampleTask task_;
  std::vector<Bounds> workspaces_;
  bool inputChanges_;
  std::size_t next_ = 0;
  vtkNew<vtkPolyData> input_;
  vtkNew<vtkVoxelMeanResampler> filter_;
};

/// Two contestants a view: moved (input as it was) and scanned (input modified too).
struct ZoomRace
{
  std::vector<std::unique_ptr<View>> views;
  std::vector<Verdict> verdicts;
  std::vector<Lap> laps;

  const Lap& moved(std::size_t view) const { return laps[2 * view]; }
  const Lap& scanned(std::size_t view) const { return laps[2 * view + 1]; }
};

ZoomRace runRace(const ResampleTask& whole, StudyContext& context)
{
  ZoomRace zoom;
  for (const double fraction : kFractions)
  {
    const std::vector<Bounds> workspaces = viewsOfFraction(viewOf(whole.cloud), fraction);
    zoom.views.push_back(std::make_unique<View>(whole, workspaces, false));
    zoom.views.push_back(std::make_unique<View>(whole, workspaces, true));
  }
  zoom.verdicts.resize(zoom.views.size());
  std::vector<Contestant> contestants;
  for (std::size_t i = 0; i < zoom.views.size(); ++i)
  {
    View& view = *zoom.views[i];
    Verdict& verdict = zoom.verdicts[i];
    contestants.push_back({ "", [&view] { view.run(); }, [&view] { view.before(); },
      [&view, &verdict]
      {
        verdict = view.check();
        return true;
      } });
  }
  RaceSettings settings;
  settings.rounds = context.options.repetitions;
  settings.warmUps = std::max(2, context.options.warmUps); // an index may be built on the second update
  settings.inARow = kInARow;
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config(mostThreads(context)), [&] { zoom.laps = race(contestants, settings); });
  return zoom;
}

void addRow(const ZoomRace& zoom, std::size_t view, StudyContext& context, ReportPart& part)
{
  const std::size_t all = std::size(kFractions) - 1;
  const Quartiles moved = quartiles(zoom.moved(view).seconds);
  const Quartiles afterOthers = quartiles(zoom.moved(view).afterOthers);
  const Quartiles scanned = quartiles(zoom.scanned(view).seconds);
  const Quartiles ofFull = pairedRatios(zoom.moved(view).seconds, zoom.scanned(all).seconds);
  const Quartiles ofScan = pairedRatios(zoom.moved(view).seconds, zoom.scanned(view).seconds);
  const Verdict& verdict = zoom.verdicts[2 * view];
  const bool right = verdict.right && zoom.verdicts[2 * view + 1].right;
  context.allRight = context.allRight && right;
  part.table.rows.push_back({ brief(100.0 * kFractions[view]), brief(1e3 * moved.median),
    brief(1e3 * moved.lower) + " - " + brief(1e3 * moved.upper), brief(1e3 * afterOthers.median),
    brief(1e3 * scanned.median), brief(100.0 * ofFull.median), brief(100.0 * ofScan.median),
    grouped(verdict.voxels), right ? "right" : "wrong" });
  part.rows.push_back({ { "points", context.options.zoomPoints }, { "fraction_inside", kFractions[view] },
    { "threads", mostThreads(context) }, { "repetitions", moved.count },
    { "moved_median_seconds", moved.median }, { "after_others_seconds", afterOthers.median },
    { "scan_median_seconds", scanned.median }, { "first_seconds", zoom.moved(view).firstSeconds },
    { "of_full_update", ofFull.median }, { "of_scan", ofScan.median }, { "voxels", verdict.voxels },
    { "right", right } });
}

} // namespace

ReportPart studyZoom(StudyContext& context)
{
  const std::int64_t count = context.options.zoomPoints;
  context.progress(fmt::format("zooming into {} points", count));
  ReportPart part;
  part.title = "Zooming: only the workspace changed";
  part.text = fmt::format(

    "{} points in random order, {} voxels on an axis of each view, {} threads.\n"
    "\n"
    "- moved: the workspace went a tenth of its edge further along the surface, the input did not\n"
    "  change; the last of {} such updates in a row. After others: the first of these, when the\n"
    "  caches hold what others left.\n"
    "- scan: the input was modified too, as if each view were the first.\n"
    "- full update: the scan with all points inside.",
    grouped(count), context.options.dimension, mostThreads(context), kInARow);
  part.table.header = { "% inside", "moved ms", "quartiles ms", "after others ms", "scan ms",
    "% of full update", "% of scan", "voxels", "answer" };
  const auto cloud = sphereCloud(count, PointOrder::Random);
  const ZoomRace zoom = runRace(taskOn(cloud, context.options.dimension), context);
  std::vector<Series> lines;
  for (std::size_t view = 0; view < std::size(kFractions); ++view)
  {
    addRow(zoom, view, context, part);
    const double percent = 100.0 * kFractions[view];
    addPoint(lines, "workspace moved", percent, 1e3 * quartiles(zoom.moved(view).seconds).median);
    addPoint(lines, "scan of all points", percent, 1e3 * quartiles(zoom.scanned(view).seconds).median);
  }
  part.charts.push_back({ "resample-zoom", fmt::format("Views of {} points", grouped(count)),
    { "points inside the workspace (%)", true }, { "time (ms)", true }, lines });
  return part;
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
