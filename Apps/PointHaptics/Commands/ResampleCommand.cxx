#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Commands/CloudToCloud.h"
#include "Options/LatticeOptions.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include "CsvWriter.h"
#include "vtkVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cstdint>
#include <memory>
#include <string>

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
  std::int64_t minimumPoints = 1;
  std::string voxelIndex; ///< File to write; empty: none.

  void addTo(CLI::App& command);
};

void ResampleOptions::addTo(CLI::App& command)
{
  VoxelMeanSettings& voxels = this->lattice.voxels;
  this->files.addTo(command);
  command.add_flag(
    "--covariance", voxels.computeCovariance, "Add the second moments of each voxel: VoxelCovariance");
  addChoice(
    command, "--representative",
    [&voxels](int value) { voxels.representative = static_cast<Representative>(value); },
    { { "mean", int(Representative::Mean) }, { "nearest-to-mean", int(Representative::NearestToMean) },
      { "nearest-to-center", int(Representative::NearestToCenter) },
      { "median", int(Representative::Median) } },
    "What stands for the points of a voxel: one of them, or the median of each value; default mean");
  addInteger(command, "--minimum-points", this->minimumPoints, 1, VTK_INT_MAX,
    "Leave out voxels with fewer points; default 1");
  command
    .add_option("--voxel-index", this->voxelIndex,
      "File to write with the row in OUT of each point of IN, from 0, or -1: .csv")
    ->type_name("FILE");
  this->lattice.addTo(command);
}

/// Why no voxel is left.
std::string whyEmpty(const ResampleOptions& options, vtkIdType in, vtkVoxelMeanResampler* resampler)
{
  const vtkIdType clipped = resampler->GetNumberOfClippedPoints();
  const vtkIdType invalid = resampler->GetNumberOfInvalidPoints();
  if (clipped + invalid < in)
  {
    return fmt::format("{}: no voxel has {} points; give fewer to --minimum-points, or larger voxels",
      options.files.input, options.minimumPoints);
  }
  return fmt::format(
    "{}: no point lies in the workspace: {} clipped, {} invalid; leave out --workspace, or mend the "
    "transform",
    options.files.input, clipped, invalid);
}

bool writeVoxelIndex(CsvWriter& file, vtkVoxelMeanResampler* resampler, std::string& message)
{
  vtkDataArray* index = resampler->GetOutput(1)->GetPointData()->GetArray("VoxelIndex");
  for (vtkIdType i = 0; index && i < index->GetNumberOfTuples(); ++i)
  {
    const double row = index->GetComponent(i, 0);
    file.row(&row, 1);
  }
  return file.commit(message);
}

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
  CsvWriter index;
  if (options.voxelIndex == options.files.output)
  {
    return fail(kCommand, options.voxelIndex + ": --voxel-index and -o name one file; give it another name");
  }
  if ((!options.voxelIndex.empty() && !index.open(options.voxelIndex, "voxel", message)) ||
    !options.files.open(kCommand, cloud, message))
  {
    return fail(kCommand, message);
  }
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud.points);
  options.lattice.configure(resampler);
  resampler->SetMinimumPointsPerVoxel(int(options.minimumPoints));
  resampler->SetComputeVoxelIndex(!options.voxelIndex.empty());
  if (!updateFilter(resampler, "resampling", message))
  {
    return fail(kCommand, options.files.input + ": " + message);
  }
  showWarnings(kCommand);
  if (resampler->GetOutput()->GetNumberOfPoints() == 0)
  {
    return fail(kCommand, whyEmpty(options, cloud.points->GetNumberOfPoints(), resampler));
  }
  if (options.lattice.hasTransform())
  {
    removeLasGrid(resampler->GetOutput());
  }
  if (!writeCloud(resampler->GetOutput(), options.files.output, kCommand, message) ||
    (!options.voxelIndex.empty() && !writeVoxelIndex(index, resampler, message)))
  {
    return fail(kCommand, message);
  }
  print(options, cloud.points->GetNumberOfPoints(), resampler);
  return kSuccess;
}

} // namespace

void addResampleCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command = program.add_subcommand(
    "resample", "Replace the points in each voxel of a lattice by their mean, or by one of them");
  auto options = std::make_shared<ResampleOptions>();
  options->addTo(*command);
  command->callback([options, &exitCode] { exitCode = runResample(*options); });
}

} // namespace app
} // namespace pointhaptics
