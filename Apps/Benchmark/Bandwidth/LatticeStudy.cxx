#include "Benchmark/Bandwidth/Clouds.h"
#include "Benchmark/Bandwidth/Studies.h"

#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Neighbors/NeighborQuery.h"

#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

constexpr int kDimensions[] = { 1200, 600, 300, 150, 75 };
constexpr int kShownWithoutCounts = 300;
constexpr int kAround = 16;

/// Bandwidths of the raw points, or of the means on a lattice.
struct Pipeline
{
  int dimension = 0;  ///< 0: the raw points.
  bool counts = true; ///< Radii of the points in the voxels.
  vtkSmartPointer<vtkVoxelMeanResampler> resampler;
  vtkSmartPointer<vtkKernelBandwidthFilter> filter;

  vtkPolyData* output() const { return filter->GetOutput(); }
};

Pipeline pipelineOn(const NamedCloud& cloud, int dimension, bool counts = true)
{
  Pipeline pipeline;
  pipeline.dimension = dimension;
  pipeline.counts = counts;
  pipeline.filter = vtkSmartPointer<vtkKernelBandwidthFilter>::New();
  pipeline.filter->ComputeDensityOff();
  pipeline.filter->SetUsePointCounts(counts);
  if (dimension == 0)
  {
    pipeline.filter->SetInputData(cloud.polyData);
    return pipeline;
  }
  pipeline.resampler = vtkSmartPointer<vtkVoxelMeanResampler>::New();
  pipeline.resampler->SetInputData(cloud.polyData);
  pipeline.resampler->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
  pipeline.resampler->SetDimensions(dimension, dimension, dimension);
  pipeline.filter->SetInputConnection(pipeline.resampler->GetOutputPort());
  return pipeline;
}

struct Radii
{
  double low = 0.0; ///< 5 % of the points have less.
  double median = 0.0;
  double high = 0.0;    ///< 5 % have more.
  double scatter = 0.0; ///< RMS deviation from the mean of the points around, relative.
};

Radii radiiOf(vtkPolyData* cloud)
{
  auto* array = vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetArray("ProxyRadius"));
  std::vector<Vec3> points(std::size_t(cloud->GetNumberOfPoints()));
  std::vector<double> radii;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    cloud->GetPoint(i, &points[std::size_t(i)].x);
    radii.push_back(array->GetValue(i));
  }
  NeighborQuery query;
  query.build(PointView(points.data(), std::int64_t(points.size())));
  const std::size_t step = std::max<std::size_t>(1, points.size() / 20000);
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < points.size(); i += step)
  {
    Neighbor around[kAround + 1];
    const int found = query.nearest(points[i], kAround + 1, around);
    double sum = 0.0;
    for (int j = 0; j < found; ++j)
    {
      sum += radii[std::size_t(around[j].index)];
    }
    const double deviation = radii[i] * found / sum - 1.0;
    squares += deviation * deviation;
    count += 1.0;
  }
  std::sort(radii.begin(), radii.end());
  return { quantile(radii, 0.05), quantile(radii, 0.5), quantile(radii, 0.95), std::sqrt(squares / count) };
}

} // namespace

ReportPart studyLattice(StudyContext& context)
{
  const NamedCloud cloud = shapeCloud(Shape::Idol, context.options.latticePoints);
  context.progress(fmt::format("lattice means of {} points", cloud.size()));
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "Lattice means against raw points";
  part.text = fmt::format(
    "{} points of the statue, whose density varies by 16:1, in a workspace of 10 cm, {} threads. Time: mean "
    "resampling, bandwidths and radii. Radii in millimetres, the range within which 90 % of them lie. "
    "Scatter: RMS "
    "deviation of a radius from the mean of those of the {} points around it, which is what a proxy meets as "
    "roughness. Means tell how many points each stands for, and radii are those of these points; with the "
    "counts unused they are those of the means, which stand about a voxel apart wherever there are points.",
    grouped(cloud.size()), context.mostThreads(), kAround);
  part.table.header = { "felt", "points", "ms", "radius 5 %", "median", "95 %", "95 % / 5 %", "scatter %" };
  std::vector<Pipeline> pipelines{ pipelineOn(cloud, 0) };
  for (const int dimension : kDimensions)
  {
    pipelines.push_back(pipelineOn(cloud, dimension));
  }
  pipelines.push_back(pipelineOn(cloud, kShownWithoutCounts, false));
  std::vector<Contestant> contestants;
  for (const Pipeline& pipeline : pipelines)
  {
    Contestant contestant;
    contestant.before = [cloud = cloud.polyData] { cloud->Modified(); };
    contestant.run = [filter = pipeline.filter] { filter->Update(); };
    contestants.push_back(std::move(contestant));
  }
  const std::vector<Lap> laps = timed(contestants, context.mostThreads(), context, 0.5);
  std::vector<Series> lines;
  for (std::size_t i = 0; i < pipelines.size(); ++i)
  {
    const Radii radii = radiiOf(pipelines[i].output());
    const double seconds = quartiles(laps[i].seconds).median;
    const std::string name = pipelines[i].dimension == 0
      ? "raw points"
      : fmt::format(
          "means, {0}^3 voxels{1}", pipelines[i].dimension, pipelines[i].counts ? "" : ", counts unused");
    part.table.rows.push_back({ name, grouped(pipelines[i].output()->GetNumberOfPoints()),
      milliseconds(seconds), brief(1e3 * radii.low), brief(1e3 * radii.median), brief(1e3 * radii.high),
      brief(radii.high / radii.low), brief(100.0 * radii.scatter) });
    part.rows.push_back({ { "felt", name }, { "dimension", pipelines[i].dimension },
      { "counts", pipelines[i].counts }, { "points", pipelines[i].output()->GetNumberOfPoints() },
      { "median_seconds", seconds }, { "radius_5_percent", radii.low }, { "radius_median", radii.median },
      { "radius_95_percent", radii.high }, { "radius_scatter", radii.scatter } });
    if (pipelines[i].counts)
    {
      addPoint(lines, pipelines[i].dimension == 0 ? "raw points" : "lattice means", 1e3 * seconds,
        100.0 * radii.scatter);
    }
  }
  part.charts.push_back({ "bandwidth-lattice", "Scatter of the radii: lattice means against raw points",
    { "time (ms)", true }, { "scatter of the radii (%)", true }, lines });
  return part;
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
