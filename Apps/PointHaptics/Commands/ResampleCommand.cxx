#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Clouds/ResampleTask.h"
#include "Terminal/Messages.h"

#include "Core/Distributed/Ranks.h"
#include "CsvWriter.h"
#include "vtkVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>
#include <string>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kResampleCommand = "resample";

/// Resamples @p cloud and writes it to the outputs in @p files.
CloudResult resample(const ResampleOptions& options, Cloud& cloud, Files& files)
{
  std::string message;
  CsvWriter index;
  const bool wantsIndex = !options.voxelIndex.empty();
  require(!wantsIndex || index.open(files.output(options.voxelIndex), kVoxelIndexHeader, message), message);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud.points);
  options.configure(resampler);
  resampler->SetComputeVoxelIndex(wantsIndex);
  require(updateResampler(options, cloud.points, resampler, message), message);
  Ranks alone;
  for (const std::string& note : { noReturnsNote(options, cloud.points, resampler->GetOutput(), alone),
         voxelUnitNote(options, cloud.points) })
  {
    if (!note.empty())
    {
      warn(kResampleCommand, note);
    }
  }
  const ResampleFigures figures{ cloud.points->GetNumberOfPoints(),
    resampler->GetOutput()->GetNumberOfPoints(), resampler->GetNumberOfClippedPoints(),
    resampler->GetNumberOfInvalidPoints() };
  if (figures.out == 0)
  {
    throw Failure(whyEmpty(options, figures));
  }
  showWarnings(kResampleCommand);
  options.finish(resampler->GetOutput());
  require(writeCloud(resampler->GetOutput(), options.files.output, files, kResampleCommand, message,
            options.files.writing),
    message);
  if (wantsIndex)
  {
    addVoxelIndex(voxelIndexOf(resampler), index);
    require(index.commit(message), message);
  }
  return resultOf(options, figures);
}

} // namespace

void addResampleCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command = program.add_subcommand(
    "resample", "Replace the points in each voxel of a lattice by their mean, or by one of them");
  auto options = std::make_shared<ResampleOptions>();
  options->addTo(*command);
  const auto run = [options](Files& files)
  {
    return runOnClouds(kResampleCommand, options->files, files,
      [&](const CloudToCloudOptions& ofOne, Cloud& cloud)
      {
        ResampleOptions each = *options;
        each.files = ofOne;
        each.voxelIndex = expandedName(options->voxelIndex, ofOne.input);
        return resample(each, cloud, files);
      });
  };
  runAs(*command, exitCode, { run, [options] { options->check(); } });
}

} // namespace pointhaptics::app
