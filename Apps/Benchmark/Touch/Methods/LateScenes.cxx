#include "Benchmark/Touch/Methods/LateScenes.h"

#include "Benchmark/Touch/TouchStrokes.h"

#include <utility>

namespace pointhaptics::bench::touch
{

LateScenes::LateScenes(
  std::shared_ptr<const PointIndex> cloud, std::shared_ptr<const HapticScene> global, int lateTicks)
  : follower_(global, std::move(cloud))
  , lateTicks_(lateTicks)
  , felt_(std::move(global))
{
}

const HapticScene* LateScenes::at(const Vec3& hip, const Vec3& touched)
{
  secondsSinceLook_ += kTickSeconds;
  if (!coming_)
  {
    Bounds hand;
    hand.include(hip);
    hand.include(touched);
    const bool changes = follower_.update(hand, lateTicks_ > 0 ? secondsSinceLook_ : 0.0);
    secondsSinceLook_ = 0.0;
    if (changes)
    {
      coming_ = follower_.scene();
      ticksLeft_ = lateTicks_;
    }
  }
  if (coming_ && ticksLeft_-- == 0)
  {
    last_ = std::exchange(felt_, std::exchange(coming_, nullptr));
  }
  return felt_.get();
}

} // namespace pointhaptics::bench::touch
