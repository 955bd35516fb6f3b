/// @file
/// How a scene was made, so that it can be made again.
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

/// Of a scene that was made of a cloud by a resampler: with the same cloud the same scene comes of it, bit
/// for bit. Plain data.
struct SceneOrigin
{
  enum class Kind
  {
    Whole,  ///< The whole cloud, resampled.
    Region, ///< What is near the hand, as the whole cloud would be resampled (LocalRegion).
    Fine,   ///< What is near the hand, as fine as the points there (LocalSceneBuilder).
  };

  Kind kind = Kind::Whole;
  VoxelMeanSettings voxels; ///< Of the resampler; of Fine its workspace alone.
  std::optional<LocalBandwidthSettings> bandwidth;
  bool useCovariance = true;
  AffineTransform modelToWorkspace; ///< The points went through it.
  Bounds hand;                      ///< Of Region and Fine: what the scene was made about.
  /// Of Region and Fine: the scene of the whole cloud that they were made beside; a Region may have none.
  std::uint64_t globalCloud = 0; ///< HapticScene::cloudNumber() of it.
  std::shared_ptr<const SceneOrigin> global;
};

} // namespace pointhaptics
