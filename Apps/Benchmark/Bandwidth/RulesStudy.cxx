#include "Benchmark/Bandwidth/Clouds.h"
#include "Benchmark/Bandwidth/Studies.h"

#include "vtkKernelBandwidthFilter.h"

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>
#include <utility>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

/// The slow rule takes its time: a part of the points will do.
constexpr std::int64_t kPart = 10;

struct RuleSetting
{
  const char* name;
  int rule;
  bool density;
  int kernel;
  bool smooth;
};

constexpr RuleSetting kSettings[] = {
  { "normal-reference", vtkKernelBandwidthFilter::NormalReference, false, 0, false },
  { "scott", vtkKernelBandwidthFilter::ScottMultivariate, false, 0, false },
  { "silverman", vtkKernelBandwidthFilter::SilvermanMultivariate, false, 0, false },
  { "silverman-robust", vtkKernelBandwidthFilter::SilvermanRobust, false, 0, false },
  { "sheather-jones", vtkKernelBandwidthFilter::SheatherJones, false, 0, false },
  { "normal-reference, smooth radii", vtkKernelBandwidthFilter::NormalReference, false, 0, true },
  { "normal-reference, Gaussian density", vtkKernelBandwidthFilter::NormalReference, true,
    vtkKernelBandwidthFilter::Gaussian, false },
  { "normal-reference, Epanechnikov density", vtkKernelBandwidthFilter::NormalReference, true,
    vtkKernelBandwidthFilter::Epanechnikov, false },
};

} // namespace

ReportPart studyRules(StudyContext& context)
{
  const NamedCloud cloud =
    shapeCloud(Shape::DensityStep, std::max<std::int64_t>(1000, context.options.points / kPart));
  context.progress(fmt::format("rules on {} points", cloud.size()));
  ReportPart part;
  part.title = "What the options of the filter cost";
  part.text = fmt::format("{} points of the density step, {} neighbours, {} threads.", grouped(cloud.size()),
    context.options.neighbors, context.mostThreads());
  part.table.header = { "computed", "median ms", "quartiles ms", "ns/point", "x the default rule" };
  std::vector<vtkSmartPointer<vtkKernelBandwidthFilter>> filters;
  std::vector<Contestant> contestants;
  for (const RuleSetting& setting : kSettings)
  {
    auto filter = vtkSmartPointer<vtkKernelBandwidthFilter>::New();
    filter->SetInputData(cloud.polyData);
    filter->SetNumberOfNeighbors(context.options.neighbors);
    filter->SetRule(setting.rule);
    filter->SetComputeDensity(setting.density);
    filter->SetDensityKernel(setting.kernel);
    filter->SetSmoothRadius(setting.smooth);
    filters.push_back(filter);
    Contestant contestant;
    contestant.name = setting.name;
    contestant.before = [filter] { filter->Modified(); };
    contestant.run = [filter] { filter->Update(); };
    contestants.push_back(std::move(contestant));
  }
  const std::vector<Lap> laps = timed(contestants, context.mostThreads(), context, 0.5);
  for (const Lap& lap : laps)
  {
    const Quartiles seconds = quartiles(lap.seconds);
    const Quartiles times = pairedRatios(lap.seconds, laps.front().seconds);
    part.table.rows.push_back({ lap.name, milliseconds(seconds.median), quartilesText(seconds),
      brief(1e9 * seconds.median / double(cloud.size())), brief(times.median) });
    part.rows.push_back({ { "computed", lap.name }, { "points", cloud.size() },
      { "median_seconds", seconds.median }, { "times_default", times.median } });
  }
  return part;
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
