#include "Benchmark/Bandwidth/Clouds.h"
#include "Benchmark/Bandwidth/Rivals/Rival.h"
#include "Benchmark/Bandwidth/Studies.h"

#include "vtkKernelBandwidthFilter.h"

#include "Core/Bandwidth/Bandwidth.h"

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

constexpr int kNeighbors[] = { 4, 8, 16, 32, 64, 128 };
/// Strips across the step of density, each this wide, as far as this to both sides.
constexpr double kStrip = 0.0002;
constexpr double kFar = 0.02;
/// From here on neighbourhoods feel the rim of the cloud.
constexpr double kRim = 0.035;

/// A filter on each of the two clouds, with k nearest neighbours or with a ball.
struct Setting
{
  int k = 16;
  bool ball = false;
  vtkSmartPointer<vtkKernelBandwidthFilter> onSphere;
  vtkSmartPointer<vtkKernelBandwidthFilter> onStep;
};

double valueOf(vtkKernelBandwidthFilter* filter, const char* name, vtkIdType i)
{
  return vtkDoubleArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetArray(name))->GetValue(i);
}

/// Radius of the ball that holds k points on average.
double ballRadius(double density, int k)
{
  return std::sqrt(double(k) / (kPi * density));
}

vtkSmartPointer<vtkKernelBandwidthFilter> filterOn(
  const NamedCloud& cloud, const Setting& setting, double density, bool withDensity)
{
  auto filter = vtkSmartPointer<vtkKernelBandwidthFilter>::New();
  filter->SetInputData(cloud.polyData);
  filter->SetNumberOfNeighbors(setting.k);
  filter->SetNeighborhood(
    setting.ball ? vtkKernelBandwidthFilter::FixedRadius : vtkKernelBandwidthFilter::KNearest);
  filter->SetRadius(ballRadius(density, setting.k));
  filter->SetComputeDensity(withDensity);
  return filter;
}

struct Errors
{
  double bandwidthRms = 0.0; ///< Relative to that of an even disc of k points.
  double bandwidthBias = 0.0;
  double densityRms = 0.0; ///< Relative to the known density.
};

Errors errorsOnSphere(const NamedCloud& cloud, const Setting& setting)
{
  const double density = trueDensity(Shape::Sphere, cloud.size(), {});
  // The spread of an even disc of radius R is R / 2 along each direction of the surface.
  double factor = 0.0;
  (void)pointhaptics::bandwidth(BandwidthRule::NormalReference, 1.0, setting.k + 1.0, 2, factor);
  const double ideal = factor * 0.5 * ballRadius(density, setting.k);
  Errors errors;
  for (vtkIdType i = 0; i < cloud.size(); ++i)
  {
    const double b = valueOf(setting.onSphere, "Bandwidth", i) / ideal - 1.0;
    const double d = valueOf(setting.onSphere, "Density", i) * double(cloud.size()) / density - 1.0;
    errors.bandwidthRms += b * b;
    errors.bandwidthBias += b;
    errors.densityRms += d * d;
  }
  const double n = double(cloud.size());
  errors.bandwidthRms = std::sqrt(errors.bandwidthRms / n);
  errors.bandwidthBias /= n;
  errors.densityRms = std::sqrt(errors.densityRms / n);
  return errors;
}

struct Step
{
  double ratio = 0.0; ///< Radius of the sparse side over that of the dense one.
  double width = 0.0; ///< Metres over which the radius goes from 10 to 90 % of the way.
};

double median(std::vector<double>& values)
{
  return values.empty() ? 0.0 : quartiles(values).median;
}

Step stepOf(const NamedCloud& cloud, const Setting& setting)
{
  std::vector<std::vector<double>> strips(std::size_t(2.0 * kFar / kStrip));
  std::vector<double> sparse;
  std::vector<double> dense;
  for (vtkIdType i = 0; i < cloud.size(); ++i)
  {
    const double x = cloud.view()[i].x;
    const double radius = valueOf(setting.onStep, "ProxyRadius", i);
    if (std::fabs(x) < kFar)
    {
      const auto strip = std::size_t((x + kFar) / kStrip);
      strips[std::min(strip, strips.size() - 1)].push_back(radius);
    }
    else if (std::fabs(x) < kRim)
    {
      (x > 0.0 ? dense : sparse).push_back(radius);
    }
  }
  Step step;
  const double high = median(sparse);
  const double low = median(dense);
  step.ratio = high / low;
  const auto outside = [&](double fraction)
  {
    const double level = low + fraction * (high - low);
    double last = -kFar;
    for (std::size_t i = 0; i < strips.size(); ++i)
    {
      last = !strips[i].empty() && median(strips[i]) > level ? -kFar + (double(i) + 1.0) * kStrip : last;
    }
    return last;
  };
  step.width = outside(0.1) - outside(0.9);
  return step;
}

void addRow(const Setting& setting, const Lap& lap, const NamedCloud& sphere, const NamedCloud& step,
  ReportPart& part, std::vector<Series>& lines)
{
  const Errors errors = errorsOnSphere(sphere, setting);
  const Step at = stepOf(step, setting);
  const double spacing = 1.0 / std::sqrt(trueDensity(Shape::DensityStep, step.size(), { -1.0, 0.0, 0.0 }));
  const double seconds = quartiles(lap.seconds).median;
  part.table.rows.push_back({ setting.ball ? "ball" : "k nearest", std::to_string(setting.k),
    milliseconds(seconds), brief(100.0 * errors.bandwidthRms), brief(100.0 * errors.bandwidthBias),
    brief(100.0 * errors.densityRms), brief(at.ratio), brief(at.width / spacing) });
  part.rows.push_back({ { "neighborhood", setting.ball ? "ball" : "k nearest" }, { "neighbors", setting.k },
    { "median_seconds", seconds }, { "bandwidth_rms_error", errors.bandwidthRms },
    { "bandwidth_bias", errors.bandwidthBias }, { "density_rms_error", errors.densityRms },
    { "step_radius_ratio", at.ratio }, { "step_width_spacings", at.width / spacing } });
  addPoint(lines, setting.ball ? "bandwidth, ball" : "bandwidth, k nearest", 1e3 * seconds,
    100.0 * errors.bandwidthRms);
}

} // namespace

ReportPart studySettling(StudyContext& context)
{
  const NamedCloud sphere = shapeCloud(Shape::Sphere, context.options.points);
  const NamedCloud step = shapeCloud(Shape::DensityStep, context.options.points);
  context.progress(fmt::format("neighbourhoods on {} points", sphere.size()));
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "Size of the neighbourhood: k nearest against a ball";
  part.text = fmt::format(

    "{} points at random on a sphere, whose density is known, {} threads. A ball has the radius that\n"
    "holds k points on average.\n"
    "\n"
    "- bandwidth: against that of an even disc of k points. It is the scatter of the sample itself,\n"
    "  which falls with k.\n"
    "- density: the Gaussian estimate with these bandwidths against the known one.\n"
    "- step: on a plane that is 16 times as dense on one side, the ratio of the radii far from the\n"
    "  step, which should be 4, and the width of the step in spacings of the sparse side.\n"
    "- time: bandwidths and radii alone.",
    grouped(sphere.size()), context.mostThreads());
  part.table.header = { "neighbourhood", "k", "ms", "bandwidth RMS %", "bandwidth bias %", "density RMS %",
    "step ratio", "step width" };
  std::vector<Setting> settings;
  for (const bool ball : { false, true })
  {
    for (const int k : kNeighbors)
    {
      settings.push_back({ k, ball, nullptr, nullptr });
    }
  }
  std::vector<Contestant> contestants;
  for (Setting& setting : settings)
  {
    setting.onSphere = filterOn(sphere, setting, trueDensity(Shape::Sphere, sphere.size(), {}), false);
    Contestant contestant;
    contestant.before = [filter = setting.onSphere] { filter->Modified(); };
    contestant.run = [filter = setting.onSphere] { filter->Update(); };
    contestants.push_back(std::move(contestant));
  }
  const std::vector<Lap> laps = timed(contestants, context.mostThreads(), context, 0.3);
  std::vector<Series> lines;
  for (std::size_t i = 0; i < settings.size(); ++i)
  {
    Setting& setting = settings[i];
    setting.onSphere->ComputeDensityOn();
    setting.onSphere->Update();
    // The mean density of both sides, so that a ball has k points on average there too.
    const double mean = double(step.size()) / (0.08 * 0.08);
    setting.onStep = filterOn(step, setting, mean, false);
    setting.onStep->Update();
    addRow(setting, laps[i], sphere, step, part, lines);
    setting.onStep = nullptr;
    setting.onSphere = nullptr;
  }
  part.charts.push_back({ "bandwidth-settling", "Bandwidths settle as the neighbourhood grows",
    { "time (ms)", true }, { "RMS error (%)", true }, lines });
  return part;
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
