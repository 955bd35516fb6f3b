#include "Options/BandwidthOptions.h"

#include "Options/OptionParsing.h"

#include "vtkKernelBandwidthFilter.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <limits>

namespace pointhaptics
{
namespace app
{

void BandwidthOptions::addTo(CLI::App& command)
{
  const char* const group = "Bandwidth and proxy radius";
  const NumberRange length{ 0.0, kUnbounded, true };
  CLI::Option* nearest = addInteger(command, "--neighbors", this->neighbors, 1,
    std::numeric_limits<int>::max(), "Nearest neighbours the spread is taken from; default 16");
  CLI::Option* ball = addNumber(command, "--radius", this->radius, length, "METRES",
    "All points in a ball of this radius, instead of --neighbors");
  CLI::Option* ruleOption = addChoice(command, "--rule", this->rule,
    { { "normal-reference", vtkKernelBandwidthFilter::NormalReference },
      { "silverman-robust", vtkKernelBandwidthFilter::SilvermanRobust },
      { "scott", vtkKernelBandwidthFilter::ScottMultivariate },
      { "silverman", vtkKernelBandwidthFilter::SilvermanMultivariate },
      { "sheather-jones", vtkKernelBandwidthFilter::SheatherJones } },
    "From spread to bandwidth; default normal-reference");
  CLI::Option* scale = addNumber(
    command, "--beta", this->beta, { 0.0, 1e6, true }, "B", "Proxy radius over bandwidth; default 4");
  CLI::Option* lower = addNumber(command, "--r1", this->minimumRadius, length, "METRES",
    "Smallest proxy radius; default 2.2 local spacings");
  CLI::Option* upper =
    addNumber(command, "--r2", this->maximumRadius, length, "METRES", "Largest proxy radius; default none");
  CLI::Option* smoothing = command.add_flag("--smooth", this->smooth,
    "Cut radii so that no two differ by more than half the distance of their points");
  // Options are processed in the order they were added: r1 is known here.
  upper->each(
    [this](const std::string& text)
    {
      double value = 0.0;
      if (parseNumber(text, value) && value < this->minimumRadius)
      {
        throw CLI::ValidationError(
          fmt::format("{} is below --r1 {}; give r1 <= r2", value, this->minimumRadius));
      }
    });
  ball->excludes(nearest);
  for (CLI::Option* option : { nearest, ball, ruleOption, scale, lower, upper, smoothing })
  {
    option->group(group);
  }
}

void BandwidthOptions::configure(vtkKernelBandwidthFilter* filter) const
{
  if (this->neighbors > 0)
  {
    filter->SetNeighborhoodToKNearest();
    filter->SetNumberOfNeighbors(static_cast<int>(this->neighbors));
  }
  if (this->radius > 0.0)
  {
    filter->SetNeighborhoodToFixedRadius();
    filter->SetRadius(this->radius);
  }
  if (this->rule >= 0)
  {
    filter->SetRule(this->rule);
  }
  if (this->beta > 0.0)
  {
    filter->SetRadiusScale(this->beta);
  }
  if (this->minimumRadius > 0.0)
  {
    filter->SetMinimumRadius(this->minimumRadius);
  }
  if (this->maximumRadius > 0.0)
  {
    filter->SetMaximumRadius(this->maximumRadius);
  }
  if (this->smooth)
  {
    filter->SmoothRadiusOn();
  }
}

} // namespace app
} // namespace pointhaptics
