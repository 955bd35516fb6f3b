/// @file
/// The scenes near the hand as a thread beside the servo loop makes them: later than the hand comes.
#pragma once

#include "Haptics/LocalScene.h"

#include <memory>

namespace pointhaptics::bench::touch
{

/// A thread that looks where the hand is in every tick and makes a scene where one is due, which the hand
/// feels so many ticks after that look; it does not look again before. The same in each run: time is the
/// hand's.
class LateScenes
{
public:
  /// @param cloud the points of @p global. @param lateTicks 0: each scene serves the tick in which it was
  /// due.
  LateScenes(
    std::shared_ptr<const PointIndex> cloud, std::shared_ptr<const HapticScene> global, int lateTicks);

  /// Advances to the next tick. @param touched the contact point of the last one: the HIP out of contact.
  /// @return what is to be felt; valid until the next but one call.
  const HapticScene* at(const Vec3& hip, const Vec3& touched);

private:
  LocalSceneFollower follower_;
  int lateTicks_;
  double secondsSinceLook_ = 0.0;
  int ticksLeft_ = 0; ///< Until what comes is there.
  std::shared_ptr<const HapticScene> felt_;
  std::shared_ptr<const HapticScene> last_; ///< The proxy may still be in it.
  std::shared_ptr<const HapticScene> coming_;
};

} // namespace pointhaptics::bench::touch
