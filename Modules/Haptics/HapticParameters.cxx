#include "Haptics/HapticParameters.h"

namespace pointhaptics
{
namespace
{
/// False for NaN.
bool within(double value, double minimum, double maximum) noexcept
{
  return value >= minimum && value <= maximum;
}

bool valid(const ContactParameters& contact) noexcept
{
  return within(contact.stiffness, 0.0, 1e5) && within(contact.damping, 0.0, 1e3) &&
    within(contact.staticFriction, 0.0, 10.0) &&
    within(contact.dynamicFriction, 0.0, contact.staticFriction) && contact.settleRate > 0.0 &&
    within(contact.deviceDamping, 0.0, 1e3) && contact.forceLimit > 0.0;
}

bool valid(const GradientStepsParameters& steps) noexcept
{
  return within(steps.freeGain, 0.0, 1.0) && within(steps.normalGain, 0.0, 10.0) &&
    within(steps.tangentGain, 0.0, 1.0) && within(steps.sinkTolerance, 0.0, 1.0) &&
    within(steps.stepPeriodSeconds, 1e-7, 1.0) && steps.maximumStepsPerTick >= 1 &&
    steps.maximumStepsPerTick <= 10000 && within(steps.largestStep, 1e-6, 10.0);
}
}

Status ForceLimits::check() const noexcept
{
  // Infinity is allowed: a run in virtual time has no motor to protect.
  return maximumForce >= 0.0 && maximumSlewRate >= 0.0 ? Status::Ok : Status::InvalidParameter;
}

Status HapticParameters::check() const noexcept
{
  const bool knownMethod = method == ProxyMethod::SurfaceFit || method == ProxyMethod::GradientSteps ||
    method == ProxyMethod::Sphere;
  return knownMethod && valid(contact) && valid(gradientSteps) ? Status::Ok : Status::InvalidParameter;
}

} // namespace pointhaptics
