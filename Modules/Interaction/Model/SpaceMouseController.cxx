#include "SpaceMouseController.h"

namespace pointhaptics
{
namespace
{

constexpr std::uint32_t kScaleButton = 1;
constexpr std::uint32_t kResetButton = 2;

} // namespace

void SpaceMouseController::update(double timeSeconds)
{
  const SpaceMouseMotion motion = mouse_ ? mouse_->motion() : SpaceMouseMotion();
  const double seconds = timeSeconds - lastTime_;
  lastTime_ = timeSeconds;
  const std::uint32_t pressed = motion.buttons & ~lastButtons_;
  lastButtons_ = motion.buttons;
  if (pressed & kResetButton)
  {
    cap_.reset();
  }
  if (motion.resting())
  {
    cap_.rest();
  }
  else
  {
    cap_.move(motion.shift, motion.turn, (motion.buttons & kScaleButton) != 0, seconds);
  }
}

} // namespace pointhaptics
