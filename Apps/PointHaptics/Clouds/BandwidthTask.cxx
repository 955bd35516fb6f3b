#include "Clouds/BandwidthTask.h"

#include "Clouds/Pipeline.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>

namespace pointhaptics::app
{

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

BandwidthFigures bandwidthFigures(vtkPolyData* cloud)
{
  BandwidthFigures figures;
  figures.points = cloud->GetNumberOfPoints();
  vtkDataArray* radius = cloud->GetPointData()->GetArray("ProxyRadius");
  for (vtkIdType i = 0; radius && i < radius->GetNumberOfTuples(); ++i)
  {
    double p[3];
    cloud->GetPoint(i, p);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    {
      ++figures.invalid;
      continue;
    }
    const double value = radius->GetComponent(i, 0);
    figures.smallestRadius = std::min(figures.smallestRadius, value);
    figures.largestRadius = std::max(figures.largestRadius, value);
  }
  return figures;
}

BandwidthFigures together(const BandwidthFigures& a, const BandwidthFigures& b)
{
  return { std::min(a.smallestRadius, b.smallestRadius), std::max(a.largestRadius, b.largestRadius),
    a.points + b.points, a.invalid + b.invalid };
}

std::string whyNone(const BandwidthCommandOptions& options, const BandwidthFigures& figures)
{
  return figures.invalid < figures.points ? std::string()
                                          : noFinitePoint(options.files.input, figures.points);
}

CloudResult resultOf(const BandwidthCommandOptions& options, const BandwidthFigures& figures)
{
  return { fmt::format("{}, {} invalid, proxy radius {:.6g} to {:.6g}: {}", countOfPoints(figures.points),
             figures.invalid, figures.smallestRadius, figures.largestRadius, options.files.output),
    { { "input", options.files.input }, { "output", options.files.output }, { "points", figures.points },
      { "points_invalid", figures.invalid },
      { "proxy_radius", { { "min", figures.smallestRadius }, { "max", figures.largestRadius } } } } };
}

} // namespace pointhaptics::app
