#include "Clouds/ResampleTask.h"

#include "Clouds/Pipeline.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/QuantityText.h"
#include "Core/Distributed/SharedVoxels.h"
#include "CsvWriter.h"
#include "IO/Info/LengthUnit.h"
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

namespace
{

/// As the resampler says it of its lattice; empty where it does not.
Bounds latticeBounds(vtkPolyData* means)
{
  vtkFieldData* fields = means->GetFieldData();
  vtkDataArray* origin = fields->GetArray("LatticeOrigin");
  vtkDataArray* spacing = fields->GetArray("LatticeSpacing");
  vtkDataArray* dimensions = fields->GetArray("LatticeDimensions");
  Bounds box;
  if (origin && spacing && dimensions)
  {
    Lattice lattice;
    for (int axis = 0; axis < 3; ++axis)
    {
      lattice.origin[axis] = origin->GetComponent(0, axis);
      lattice.spacing[axis] = spacing->GetComponent(0, axis);
      lattice.dimensions[std::size_t(axis)] = std::int64_t(dimensions->GetComponent(0, axis));
    }
    box = lattice.bounds();
  }
  return box;
}

} // namespace

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
  for (const char* name : { "LasScale", "LasOffset", "CoordinateSystem", "LengthUnit" })
  {
    if (this->lattice.hasTransform() && (this->lattice.isScaled() || name != std::string("LengthUnit")))
    {
      means->GetFieldData()->RemoveArray(name);
    }
  }
}

std::string noReturnsNote(
  const ResampleOptions& options, vtkPolyData* cloud, vtkPolyData* means, Ranks& ranks)
{
  const CloudExtent own = extentOf(cloud);
  const std::int64_t atZero = commonSum(ranks, own.atZero);
  const bool areIn = contains(latticeBounds(means), options.lattice.transform().apply(Vec3()));
  return areIn && areNoReturns(atZero, commonSum(ranks, own.finite))
    ? fmt::format("{}: {} are resampled as others are", options.files.input, noReturnsText(atZero))
    : std::string();
}

bool updateResampler(
  const ResampleOptions& options, vtkPolyData* cloud, vtkVoxelMeanResampler* resampler, std::string& message)
{
  message = whyNoLengths(cloud, options.lattice.transform());
  if (!message.empty())
  {
    message =
      options.files.input + ": " + message + ", or give metres a degree, such as --scale 78000,111000,1";
    return false;
  }
  if (updateFilter(resampler, "resampling", message))
  {
    return true;
  }
  message = options.files.input + ": " + message;
  return false;
}

std::string voxelUnitNote(const ResampleOptions& options, vtkPolyData* cloud)
{
  const LengthUnit unit = lengthUnitOf(cloud, Bounds());
  const double voxel = options.lattice.voxels.lattice.voxelSize;
  return voxel > 0.0 && unit.name != "m" && !options.lattice.isScaled()
    ? fmt::format("{}: --voxel {:.6g} is {:.6g} {}, the unit of the file; --unit {} makes metres of both",
        options.files.input, voxel, voxel, unit.name, unit.name)
    : std::string();
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
