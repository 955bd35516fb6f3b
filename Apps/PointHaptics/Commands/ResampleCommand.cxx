#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Clouds/ResampleTask.h"
#include "Terminal/Messages.h"

#include "Core/Distributed/Ranks.h"
#include "CsvWriter.h"
#include "vtkVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>
#include <string>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr const char* kResampleCommand = "resample";

int runResample(const ResampleOptions& options)
{
  std::string message;
  Cloud cloud;
  CsvWriter index;
  const bool wantsIndex = !options.voxelIndex.empty();
  if ((wantsIndex && !openVoxelIndex(options, index, message)) ||
    !options.files.open(kResampleCommand, cloud, message))
  {
    return fail(kResampleCommand, message);
  }
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud.points);
  options.configure(resampler);
  resampler->SetComputeVoxelIndex(wantsIndex);
  const bool isDone = updateFilter(resampler, "resampling", message);
  Ranks alone;
  for (const std::string& note : oddPointsNotes(options, isDone, cloud.points, alone))
  {
    warn(kResampleCommand, note);
  }
  if (!isDone)
  {
    return fail(kResampleCommand, options.files.input + ": " + message);
  }
  showWarnings(kResampleCommand);
  const ResampleFigures figures{ cloud.points->GetNumberOfPoints(),
    resampler->GetOutput()->GetNumberOfPoints(), resampler->GetNumberOfClippedPoints(),
    resampler->GetNumberOfInvalidPoints() };
  if (figures.out == 0)
  {
    return fail(kResampleCommand, whyEmpty(options, figures));
  }
  options.finish(resampler->GetOutput());
  if (!writeCloud(resampler->GetOutput(), options.files.output, kResampleCommand, message))
  {
    return fail(kResampleCommand, message);
  }
  if (wantsIndex)
  {
    addVoxelIndex(voxelIndexOf(resampler), index);
    if (!index.commit(message))
    {
      return fail(kResampleCommand, message);
    }
  }
  print(options, figures);
  return kSuccess;
}

} // namespace

void addResampleCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command = program.add_subcommand(
    "resample", "Replace the points in each voxel of a lattice by their mean, or by one of them");
  auto options = std::make_shared<ResampleOptions>();
  options->addTo(*command);
  command->callback(
    [options, &exitCode]
    {
      options->check();
      exitCode = runResample(*options);
    });
}

} // namespace app
} // namespace pointhaptics
