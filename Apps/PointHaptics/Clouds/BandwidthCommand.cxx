#include "Clouds/CloudCommands.h"

#include "Commands/Commands.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include "IO/Info/LengthUnit.h"
#include "vtkKernelBandwidthFilter.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>

namespace pointhaptics::app
{

void BandwidthCommand::addTo(CLI::App& command)
{
  CloudCommand::addTo(command);
  this->bandwidth.addTo(command);
  addUnit(command, this->unit);
  BandwidthSettings& settings = this->bandwidth.settings;
  settings.computeDensity = true;
  const auto keep = [&settings](std::size_t kernel)
  {
    constexpr DensityKernel kKernels[] = { DensityKernel::Gaussian, DensityKernel::Epanechnikov };
    settings.computeDensity = kernel < std::size(kKernels);
    settings.densityKernel = settings.computeDensity ? kKernels[kernel] : settings.densityKernel;
  };
  addChoice(command, "--density", keep, { "gaussian", "epanechnikov", "none" },
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

CloudResult BandwidthCommand::result(const BandwidthFigures& figures) const
{
  require(figures.invalid < figures.points, noFinitePoint(this->input, figures.points));
  return this->resultOf(
    fmt::format("{}, {} invalid, proxy radius {:.6g} to {:.6g}", countOfPoints(figures.points),
      figures.invalid, figures.smallestRadius, figures.largestRadius),
    { { "points", figures.points }, { "points_invalid", figures.invalid },
      { "proxy_radius", { { "min", figures.smallestRadius }, { "max", figures.largestRadius } } } });
}

vtkSmartPointer<vtkPolyData> BandwidthCommand::prepared(vtkPolyData* cloud) const
{
  const std::string why = whyNoLengths(cloud);
  require(why.empty(), this->input + ": " + why);
  const vtkSmartPointer<vtkPolyData> given = cloud;
  return this->unit == "m" ? given
                           : scaledCloud(cloud, findLengthUnit(this->unit)->metres, kLengthUnits[0].word);
}

CloudResult BandwidthCommand::work(Cloud& cloud, Files& files)
{
  warn(this->unitNote(cloud.points));
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(this->prepared(cloud.points));
  filter->SetSettings(this->bandwidth.settings);
  updateFilter(filter, "bandwidth", this->input);
  this->unitIsGiven ? sayMetres(filter->GetOutput()) : void();
  const CloudResult figures = this->result(bandwidthFigures(filter->GetOutput()));
  showWarnings();
  writeCloud(filter->GetOutput(), this->output, files, this->writing);
  return figures;
}

Command* bandwidthCommand()
{
  return new BandwidthCommand;
}

} // namespace pointhaptics::app
