/// @file
/// What the command `resample` is asked for and says, of this program and of pointhaptics-mpi.
#pragma once

#include "Clouds/CloudToCloud.h"
#include "Options/LatticeOptions.h"

#include <cstdint>
#include <string>

namespace CLI
{
class App;
}
class vtkPolyData;
class vtkVoxelMeanResampler;

namespace pointhaptics
{
namespace app
{

struct ResampleOptions
{
  CloudToCloudOptions files;
  LatticeOptions lattice;
  std::int64_t minimumPoints = 1;
  std::string voxelIndex; ///< File to write; empty: none.

  void addTo(CLI::App& command);
  /// All but the voxel index.
  void configure(vtkVoxelMeanResampler* resampler) const;
  /// What is done with the means before they are written.
  void finish(vtkPolyData* means) const;
};

/// Numbers of points.
struct ResampleFigures
{
  std::int64_t in = 0;
  std::int64_t out = 0;
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;
};

/// Why no voxel is left.
std::string whyEmpty(const ResampleOptions& options, const ResampleFigures& figures);
void print(const ResampleOptions& options, const ResampleFigures& figures);

} // namespace app
} // namespace pointhaptics
