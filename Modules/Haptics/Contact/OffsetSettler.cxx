#include "Haptics/Contact/OffsetSettler.h"

namespace pointhaptics
{
namespace
{
/// Rounding of places in the workspace, metres.
constexpr double kRounding = 1e-12;
}

Vec3 OffsetSettler::settle(const Vec3& offset, double moved, double shrink) noexcept
{
  const Vec3 change = offset - last_;
  const double length = norm(change);
  const double allowed = kFreeSteps * moved + kRounding;
  if (length > allowed)
  {
    remainder_ -= (1.0 - allowed / length) * change;
  }
  last_ = offset;
  if (!settling())
  {
    return offset;
  }
  const double left = norm(remainder_);
  remainder_ = left > shrink ? (1.0 - shrink / left) * remainder_ : Vec3();
  return settling() ? offset + remainder_ : offset;
}

void OffsetSettler::resumeFrom(const Vec3& felt) noexcept
{
  last_ = felt;
  remainder_ = Vec3();
}

} // namespace pointhaptics
