/// @file
/// From a pipeline's vtkPolyData to the snapshot the servo thread feels.
#pragma once

#include "Haptics/HapticScene.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <memory>
#include <optional>

class vtkPolyData;

namespace pointhaptics
{

/// Reads the points of @p cloud, with VoxelPointCount, VoxelCovariance, ProxyRadius and the field data
/// LatticeOrigin, LatticeSpacing and ModelToWorkspace where they are there (the output of
/// vtkVoxelMeanResampler and vtkKernelBandwidthFilter has them all). @p useCovariance false leaves
/// VoxelCovariance unused. Where there is no ProxyRadius the scene computes the radii it needs by @p
/// bandwidth, if given: the same as with the whole array, and sooner. @p voxels, if given: what @p cloud was
/// resampled with, for HapticScene::origin(). Null on an error, and @p status says which (see
/// HapticScene::create).
POINTHAPTICSSCENE_EXPORT std::shared_ptr<const HapticScene> makeHapticScene(vtkPolyData* cloud,
  Status& status, bool useCovariance = true, const std::optional<LocalBandwidthSettings>& bandwidth = {},
  const VoxelMeanSettings* voxels = nullptr);

} // namespace pointhaptics
