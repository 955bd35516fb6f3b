#include "Haptics/Servo/PassivityLimit.h"

#include "Haptics/HapticParameters.h"

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

/// Three digits are enough for a limit.
std::string number(double value)
{
  std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + (value < 100.0 ? 3 : 0));
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

Status checkSpring(bool isValid, const HandLimits& limits, const HapticParameters& parameters, double rateHz,
  std::string* message)
{
  const ContactParameters& contact = parameters.contact;
  const Status status = isValid && parameters.check() == Status::Ok
    ? checkPassive(limits, contact.stiffness, contact.damping, rateHz)
    : Status::InvalidParameter;
  if (message && status == Status::RateNotSupported)
  {
    *message = "the device cannot be served at " + number(rateHz) + " Hz; use at most " +
      number(limits.maximumRateHz) + " Hz";
  }
  else if (message && status == Status::NotPassive)
  {
    *message = "stiffness " + number(contact.stiffness) + " N/m with damping " + number(contact.damping) +
      " N s/m at " + number(rateHz) + " Hz would make the hand shake; use a stiffness of at most " +
      number(largestPassiveStiffness(limits, contact.damping, rateHz)) + " N/m beside this damping (" +
      number(largestPassiveStiffness(limits, 0.0, rateHz)) + " N/m without damping)";
  }
  else if (message)
  {
    *message = status == Status::Ok ? "" : pointhaptics::message(status);
  }
  return status;
}

} // namespace pointhaptics
