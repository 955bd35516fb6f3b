#include "Haptics/Servo/PassivityLimit.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{
constexpr double kHalfATick = 0.5;
/// Rounding must not make a limit that is met exactly count as exceeded.
constexpr double kRounding = 1.0 + 1e-12;

double secondsFromPositionToForce(const HandLimits& limits, double rateHz) noexcept
{
  return (kHalfATick + limits.delayTicks) / rateHz;
}
}

double largestPassiveStiffness(const HandLimits& limits, double damping, double rateHz) noexcept
{
  const double byDamping = (limits.damping - damping) / secondsFromPositionToForce(limits, rateHz);
  const double byFriction = limits.positionStep > 0.0
    ? 2.0 * limits.friction / limits.positionStep - damping * rateHz
    : std::numeric_limits<double>::infinity();
  return std::max(0.0, std::min(byDamping, byFriction));
}

double largestPassiveDamping(const HandLimits& limits, double stiffness, double rateHz) noexcept
{
  const double byDamping = limits.damping - stiffness * secondsFromPositionToForce(limits, rateHz);
  const double byFriction = limits.positionStep > 0.0
    ? (2.0 * limits.friction / limits.positionStep - stiffness) / rateHz
    : std::numeric_limits<double>::infinity();
  return std::max(0.0, std::min(byDamping, byFriction));
}

Status checkPassive(const HandLimits& limits, double stiffness, double damping, double rateHz) noexcept
{
  if (!(rateHz <= limits.maximumRateHz * kRounding))
  {
    return Status::RateNotSupported;
  }
  const bool passive =
    stiffness <= largestPassiveStiffness(limits, damping, rateHz) * kRounding && damping <= limits.damping;
  return passive ? Status::Ok : Status::NotPassive;
}

} // namespace pointhaptics
