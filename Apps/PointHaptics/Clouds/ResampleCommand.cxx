#include "Clouds/CloudCommands.h"

#include "Commands/Commands.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/QuantityText.h"
#include "Core/Distributed/Ranks.h"
#include "Core/Distributed/SharedVoxels.h"
#include "CsvWriter.h"
#include "IO/Info/CloudExtent.h"
#include "IO/Info/FieldText.h"
#include "IO/Info/LengthUnit.h"
#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <initializer_list>

namespace pointhaptics::app
{

void ResampleCommand::addTo(CLI::App& command)
{
  VoxelMeanSettings& voxels = this->lattice.voxels;
  CloudCommand::addTo(command);
  command.add_flag(
    "--covariance", voxels.computeCovariance, "Add the second moments of each voxel: VoxelCovariance");
  addChoice(command, "--representative", voxels.representative,
    { { "mean", Representative::Mean }, { "nearest-to-mean", Representative::NearestToMean },
      { "nearest-to-center", Representative::NearestToCenter }, { "median", Representative::Median } },
    "What stands for the points of a voxel: one of them, or the median of each value; default mean");
  addInteger(command, "--minimum-points", this->minimumPoints, 1, VTK_INT_MAX,
    "Leave out voxels with fewer points; default 1");
  command.add_flag("--original-ids", voxels.keepOriginalPointIds,
    "With --representative nearest-to-mean or nearest-to-center: add vtkOriginalPointIds, the row in IN, "
    "from 0, "
    "of the point that stands for each voxel");
  addOutput(command, "--voxel-index", this->voxelIndex, { "csv" },
    "File to write with the row in OUT of each point of IN, from 0, or -1: .csv", "FILE");
  this->lattice.addTo(command);
}

void ResampleCommand::complete(CLI::App& command, Files& files)
{
  CloudCommand::complete(command, files);
  const VoxelMeanSettings& voxels = this->lattice.voxels;
  requireUsage(!voxels.keepOriginalPointIds || keepsPoints(voxels.representative), "--original-ids", "",
    "a mean or median is no point of IN; give --representative nearest-to-mean or nearest-to-center too");
}

/// Removes steps and coordinate system of the file from transformed points, and its units from scaled ones.
/// With --unit the points are in metres.
void ResampleCommand::finish(vtkPolyData* means) const
{
  const auto removeIf = [means](bool condition, std::initializer_list<const char*> names)
  {
    for (const char* name : names)
    {
      condition ? means->GetFieldData()->RemoveArray(name) : void();
    }
  };
  const bool isMoved = this->lattice.hasTransform();
  removeIf(isMoved, { "LasScale", "LasOffset", "CoordinateSystem" });
  removeIf(isMoved && this->lattice.isScaled(), { "LengthUnit", kHeightUnit });
  const bool areMetres = this->unitIsGiven && this->lattice.scale.empty() && this->lattice.matrix.empty();
  areMetres ? sayMetres(means) : void();
}

void ResampleCommand::update(vtkVoxelMeanResampler* resampler, vtkPolyData* cloud) const
{
  const std::string why = whyNoLengths(cloud, this->lattice.transform());
  if (!why.empty())
  {
    const vtkSmartPointer<vtkPolyData> local = inLocalMetres(cloud);
    vtkDataArray* frame = local->GetFieldData()->GetArray(kLocalFrame);
    const double* box = cloud->GetBounds();
    throw Failure(fmt::format("{}: {}{}", this->input, why,
      box[1] - box[0] > 180.0
        ? ", as its longitudes lie on both sides of 180 degrees"
        : fmt::format(", or give metres a degree and of a unit of height: --scale {:.6g},{:.6g},{:.6g}",
            frame->GetTuple1(2), frame->GetTuple1(3), frame->GetTuple1(4))));
  }
  resampler->SetInputData(cloud);
  this->lattice.configure(resampler);
  resampler->SetMinimumPointsPerVoxel(int(this->minimumPoints));
  resampler->SetComputeVoxelIndex(!this->voxelIndex.empty());
  updateFilter(resampler, "resampling", this->input);
}

std::vector<std::string> ResampleCommand::notes(vtkPolyData* cloud, vtkPolyData* means, Ranks& ranks) const
{
  const bool areScaled = this->lattice.isScaled() && !this->unitIsGiven;
  std::vector<std::string> notes = { areScaled ? std::string() : this->unitNote(cloud) };
  const CloudExtent own = extentOf(cloud);
  const std::int64_t atZero = ranks.sum(own.atZero);
  const std::optional<Lattice> made = latticeOf(means);
  const bool areIn = made && contains(made->bounds(), this->lattice.transform().apply(Vec3()));
  if (areIn && areNoReturns(atZero, ranks.sum(own.finite)))
  {
    notes.push_back(fmt::format("{}: {} are resampled as others are", this->input, noReturnsText(atZero)));
  }
  return notes;
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

CloudResult ResampleCommand::result(const ResampleFigures& figures) const
{
  require(figures.invalid < figures.in, noFinitePoint(this->input, figures.in));
  require(figures.out > 0 || figures.clipped + figures.invalid == figures.in,
    fmt::format("{}: no voxel has {} points; give fewer to --minimum-points, or larger voxels", this->input,
      this->minimumPoints));
  require(figures.out > 0,
    fmt::format("{}: no point lies in the workspace: {} clipped, {} invalid; leave out --workspace, or mend "
                "the transform",
      this->input, figures.clipped, figures.invalid));
  return this->resultOf(fmt::format("{} in, {} out, {} clipped, {} invalid", countOfPoints(figures.in),
                          figures.out, figures.clipped, figures.invalid),
    { { "points_in", figures.in }, { "points_out", figures.out }, { "points_clipped", figures.clipped },
      { "points_invalid", figures.invalid } });
}

CloudResult ResampleCommand::work(Cloud& cloud, Files& files)
{
  std::string message;
  CsvWriter index;
  const std::string indexFile = expandedName(this->voxelIndex, this->input);
  require(indexFile.empty() || index.open(files.output(indexFile), kVoxelIndexHeader, message), message);
  vtkNew<vtkVoxelMeanResampler> resampler;
  this->update(resampler, cloud.points);
  vtkPolyData* means = resampler->GetOutput();
  Ranks alone;
  for (const std::string& note : this->notes(cloud.points, means, alone))
  {
    warn(note);
  }
  const CloudResult result = this->result({ cloud.points->GetNumberOfPoints(), means->GetNumberOfPoints(),
    resampler->GetNumberOfClippedPoints(), resampler->GetNumberOfInvalidPoints() });
  showWarnings();
  this->finish(means);
  writeCloud(means, this->output, files, this->writing);
  if (!indexFile.empty())
  {
    addVoxelIndex(voxelIndexOf(resampler), index);
    require(index.commit(message), message);
  }
  return result;
}

Command* resampleCommand()
{
  return new ResampleCommand;
}

} // namespace pointhaptics::app
