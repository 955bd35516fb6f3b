#include "Benchmark/Bandwidth/Clouds.h"
#include "Benchmark/Bandwidth/Studies.h"

#include "SmpExecutor.h"

#include "Core/Bandwidth/Density.h"
#include "Core/Bandwidth/LocalBandwidth.h"
#include "Core/Reference/ReferenceBandwidth.h"

#include <fmt/format.h>

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

/// In bandwidths.
constexpr double kCutoffs[] = { 2.0, 3.0, 4.0, 5.0, kDensityCutoff, 8.0 };
/// Ours leaves out kernels below 1.6e-8 of their height; the sum of those left out may be somewhat more.
constexpr double kCutMayDiffer = 1e-6;

/// As surfaceDensities, with another cutoff.
void densitiesCutOff(const NeighborQuery& query, const std::vector<double>& bandwidths, double cutoff,
  std::vector<double>& densities)
{
  densities.assign(bandwidths.size(), 0.0);
  forRange(SmpExecutor(), query.size(),
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t slot = begin; slot < end; ++slot)
      {
        const auto i = std::size_t(query.index(slot));
        const double b = bandwidths[i];
        double sum = 0.0;
        query.visitBallSlots(query.point(slot), cutoff * b,
          [&](double d2, std::int64_t) { sum += std::exp(-0.5 * d2 / (b * b)); });
        densities[i] = sum / (double(query.size()) * 2.0 * 3.14159265358979323846 * b * b);
      }
    });
}

struct Expected
{
  std::size_t index = 0;
  long double density = 0;
};

std::vector<Expected> directSums(const PointView& points, const std::vector<double>& bandwidths, int count)
{
  std::vector<Expected> expected;
  const std::int64_t step = std::max<std::int64_t>(1, points.size() / count);
  for (std::int64_t i = 0; i < points.size(); i += step)
  {
    const auto at = std::size_t(i);
    expected.push_back({ at, reference::surfaceDensity(points, points[i], bandwidths[at]) });
  }
  return expected;
}

struct DensityErrors
{
  double worst = 0.0;
  double rms = 0.0;
};

DensityErrors errorsOf(const std::vector<double>& densities, const std::vector<Expected>& expected)
{
  DensityErrors errors;
  for (const Expected& point : expected)
  {
    const double error = double(std::fabs(densities[point.index] / point.density - 1));
    errors.worst = std::max(errors.worst, error);
    errors.rms += error * error / double(expected.size());
  }
  errors.rms = std::sqrt(errors.rms);
  return errors;
}

/// The density at all points with each cutoff, and last the filter's other kernel; each to fill its own
/// result.
std::vector<Contestant> contestants(const NamedCloud& cloud, const NeighborQuery& query,
  const std::vector<double>& bandwidths, std::vector<std::vector<double>>& densities)
{
  std::vector<Contestant> all;
  for (std::size_t i = 0; i < densities.size(); ++i)
  {
    std::vector<double>& result = densities[i];
    Contestant contestant;
    contestant.run = [&, i]
    {
      if (i < std::size(kCutoffs) && kCutoffs[i] != kDensityCutoff)
      {
        densitiesCutOff(query, bandwidths, kCutoffs[i], result);
        return;
      }
      const DensityKernel kernel =
        i < std::size(kCutoffs) ? DensityKernel::Gaussian : DensityKernel::Epanechnikov;
      surfaceDensities(cloud.view(), query, bandwidths, result, SmpExecutor(), kernel);
    };
    all.push_back(std::move(contestant));
  }
  return all;
}

} // namespace

ReportPart studyTruncation(StudyContext& context)
{
  const NamedCloud cloud = shapeCloud(Shape::Sphere, context.options.points / 2);
  context.progress(fmt::format("densities at {} points", cloud.size()));
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "Where the density's Gaussian kernel is cut off";
  part.text = fmt::format("{} points on a sphere, bandwidths of {} neighbours, {} threads; time of the "
                          "density at all points. Errors at "
                          "{} of them against the sum over all points in long double. The filter cuts off at "
                          "{}; its Epanechnikov kernel "
                          "ends by itself, and is another estimate: nothing is left out of it.",
    grouped(cloud.size()), context.options.neighbors, context.mostThreads(), context.options.checkedPoints,
    kDensityCutoff);
  part.table.header = { "cut off at (bandwidths)", "ms", "ns/point", "largest relative error",
    "RMS relative error" };
  NeighborQuery query;
  query.build(cloud.view());
  LocalBandwidthSettings settings;
  settings.numberOfNeighbors = context.options.neighbors;
  std::vector<double> bandwidths;
  std::vector<double> radii;
  (void)localBandwidths(cloud.view(), query, settings, bandwidths, radii);
  const std::vector<Expected> expected = directSums(cloud.view(), bandwidths, context.options.checkedPoints);
  std::vector<std::vector<double>> densities(std::size(kCutoffs) + 1);
  const std::vector<Lap> laps =
    timed(contestants(cloud, query, bandwidths, densities), context.mostThreads(), context, 0.5);
  std::vector<Series> lines;
  for (std::size_t i = 0; i < densities.size(); ++i)
  {
    const double seconds = quartiles(laps[i].seconds).median;
    const bool gaussian = i < std::size(kCutoffs);
    const DensityErrors errors = gaussian ? errorsOf(densities[i], expected) : DensityErrors();
    const bool ours = gaussian && kCutoffs[i] == kDensityCutoff;
    const std::string name =
      gaussian ? fmt::format("{}{}", kCutoffs[i], ours ? ", the filter's" : "") : "Epanechnikov kernel";
    context.allRight = context.allRight && (!ours || errors.worst <= kCutMayDiffer);
    part.table.rows.push_back({ name, milliseconds(seconds), brief(1e9 * seconds / double(cloud.size())),
      gaussian ? fmt::format("{:.2g}", errors.worst) : "",
      gaussian ? fmt::format("{:.2g}", errors.rms) : "" });
    part.rows.push_back(
      { { "cutoff", name }, { "median_seconds", seconds }, { "worst_relative_error", errors.worst },
        { "rms_relative_error", errors.rms }, { "right", !ours || errors.worst <= kCutMayDiffer } });
    if (gaussian)
    {
      addPoint(lines, "largest", 1e3 * seconds, errors.worst);
      addPoint(lines, "RMS", 1e3 * seconds, errors.rms);
    }
  }
  part.charts.push_back({ "bandwidth-truncation", "The density's kernel cut off at 2 to 8 bandwidths",
    { "time (ms)", true }, { "relative error", true }, lines });
  return part;
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
