#include "Haptics/HapticParameters.h"

namespace pointhaptics
{
Status ForceLimits::check() const noexcept
{
  // Infinity is allowed: a run in virtual time has no motor to protect.
  return maximumForce >= 0.0 && maximumSlewRate >= 0.0 ? Status::Ok : Status::InvalidParameter;
}

Status HapticParameters::check() const noexcept
{
  const bool knownMethod = method == ProxyMethod::SurfaceFit || method == ProxyMethod::GradientSteps ||
    method == ProxyMethod::Sphere;
  const bool isValid =
    knownMethod && !firstOutOfRange(*this).name && contact.dynamicFriction <= contact.staticFriction;
  return isValid ? Status::Ok : Status::InvalidParameter;
}

} // namespace pointhaptics
