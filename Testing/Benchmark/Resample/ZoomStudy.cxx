#include "Benchmark/Resample/Clouds.h"
#include "Benchmark/Resample/Ours.h"
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

constexpr double kShares[4] = { 0.001, 0.01, 0.1, 1.0 };
/// How far the workspace moves between two updates, as a share of its edge: enough to be another one.
constexpr double kShift = 1e-6;

/// A cube about a point of the sphere that holds @p share of the points; all of them: the whole workspace.
Bounds viewOfShare(const PointView& points, double share)
{
  const Vec3 center{ kSphereRadius * 0.6, kSphereRadius * 0.48, kSphereRadius * 0.64 };
  Bounds box;
  if (share >= 1.0)
  {
    box.include({ -0.5 * kWorkspaceEdge, -0.5 * kWorkspaceEdge, -0.5 * kWorkspaceEdge });
    box.include({ 0.5 * kWorkspaceEdge, 0.5 * kWorkspaceEdge, 0.5 * kWorkspaceEdge });
    return box;
  }
  std::vector<float> distances;
  distances.reserve(std::size_t(points.size()));
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Vec3 d = points[i] - center;
    distances.push_back(float(std::max({ std::abs(d.x), std::abs(d.y), std::abs(d.z) })));
  }
  const auto middle = distances.begin() + std::ptrdiff_t(share * double(points.size()));
  std::nth_element(distances.begin(), middle, distances.end());
  const double half = double(*middle);
  box.include(center - Vec3(half, half, half));
  box.include(center + Vec3(half, half, half));
  return box;
}

/// One view of the cloud: after the first time only the workspace changes, unless the input does too.
class View
{
public:
  View(const ResampleTask& task, bool inputChanges)
    : task_(task)
    , inputChanges_(inputChanges)
  {
    input_->SetPoints(task.cloud->GetPoints());
    filter_->SetInputData(input_);
    filter_->SetUsePointIndex(!inputChanges);
    setTask(filter_, task_, false);
  }
  void before()
  {
    if (inputChanges_)
    {
      input_->Modified();
    }
    shifted_ = !shifted_;
    const Vec3 step = (shifted_ ? kShift : 0.0) * task_.workspace.extent();
    ResampleTask moved = task_;
    moved.workspace.minimum = task_.workspace.minimum + step;
    moved.workspace.maximum = task_.workspace.maximum + step;
    setTask(filter_, moved, false);
  }
  void run() { filter_->Update(); }
  Verdict check() const
  {
    const ResampleAnswer answer = answerOf(filter_->GetOutput());
    return judge(answer, expectedMeans(viewOf(task_.cloud), answer.lattice), true);
  }

private:
  ResampleTask task_;
  bool inputChanges_;
  bool shifted_ = false;
  vtkNew<vtkPolyData> input_;
  vtkNew<vtkVoxelMeanResampler> filter_;
};

/// Two contestants a share: moved (input as it was) and scanned (input modified too).
struct ZoomRace
{
  std::vector<std::unique_ptr<View>> views;
  std::vector<Verdict> verdicts;
  std::vector<Lap> laps;

  const Lap& moved(std::size_t share) const { return laps[2 * share]; }
  const Lap& scanned(std::size_t share) const { return laps[2 * share + 1]; }
};

ZoomRace runRace(const ResampleTask& whole, StudyContext& context)
{
  ZoomRace zoom;
  for (const double share : kShares)
  {
    ResampleTask task = whole;
    task.workspace = viewOfShare(viewOf(whole.cloud), share);
    zoom.views.push_back(std::make_unique<View>(task, false));
    zoom.views.push_back(std::make_unique<View>(task, true));
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
  settings.inARow = 2;
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config(mostThreads(context)), [&] { zoom.laps = race(contestants, settings); });
  return zoom;
}

void addRow(const ZoomRace& zoom, std::size_t share, StudyContext& context, ReportPart& part)
{
  const std::size_t all = std::size(kShares) - 1;
  const Quartiles moved = quartiles(zoom.moved(share).seconds);
  const Quartiles scanned = quartiles(zoom.scanned(share).seconds);
  const Quartiles ofFull = pairedRatios(zoom.moved(share).seconds, zoom.scanned(all).seconds);
  const Quartiles ofScan = pairedRatios(zoom.moved(share).seconds, zoom.scanned(share).seconds);
  const Verdict& verdict = zoom.verdicts[2 * share];
  const bool right = verdict.right && zoom.verdicts[2 * share + 1].right;
  context.allRight = context.allRight && right;
  part.table.rows.push_back({ brief(100.0 * kShares[share]), brief(1e3 * moved.median),
    brief(1e3 * moved.lower) + " - " + brief(1e3 * moved.upper), brief(1e3 * scanned.median),
    brief(100.0 * ofFull.median), brief(100.0 * ofScan.median), grouped(verdict.voxels),
    right ? "right" : "wrong" });
  part.rows.push_back({ { "points", context.options.zoomPoints }, { "share_inside", kShares[share] },
    { "threads", mostThreads(context) }, { "repetitions", moved.count },
    { "moved_median_seconds", moved.median }, { "scan_median_seconds", scanned.median },
    { "first_seconds", zoom.moved(share).firstSeconds }, { "of_full_update", ofFull.median },
    { "of_scan", ofScan.median }, { "voxels", verdict.voxels }, { "right", right } });
}

} // namespace

ReportPart studyZoom(StudyContext& context)
{
  const std::int64_t count = context.options.zoomPoints;
  context.progress(fmt::format("zooming into {} points", count));
  ReportPart part;
  part.title = "Zooming: only the workspace changed";
  part.text = fmt::format(
    "{} points in random order, {} voxels on an axis of each view, {} threads. Moved: the workspace changed, "
    "the input did not. Scan: the input was modified too, as if the view were the first. Full update: the "
    "scan "
    "with all points inside.",
    grouped(count), context.options.dimension, mostThreads(context));
  part.table.header = { "% inside", "moved ms", "quartiles ms", "scan ms", "% of full update", "% of scan",
    "voxels", "answer" };
  const auto cloud = sphereCloud(count, PointOrder::Random);
  const ZoomRace zoom = runRace(taskOn(cloud, context.options.dimension), context);
  std::vector<Series> lines;
  for (std::size_t share = 0; share < std::size(kShares); ++share)
  {
    addRow(zoom, share, context, part);
    const double percent = 100.0 * kShares[share];
    addPoint(lines, "workspace moved", percent, 1e3 * quartiles(zoom.moved(share).seconds).median);
    addPoint(lines, "scan of all points", percent, 1e3 * quartiles(zoom.scanned(share).seconds).median);
  }
  part.charts.push_back({ "resample-zoom", fmt::format("Views of {} points", grouped(count)),
    { "points inside the workspace (%)", true }, { "time (ms)", true }, lines });
  return part;
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
