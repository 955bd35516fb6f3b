/// @file
/// --dims --voxel --workspace --scale --rotate --translate --matrix --unit: the same wherever a cloud is
/// resampled.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "Core/Resample/VoxelMeanSettings.h"
#include "Devices/PathUnits.h"

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

/// Adds --path-unit and --path-time-unit, of the numbers in the file of --path.
void addPathUnits(CLI::App& command, PathUnits& units);
/// These options, and --unit.
UnitNames unitOptions();

/// The transform's options as given; empty vectors mean "not given".
struct LatticeOptions
{
  VoxelMeanSettings voxels;      ///< With what was given.
  bool voxelsAreGiven = false;   ///< --dims or --voxel.
  std::vector<double> scale;     ///< 1 or 3.
  std::vector<double> rotate;    ///< 4: degrees, x, y, z.
  std::vector<double> translate; ///< 3.
  std::vector<double> matrix;    ///< 16, row by row; excludes scale, rotate and translate.
  std::string unit = "m";        ///< m, cm, mm, um, km, in, ft, yd: unit of the file's coordinates.

  /// Adds the options to @p command; bad values end the parse with a usage error that names the cure.
  void addTo(CLI::App& command);
  /// translate * rotate * scale * unit, or matrix * unit.
  AffineTransform transform() const;
  /// Length of a unit of the file's coordinates, metres.
  double metresPerUnit() const;
  bool hasTransform() const;
  /// Whether lengths change by it.
  bool isScaled() const { return this->unit != "m" || !this->scale.empty() || !this->matrix.empty(); }
  /// --workspace; empty where it was not given.
  Bounds workspace() const;
  /// Sets the transform, where one was given, and the settings on @p resampler.
  void configure(vtkVoxelMeanResampler* resampler) const;
};

} // namespace app
} // namespace pointhaptics
