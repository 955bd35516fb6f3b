#include "Clouds/ResampleTask.h"

#include "Clouds/Pipeline.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/QuantityText.h"
#include "Core/Distributed/SharedVoxels.h"
#include "CsvWriter.h"
#include "IO/Info/FarPoints.h"
#include "LoadedCloud.h"
#include "vtkVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace pointhaptics::app
{

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
  command.add_flag("--original-ids", voxels.keepOriginalPointIds,
    "Add vtkOriginalPointIds: the row in IN, from 0, of the nearest point that stands for each voxel");
  addOutput(command, "--voxel-index", this->voxelIndex, { "csv" },
    "File to write with the row in OUT of each point of IN, from 0, or -1: .csv")
    ->type_name("FILE");
  this->lattice.addTo(command);
}

void ResampleOptions::check() const
{
  const VoxelMeanSettings& voxels = this->lattice.voxels;
  if (voxels.keepOriginalPointIds && !keepsPoints(voxels.representative))
  {
    throwUsage("--original-ids", "",
      "a mean or median is no point of IN; give --representative nearest-to-mean or nearest-to-center too");
  }
}

void ResampleOptions::configure(vtkVoxelMeanResampler* resampler) const
{
  this->lattice.configure(resampler);
  resampler->SetMinimumPointsPerVoxel(int(this->minimumPoints));
}

/// Removes steps and coordinate system of the file from transformed points, and its unit from scaled ones.
void ResampleOptions::finish(vtkPolyData* means) const
{
  const bool isScaled =
    this->lattice.unit != "m" || !this->lattice.scale.empty() || !this->lattice.matrix.empty();
  for (const char* name : { "LasScale", "LasOffset", "CoordinateSystem", "LengthUnit" })
  {
    if (this->lattice.hasTransform() && (isScaled || name != std::string("LengthUnit")))
    {
      means->GetFieldData()->RemoveArray(name);
    }
  }
}

std::vector<std::string> oddPointsNotes(
  const ResampleOptions& options, bool isDone, vtkPolyData* cloud, Ranks& ranks)
{
  std::vector<std::string> notes;
  const AffineTransform transform = options.lattice.transform();
  const Bounds workspace = options.lattice.workspace();
  const CloudExtent own = extentOf(cloud);
  const bool isHarmless = isDone && options.lattice.voxels.lattice.voxelSize > 0.0;
  FarPoints far;
  if (!isHarmless && workspace.empty())
  {
    far = findFarPoints(cloud, own.all, ranks);
  }
  const bool saysZeros = far.count > 0 && !contains(far.others, Vec3());
  if (far.count > 0)
  {
    far.others = boxOfCorners(far.others, [&](const Vec3& p) { return transform.apply(p); });
    notes.push_back(
      fmt::format("{}: {}, and the lattice reaches there; --workspace {} leaves what is far out",
        options.files.input, far.text(), far.clip()));
  }
  const std::int64_t atZero = commonSum(ranks, own.atZero);
  const bool areIn = workspace.empty() || contains(workspace, transform.apply(Vec3()));
  if (areNoReturns(atZero, commonSum(ranks, own.finite)) && areIn && !saysZeros)
  {
    notes.push_back(
      fmt::format("{}: {} are resampled as others are", options.files.input, noReturnsText(atZero)));
  }
  return notes;
}

bool openVoxelIndex(const std::string& fileName, CsvWriter& file, std::string& message)
{
  return file.open(fileName, "voxel", message);
}

std::vector<std::int64_t> voxelIndexOf(vtkVoxelMeanResampler* resampler)
{
  auto* index = vtkIdTypeArray::SafeDownCast(resampler->GetOutput(1)->GetPointData()->GetArray("VoxelIndex"));
  return index
    ? std::vector<std::int64_t>(index->GetPointer(0), index->GetPointer(0) + index->GetNumberOfTuples())
    : std::vector<std::int64_t>();
}

void addVoxelIndex(const std::vector<std::int64_t>& rows, CsvWriter& file)
{
  for (const std::int64_t row : rows)
  {
    const auto value = double(row);
    file.row(&value, 1);
  }
}

std::string whyEmpty(const ResampleOptions& options, const ResampleFigures& figures)
{
  if (figures.invalid == figures.in)
  {
    return noFinitePoint(options.files.input, figures.in);
  }
  if (figures.clipped + figures.invalid < figures.in)
  {
    return fmt::format("{}: no voxel has {} points; give fewer to --minimum-points, or larger voxels",
      options.files.input, options.minimumPoints);
  }
  return fmt::format(
    "{}: no point lies in the workspace: {} clipped, {} invalid; leave out --workspace, or mend the "
    "transform",
    options.files.input, figures.clipped, figures.invalid);
}

CloudResult resultOf(const ResampleOptions& options, const ResampleFigures& figures)
{
  return { fmt::format("{} in, {} out, {} clipped, {} invalid: {}", countOfPoints(figures.in), figures.out,
             figures.clipped, figures.invalid, options.files.output),
    { { "input", options.files.input }, { "output", options.files.output }, { "points_in", figures.in },
      { "points_out", figures.out }, { "points_clipped", figures.clipped },
      { "points_invalid", figures.invalid } } };
}

} // namespace pointhaptics::app
