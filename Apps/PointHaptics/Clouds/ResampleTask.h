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

/// That rays of @p cloud which did not return are among the points of @p means; empty: they are not.
/// Collective where @p ranks have parts of the cloud: the same on all.
std::string noReturnsNote(
  const ResampleOptions& options, vtkPolyData* cloud, vtkPolyData* means, Ranks& ranks);

/// Updates @p resampler, whose input is @p cloud. False: @p message says why, such as that x and y are
/// degrees.
bool updateResampler(
  const ResampleOptions& options, vtkPolyData* cloud, vtkVoxelMeanResampler* resampler, std::string& message);

/// In what unit --voxel is where @p cloud says that its own is no metre, and --unit does not; else empty.
std::string voxelUnitNote(const ResampleOptions& options, vtkPolyData* cloud);

/// Header of the file of --voxel-index.
constexpr const char* kVoxelIndexHeader = "voxel";
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
