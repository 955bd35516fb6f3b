/// @file
/// Recipe of a scene, by which it can be made again.
#pragma once

#include "Core/Bandwidth/LocalBandwidth.h"
#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "Core/Resample/VoxelMeanSettings.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace pointhaptics
{

/// Recipe of a scene that a resampler made of a cloud: with that cloud it gives the scene again, bit for bit.
/// Plain data.
struct SceneOrigin
{
  /// True of the points near a hand, as fine as they are dense (LocalSceneBuilder); false of the whole cloud.
  bool isLocal() const { return globalCloud != 0; }

  VoxelMeanSettings voxels; ///< Settings of the resampler; of a local scene its workspace alone.
  std::optional<LocalBandwidthSettings> bandwidth;
  bool useCovariance = true;
  AffineTransform modelToWorkspace;          ///< Transform of the points.
  Bounds hand;                               ///< The box that a local scene was made about.
  std::uint64_t globalCloud = 0;             ///< HapticScene::cloudNumber() of the global scene beside it.
  std::shared_ptr<const SceneOrigin> global; ///< Origin of that scene.
};

} // namespace pointhaptics
