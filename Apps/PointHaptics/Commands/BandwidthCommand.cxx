#include "Commands/Commands.h"

#include "Clouds/BandwidthTask.h"
#include "Clouds/Pipeline.h"
#include "Terminal/Messages.h"

#include "vtkKernelBandwidthFilter.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kBandwidthCommand = "bandwidth";

/// Adds the arrays to @p cloud and writes it to the output in @p files.
CloudResult addBandwidths(const BandwidthCommandOptions& options, Cloud& cloud, Files& files)
{
  std::string message = whyNoLengths(cloud.points);
  require(message.empty(), options.files.input + ": " + message);
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(cloud.points);
  filter->SetSettings(options.bandwidth.settings);
  if (!updateFilter(filter, "bandwidth", message))
  {
    throw Failure(options.files.input + ": " + message);
  }
  const BandwidthFigures figures = bandwidthFigures(filter->GetOutput());
  message = whyNone(options, figures);
  require(message.empty(), message);
  showWarnings(kBandwidthCommand);
  require(writeCloud(filter->GetOutput(), options.files.output, files, kBandwidthCommand, message,
            options.files.writing),
    message);
  return resultOf(options, figures);
}

} // namespace

void addBandwidthCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command =
    program.add_subcommand("bandwidth", "Add kernel bandwidth, proxy radius and density to every point");
  auto options = std::make_shared<BandwidthCommandOptions>();
  options->addTo(*command);
  const auto run = [options](Files& files)
  {
    return runOnClouds(kBandwidthCommand, options->files, files,
      [&](const CloudToCloudOptions& ofOne, Cloud& cloud)
      {
        BandwidthCommandOptions each = *options;
        each.files = ofOne;
        return addBandwidths(each, cloud, files);
      });
  };
  runAs(*command, exitCode, { run });
}

} // namespace pointhaptics::app
