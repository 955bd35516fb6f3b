/// @file
/// Options and messages of the command `resample`, in this program and in pointhaptics-mpi.
#pragma once

#include "Clouds/CloudToCloud.h"
#include "Options/LatticeOptions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace CLI
{
class App;
}
class vtkPolyData;
class vtkVoxelMeanResampler;

namespace pointhaptics
{
class CsvWriter;
class Ranks;
namespace app
{

struct ResampleOptions
{
  CloudToCloudOptions files;
  LatticeOptions lattice;
  std::int64_t minimumPoints = 1;
  std::string voxelIndex; ///< File to write; empty: none.

  void addTo(CLI::App& command);
  /// Ends the parse with a usage error where an option has no meaning beside the others.
  void check() const;
  /// Sets all options but the voxel index on @p resampler.
  void configure(vtkVoxelMeanResampler* resampler) const;
  /// Completes the means before they are written.
  void finish(vtkPolyData* means) const;
};

/// What a few points of @p cloud far from all others do to the automatic lattice, and how they are left out:
/// not where it @p isDone with voxels of a given size, of which no other is coarser for it. And that rays
/// which did not return are resampled. Collective where @p ranks have parts of the cloud: the same on all.
std::vector<std::string> oddPointsNotes(
  const ResampleOptions& options, bool isDone, vtkPolyData* cloud, Ranks& ranks);

/// Opens the file of --voxel-index. False: @p message says why it cannot be written.
bool openVoxelIndex(const std::string& fileName, CsvWriter& file, std::string& message);
/// Row in the output of each point's voxel, or -1. @pre ComputeVoxelIndex is on.
std::vector<std::int64_t> voxelIndexOf(vtkVoxelMeanResampler* resampler);
void addVoxelIndex(const std::vector<std::int64_t>& rows, CsvWriter& file);

/// Numbers of points.
struct ResampleFigures
{
  std::int64_t in = 0;
  std::int64_t out = 0;
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;
};

/// Reason why no voxel is left.
std::string whyEmpty(const ResampleOptions& options, const ResampleFigures& figures);
CloudResult resultOf(const ResampleOptions& options, const ResampleFigures& figures);

} // namespace app
} // namespace pointhaptics
