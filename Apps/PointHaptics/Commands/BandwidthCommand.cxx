#include "Commands/Commands.h"

#include "Clouds/BandwidthTask.h"
#include "Clouds/Pipeline.h"
#include "Terminal/Messages.h"

#include "vtkKernelBandwidthFilter.h"

#include <CLI/CLI.hpp>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr const char* kBandwidthCommand = "bandwidth";

int runBandwidth(const BandwidthCommandOptions& options)
{
  std::string message;
  Cloud cloud;
  if (!options.files.open(kBandwidthCommand, cloud, message))
  {
    return fail(kBandwidthCommand, message);
  }
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(cloud.points);
  filter->SetSettings(options.bandwidth.settings);
  if (!updateFilter(filter, "bandwidth", message))
  {
    return fail(kBandwidthCommand, options.files.input + ": " + message);
  }
  showWarnings(kBandwidthCommand);
  const BandwidthFigures figures = bandwidthFigures(filter->GetOutput());
  message = whyNone(options, figures);
  if (!message.empty() || !writeCloud(filter->GetOutput(), options.files.output, kBandwidthCommand, message))
  {
    return fail(kBandwidthCommand, message);
  }
  print(options, figures);
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
