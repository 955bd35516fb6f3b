/// @file
/// --dims --voxel --workspace --scale --rotate --translate --matrix --unit: the same wherever a cloud is
/// resampled.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"

#include <string>
#include <vector>

namespace CLI
{
class App;
}
class vtkVoxelMeanResampler;

namespace pointhaptics
{
namespace app
{

/// Options as given; empty vectors mean "not given". validate() has been called by the parser before a
/// command runs.
struct LatticeOptions
{
  std::vector<int> dimensions;   ///< 1 or 3 numbers.
  double voxelSize = 0.0;        ///< Metres; 0 = not given.
  std::vector<double> workspace; ///< 6: x0,x1,y0,y1,z0,z1.
  std::vector<double> scale;     ///< 1 or 3.
  std::vector<double> rotate;    ///< 4: degrees, x, y, z.
  std::vector<double> translate; ///< 3.
  std::vector<double> matrix;    ///< 16, row by row; excludes scale, rotate and translate.
  std::string unit = "m";        ///< m, cm, mm, um, km, in, ft: unit of the file's coordinates.

  /// Adds the options to @p command; bad values end the parse with a usage error that names the cure.
  void addTo(CLI::App& command);
  /// translate * rotate * scale * unit, or matrix * unit.
  AffineTransform transform() const;
  /// What a unit of the file's coordinates is.
  double metresPerUnit() const;
  bool hasTransform() const;
  /// Whether the lattice's voxels were chosen: --dims or --voxel.
  bool hasVoxels() const { return !this->dimensions.empty() || this->voxelSize > 0.0; }
  /// --workspace; empty where it was not given.
  Bounds workspaceBounds() const;
  /// Sets transform, workspace and dimensions or voxel size on @p resampler (those that were given).
  void configure(vtkVoxelMeanResampler* resampler) const;
};

} // namespace app
} // namespace pointhaptics
