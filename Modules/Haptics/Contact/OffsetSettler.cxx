#include "Haptics/Contact/OffsetSettler.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// Rounding error of positions in the workspace, metres.
constexpr double kRounding = 1e-12;

/// Moves @p from by at most @p way towards @p to. Directions less than a right angle apart are turned, so
/// that the vector gets no shorter on the way than the shorter one.
Vec3 towards(const Vec3& from, const Vec3& to, double way) noexcept
{
  const Vec3 change = to - from;
  const double distance = norm(change);
  if (distance <= way)
  {
    return to;
  }
  const double start = norm(from);
  const double end = norm(to);
  const double across = norm(cross(from, to));
  const double along = dot(from, to);
  if (!(along > 0.0 && across > 0.0))
  {
    return from + (way / distance) * change;
  }
  const double angle = std::atan2(across, along);
  const double fraction = way / std::hypot(end - start, angle * std::max(start, end));
  const double length = start + fraction * (end - start);
  const double scale = length / std::sin(angle);
  return (scale * std::sin((1.0 - fraction) * angle) / start) * from +
    (scale * std::sin(fraction * angle) / end) * to;
}

}

Vec3 OffsetSettler::settle(const Vec3& offset, double moved, double shrink) noexcept
{
  const Vec3 change = offset - last_;
  const double allowed = kFreeSteps * moved + kRounding;
  const bool follows = norm2(change) <= allowed * allowed;
  last_ = offset;
  if (follows && !isSettling_)
  {
    felt_ = offset;
    return offset;
  }
  felt_ = follows ? towards(withoutReversal(felt_, felt_ + change, offset), offset, shrink)
                  : towards(felt_, offset, allowed + shrink);
  isSettling_ = felt_ != offset;
  return felt_;
}

void OffsetSettler::resumeFrom(const Vec3& felt) noexcept
{
  last_ = felt_ = felt;
  isSettling_ = false;
}

} // namespace pointhaptics
