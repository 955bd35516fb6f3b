#include "Devices/Falcon/FalconForceChain.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointhaptics
{
namespace
{
constexpr double kMotorUnitsPerNewtonMetre = -10000.0;
constexpr double kLargestMotorValue = 4096.0;
constexpr double kLargestForce = 8.0;
constexpr double kLargestTorque = 0.4096;
constexpr double kShortestRamp = 1.0;
constexpr double kLongestRamp = 60.0;
/// Longest time between two calls that counts: the force must not arrive at once after a pause.
constexpr double kLongestStep = 0.1;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool isFinite(const FalconAngles& a) noexcept
{
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}
}

Status FalconForceLimits::check() const noexcept
{
  const bool valid = NumberRange{ 0.0, kLargestForce }.holds(maximumForce) &&
    NumberRange{ 0.0, kLargestTorque }.holds(maximumTorque) && maximumTorqueRate >= 0.0 &&
    NumberRange{ kShortestRamp, kLongestRamp }.holds(rampSeconds);
  return valid ? Status::Ok : Status::InvalidParameter;
}

std::int16_t falconMotorValue(double torque) noexcept
{
  const double value = std::isfinite(torque) ? kMotorUnitsPerNewtonMetre * torque : 0.0;
  return std::int16_t(std::lround(std::min(std::max(value, -kLargestMotorValue), kLargestMotorValue)));
}

FalconForceChain::FalconForceChain(const FalconForceLimits& limits)
  : limits_(limits)
{
  if (limits_.check() != Status::Ok)
  {
    limits_ = FalconForceLimits();
    limits_.maximumForce = 0.0;
  }
  force_ = ForceGuard({ limits_.maximumForce, kInfinity });
  slew_ = ForceGuard({ kInfinity, limits_.maximumTorqueRate });
}

void FalconForceChain::restart() noexcept
{
  ramp_ = 0.0;
  torques_ = {};
  force_.reset();
  slew_.reset();
}

std::array<std::int16_t, kFalconLegs> FalconForceChain::step(
  const Vec3& force, const Vec3& position, const FalconAngles& angles, bool homedAndArmed, double dt) noexcept
{
  if (!homedAndArmed)
  {
    restart();
    return {};
  }
  FalconAngles wanted{};
  const bool finite = pointhaptics::isFinite(force) && pointhaptics::isFinite(position) && isFinite(angles);
  const double elapsed = dt > 0.0 ? std::min(dt, kLongestStep) : 0.0;
  const double ramp = std::min(1.0, ramp_ + elapsed / limits_.rampSeconds);
  if (!finite || !falcon::torques(position, angles, force_.limit(ramp * force, elapsed), wanted) ||
    !isFinite(wanted))
  {
    restart();
    return {};
  }
  ramp_ = ramp;
  const double largest = std::max({ std::abs(wanted[0]), std::abs(wanted[1]), std::abs(wanted[2]) });
  const double scale = largest > limits_.maximumTorque ? limits_.maximumTorque / largest : 1.0;
  const Vec3 sent = slew_.limit({ scale * wanted[0], scale * wanted[1], scale * wanted[2] }, elapsed);
  torques_ = { sent.x, sent.y, sent.z };
  return { falconMotorValue(sent.x), falconMotorValue(sent.y), falconMotorValue(sent.z) };
}

} // namespace pointhaptics
