#include "Haptics/Servo/ForceGuard.h"

namespace pointhaptics
{
namespace
{
/// Factor that takes a shortened vector inside its limit in spite of rounding.
constexpr double kInside = 1.0 - 1e-15;

/// Length of a vector, without overflow for any finite one up to 1e308.
double length(const Vec3& v) noexcept
{
  return std::hypot(v.x, v.y, v.z);
}

double validLimit(double limit) noexcept
{
  return limit > 0.0 ? limit : 0.0;
}

/// @p v itself, bit for bit, where it is no longer than @p limit (of a vector @p vLength long).
Vec3 shortened(const Vec3& v, double vLength, double limit) noexcept
{
  return vLength <= limit ? v : (limit / vLength * kInside) * v;
}
}

ForceGuard::ForceGuard(const ForceLimits& limits)
{
  limits_.maximumForce = validLimit(limits.maximumForce);
  limits_.maximumSlewRate = validLimit(limits.maximumSlewRate);
}

Vec3 ForceGuard::limit(const Vec3& force, double dt) noexcept
{
  Vec3 request = force;
  double requestLength = length(request);
  if (!std::isfinite(requestLength))
  {
    request = {};
    requestLength = 0.0;
  }
  Vec3 result = shortened(request, requestLength, limits_.maximumForce);
  // Nearest point to the last force among those no longer than the request: never further from it than the
  // last force is, so a request inside the slew limit stays inside.
  const Vec3 base = shortened(last_, length(last_), length(result));
  const Vec3 change = result - base;
  const double maximumChange = dt > 0.0 && std::isfinite(dt) ? limits_.maximumSlewRate * dt : 0.0;
  if (length(result - last_) > maximumChange && length(change) > maximumChange)
  {
    result = base + shortened(change, length(change), maximumChange);
  }
  last_ = result;
  return result;
}

void ForceGuard::setMaximumForce(double newtons) noexcept
{
  limits_.maximumForce = validLimit(newtons);
}

void ForceGuard::reset() noexcept
{
  last_ = {};
}

} // namespace pointhaptics
