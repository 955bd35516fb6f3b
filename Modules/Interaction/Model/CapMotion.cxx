#include "CapMotion.h"

#include "ModelTransform.h"
#include "ScreenView.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// Motion of the model in a second with the puck at its end: edges of the workspace, degrees, factor.
constexpr double kEdgesPerSecond = 0.5;
constexpr double kDegreesPerSecond = 90.0;
constexpr double kScalePerSecond = 2.0;
/// Longest time between two reports that counts, seconds: the model must not jump after a pause.
constexpr double kLongestStep = 0.2;

} // namespace

void CapMotion::move(const Vec3& shift, const Vec3& turn, bool scales, double seconds)
{
  if (!screen_.renderer())
  {
    return;
  }
  if (!isMoving_)
  {
    isMoving_ = true;
    model_.beginGesture();
  }
  const double step = std::min(seconds, kLongestStep);
  const ScreenAxes screen = screen_.axes();
  const auto onScreen = [&](const Vec3& v)
  { return v.x * screen.right + v.y * screen.up - v.z * screen.forward; };
  if (scales)
  {
    model_.scale(std::pow(kScalePerSecond, shift.z * step));
    return;
  }
  if (shift != Vec3())
  {
    model_.translate(kEdgesPerSecond * model_.edge() * step * onScreen(shift));
  }
  if (turn != Vec3())
  {
    model_.rotate(kDegreesPerSecond * step * norm(turn), onScreen(turn));
  }
}

void CapMotion::rest()
{
  if (isMoving_)
  {
    isMoving_ = false;
    model_.endGesture();
  }
}

void CapMotion::reset()
{
  model_.reset();
}

} // namespace pointhaptics
