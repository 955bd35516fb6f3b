/// @file
/// Which scene the hand feels while the model moves and scenes of it are being made.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Haptics/HapticScene.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>

namespace pointhaptics
{

/// A model that is turned, shifted or uniformly scaled is felt where it is at once: the newest scene is moved
/// (HapticScene::moved, below a microsecond), until the one of the cloud resampled there is made. A scene
/// that was made for where the model no longer is comes moved to where it is. Any thread.
class POINTHAPTICSSCENE_EXPORT ScenePublisher
{
public:
  using Sink = std::function<void(std::shared_ptr<const HapticScene>)>;

  /// Who gets the scenes from now on, one at a time, under a lock; may be empty.
  void setSink(Sink sink);
  /// The model is moved. Publishes the newest scene there, if there is one that can be moved so: not under
  /// shear, nor scales that differ by axis.
  void move(const AffineTransform& modelToWorkspace);
  /// A scene of cloud @p cloud is made for request @p number, or null where there is nothing to feel.
  /// Publishes it where the model is by now; nothing, if that cloud is gone or a later request's is there.
  /// But an earlier scene of the whole cloud takes its place beside a later one of a part
  /// (HapticScene::fallback()), and a part is published after the whole cloud of the same request if it was
  /// made beside that.
  void publish(std::shared_ptr<const HapticScene> scene, std::uint64_t cloud, std::uint64_t number);
  /// Another cloud comes: what is felt of the old one is not moved any more.
  void startCloud();
  /// The number of the present one.
  std::uint64_t cloud() const;

private:
  mutable std::mutex mutex_;
  Sink sink_;
  std::shared_ptr<const HapticScene> newest_;
  AffineTransform modelToWorkspace_;
  std::uint64_t cloud_ = 0;
  std::uint64_t number_ = 0; ///< Number of the newest scene.
  bool isMoved_ = false;     ///< True if move() was called since the newest scene was asked for.
};

} // namespace pointhaptics
