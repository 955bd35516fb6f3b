#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Commands/CloudToCloud.h"
#include "Options/BandwidthOptions.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include "vtkKernelBandwidthFilter.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr const char* kCommand = "bandwidth";

struct BandwidthCommandOptions
{
  CloudToCloudOptions files;
  BandwidthOptions bandwidth;

  void addTo(CLI::App& command);
};

void BandwidthCommandOptions::addTo(CLI::App& command)
{
  this->files.addTo(command);
  this->bandwidth.addTo(command);
  constexpr int kNone = -1;
  this->bandwidth.settings.computeDensity = true;
  const auto keep = [&settings = this->bandwidth.settings](int kernel)
  {
    settings.computeDensity = kernel != kNone;
    settings.densityKernel = kernel == kNone ? settings.densityKernel : DensityKernel(kernel);
  };
  addChoice(command, "--density", keep,
    { { "gaussian", int(DensityKernel::Gaussian) }, { "epanechnikov", int(DensityKernel::Epanechnikov) },
      { "none", kNone } },
    "Kernel of the density, which costs most of the time; default gaussian");
}

/// Points that are not finite have radius 0: they take no part.
struct RadiusRange
{
  double minimum = 0.0;
  double maximum = 0.0;
  vtkIdType invalid = 0;
};

RadiusRange radiusRange(vtkPolyData* cloud)
{
  RadiusRange range;
  vtkDataArray* radius = cloud->GetPointData()->GetArray("ProxyRadius");
  for (vtkIdType i = 0; radius && i < radius->GetNumberOfTuples(); ++i)
  {
    double p[3];
    cloud->GetPoint(i, p);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    {
      ++range.invalid;
      continue;
    }
    const double value = radius->GetComponent(i, 0);
    range.minimum = i == range.invalid ? value : std::min(range.minimum, value);
    range.maximum = std::max(range.maximum, value);
  }
  return range;
}

void print(const BandwidthCommandOptions& options, vtkIdType points, const RadiusRange& range)
{
  if (options.files.json)
  {
    const nlohmann::ordered_json object = { { "input", options.files.input },
      { "output", options.files.output }, { "points", points }, { "points_invalid", range.invalid },
      { "proxy_radius", { { "min", range.minimum }, { "max", range.maximum } } } };
    printJson(object);
    return;
  }
  fmt::print("{} points, {} invalid, proxy radius {:.6g} to {:.6g}: {}\n", points, range.invalid,
    range.minimum, range.maximum, options.files.output);
}

int runBandwidth(const BandwidthCommandOptions& options)
{
  std::string message;
  Cloud cloud;
  if (!options.files.open(kCommand, cloud, message))
  {
    return fail(kCommand, message);
  }
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(cloud.points);
  filter->SetSettings(options.bandwidth.settings);
  if (!updateFilter(filter, "bandwidth", message))
  {
    return fail(kCommand, options.files.input + ": " + message);
  }
  showWarnings(kCommand);
  const vtkIdType points = filter->GetOutput()->GetNumberOfPoints();
  const RadiusRange range = radiusRange(filter->GetOutput());
  if (range.invalid == points)
  {
    return fail(kCommand,
      fmt::format("{}: each of the {} points has a coordinate that is NaN or infinite; mend the file",
        options.files.input, points));
  }
  if (!writeCloud(filter->GetOutput(), options.files.output, kCommand, message))
  {
    return fail(kCommand, message);
  }
  print(options, points, range);
  return kSuccess;
}

} // namespace

void addBandwidthCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command =
    program.add_subcommand("bandwidth", "Add kernel bandwidth, proxy radius and density to every point");
  auto options = std::make_shared<BandwidthCommandOptions>();
  options->addTo(*command);
  command->callback([options, &exitCode] { exitCode = runBandwidth(*options); });
}

} // namespace app
} // namespace pointhaptics
