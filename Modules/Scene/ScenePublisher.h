/// @file
/// Decides which scene the hand feels while the model moves and new scenes are made.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Haptics/HapticScene.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

namespace pointhaptics
{

/// A model that is rotated, translated or uniformly scaled is felt at its new place at once: the newest scene
/// is moved (HapticScene::moved, below a microsecond), until the cloud is resampled there. A scene that was
/// made for a former place of the model is moved to the present one. Any thread.
class POINTHAPTICSSCENE_EXPORT ScenePublisher
{
public:
  using Sink = std::function<void(std::shared_ptr<const HapticScene>)>;

  /// Sets the receiver of the scenes, which it gets one at a time, under a lock; may be empty.
  void setSink(Sink sink);
  /// Notes that the model moved, and publishes the newest scene there. A scene that cannot be moved so, under
  /// shear or scales that differ by axis, is not published.
  void move(const AffineTransform& modelToWorkspace);
  /// Publishes a scene of cloud @p cloud, or null where there is nothing to feel, at the present place of the
  /// model. @param number of the request whose global scene this is, or is made beside: after that one.
  /// Nothing happens if that cloud is gone, or a later request's scene is there.
  void publish(std::shared_ptr<const HapticScene> scene, std::uint64_t cloud, std::uint64_t number);
  /// Notes that another cloud comes: scenes of the old one are not moved any more.
  void startCloud();
  /// Number of the present cloud.
  std::uint64_t cloud() const;

private:
  mutable std::mutex mutex_;
  Sink sink_;
  std::shared_ptr<const HapticScene> newest_;
  std::optional<AffineTransform> place_; ///< That of the last move().
  std::uint64_t cloud_ = 0;
  std::uint64_t number_ = 0; ///< Number of the newest scene.
};

} // namespace pointhaptics
