#include "Haptics/Servo/ForceLimit.h"

#include "Core/Base/QuantityText.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{

double ForceLimit::newtons() const noexcept
{
  return std::min({ user, device, program });
}

const char* ForceLimit::name() const noexcept
{
  const double least = this->newtons();
  return !std::isfinite(least) ? "none" : least == device ? "device" : least == program ? "program" : "user";
}

std::string ForceLimit::text() const
{
  const double least = this->newtons();
  const std::string number = least > 0.0 && std::isfinite(least) ? ratioText(least) : "0";
  return std::isfinite(least) ? number + " N (" + this->name() + ")" : "none";
}

ForceLimit servoForceLimit(
  const HandLimits& limits, const ContactParameters& contact, const ForceLimits& program) noexcept
{
  return { limits.maximumForce, contact.forceLimit, std::min(program.maximumForce, kMostServoForce) };
}

} // namespace pointhaptics
