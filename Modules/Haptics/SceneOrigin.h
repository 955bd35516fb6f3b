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
  enum class Kind
  {
    Whole,  ///< The whole cloud, resampled.
    Region, ///< The points near the hand, as the whole cloud would be resampled (LocalRegion).
    Fine,   ///< The points near the hand, as fine as they are dense (LocalSceneBuilder).
  };

  Kind kind = Kind::Whole;
  VoxelMeanSettings voxels; ///< Settings of the resampler; for Fine its workspace alone.
  std::optional<LocalBandwidthSettings> bandwidth;
  bool useCovariance = true;
  AffineTransform modelToWorkspace; ///< Transform of the points.
  Bounds hand;                      ///< The box that Region and Fine were made about.
  /// The global scene beside which Region or Fine was made; a Region may have none.
  std::uint64_t globalCloud = 0; ///< HapticScene::cloudNumber() of it.
  std::shared_ptr<const SceneOrigin> global;
};

} // namespace pointhaptics
