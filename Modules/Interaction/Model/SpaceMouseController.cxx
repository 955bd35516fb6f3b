#include "SpaceMouseController.h"

#include "ModelTransform.h"
#include "ScreenView.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr std::uint32_t kScaleButton = 1;
constexpr std::uint32_t kResetButton = 2;
/// Motion of the model in a second with the puck at its end: edges of the workspace, degrees, factor.
constexpr double kEdgesPerSecond = 0.5;
constexpr double kDegreesPerSecond = 90.0;
constexpr double kScalePerSecond = 2.0;
/// Longest time between two reports that counts, seconds: the model must not jump after a pause.
constexpr double kLongestStep = 0.2;

} // namespace

/// The puck's axes are those of the screen: x right, y up, z towards the person.
void SpaceMouseController::move(const SpaceMouseMotion& motion, double seconds)
{
  const double step = std::min(seconds, kLongestStep);
  const ScreenAxes screen = screen_.axes();
  const auto onScreen = [&](const Vec3& v)
  { return v.x * screen.right + v.y * screen.up - v.z * screen.forward; };
  if (motion.buttons & kScaleButton)
  {
    model_.scale(std::pow(kScalePerSecond, motion.shift.z * step));
    return;
  }
  if (motion.shift != Vec3())
  {
    model_.translate(kEdgesPerSecond * model_.edge() * step * onScreen(motion.shift));
  }
  if (motion.turn != Vec3())
  {
    model_.rotate(kDegreesPerSecond * step * norm(motion.turn), onScreen(motion.turn));
  }
}

void SpaceMouseController::update(double timeSeconds)
{
  const SpaceMouseMotion motion = mouse_ ? mouse_->motion() : SpaceMouseMotion();
  const double seconds = timeSeconds - lastTime_;
  lastTime_ = timeSeconds;
  const std::uint32_t pressed = motion.buttons & ~lastButtons_;
  lastButtons_ = motion.buttons;
  if (pressed & kResetButton)
  {
    model_.reset();
  }
  const bool moves = !motion.resting() && screen_.renderer();
  if (moves != isMoving_)
  {
    isMoving_ = moves;
    moves ? model_.beginGesture() : model_.endGesture();
  }
  if (moves)
  {
    this->move(motion, seconds);
  }
}

} // namespace pointhaptics
