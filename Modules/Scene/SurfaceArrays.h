/// @file
/// Arrays of the felt surface, for pictures.
#pragma once

#include "PointHapticsSceneModule.h" // For export macro

class vtkPolyData;

namespace pointhaptics
{

class HapticScene;

/// Float array: the distance of each voxel mean from the fitted surface that is felt, not below 0, in the
/// units of the cloud before its model transform (metres, unless the file has others); by the mean scale
/// where the transform's scales differ by axis. NaN where there is no surface.
constexpr const char* kResidualArrayName = "Residual";
/// Float array of three components: the unit normal of that surface at each mean, on either side, in the
/// frame of the means; zero where there is none.
constexpr const char* kSurfaceNormalArrayName = "SurfaceNormal";

/// Adds the wanted arrays to @p means, points of the workspace from which @p scene was made. About 10 us a
/// point and thread of vtkSMPTools. Any thread that owns @p means.
POINTHAPTICSSCENE_EXPORT void addSurfaceArrays(
  vtkPolyData* means, const HapticScene& scene, bool residuals, bool normals);

} // namespace pointhaptics
