#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Commands/CloudToCloud.h"
#include "Options/LatticeOptions.h"
#include "Terminal/Messages.h"

#include "vtkVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr const char* kCommand = "resample";

struct ResampleOptions
{
  CloudToCloudOptions files;
  LatticeOptions lattice;
};

void print(const ResampleOptions& options, vtkIdType in, vtkVoxelMeanResampler* resampler)
{
  const vtkIdType out = resampler->GetOutput()->GetNumberOfPoints();
  const vtkIdType clipped = resampler->GetNumberOfClippedPoints();
  const vtkIdType invalid = resampler->GetNumberOfInvalidPoints();
  if (options.files.json)
  {
    const nlohmann::ordered_json result = { { "input", options.files.input },
      { "output", options.files.output }, { "points_in", in }, { "points_out", out },
      { "points_clipped", clipped }, { "points_invalid", invalid } };
    printJson(result);
    return;
  }
  fmt::print(
    "{} points in, {} out, {} clipped, {} invalid: {}\n", in, out, clipped, invalid, options.files.output);
}

/// The steps of the file's coordinates are not those of transformed ones.
void removeLasGrid(vtkPolyData* cloud)
{
  for (const char* name : { "LasScale", "LasOffset" })
  {
    cloud->GetFieldData()->RemoveArray(name);
  }
}

int runResample(const ResampleOptions& options)
{
  std::string message;
  Cloud cloud;
  if (!options.files.open(cloud, message))
  {
    return fail(kCommand, message);
  }
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud.points);
  options.lattice.configure(resampler);
  if (!updateFilter(resampler, "resampling", message))
  {
    return fail(kCommand, options.files.input + ": " + message);
  }
  showWarnings(kCommand);
  if (resampler->GetOutput()->GetNumberOfPoints() == 0)
  {
    return fail(kCommand,
      fmt::format(
        "{}: no point lies in the workspace: {} clipped, {} invalid; leave out --workspace, or mend the "
        "transform",
        options.files.input, resampler->GetNumberOfClippedPoints(), resampler->GetNumberOfInvalidPoints()));
  }
  if (options.lattice.hasTransform())
  {
    removeLasGrid(resampler->GetOutput());
  }
  if (!writeCloud(resampler->GetOutput(), options.files.output, kCommand, message))
  {
    return fail(kCommand, message);
  }
  print(options, cloud.points->GetNumberOfPoints(), resampler);
  return kSuccess;
}

} // namespace

void addResampleCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command =
    program.add_subcommand("resample", "Replace the points in each voxel of a lattice by their mean");
  auto options = std::make_shared<ResampleOptions>();
  options->files.addTo(*command);
  command->add_flag("--covariance", options->lattice.voxels.computeCovariance,
    "Add the second moments of each voxel: VoxelCovariance");
  options->lattice.addTo(*command);
  command->callback([options, &exitCode] { exitCode = runResample(*options); });
}

} // namespace app
} // namespace pointhaptics
