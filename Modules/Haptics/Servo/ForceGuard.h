/// @file
/// The last thing between the proxy and a motor: finite, clamped, and growing no faster than a slew limit.
#pragma once

#include "Haptics/HapticParameters.h"

#include "Core/Base/Vector3.h"

namespace pointhaptics
{

/// Inside its limits the force passes unchanged, bit for bit; outside it comes out inside. In this order:
/// 1. A force that is not finite counts as zero.
/// 2. A force longer than maximumForce keeps its direction and gets that length.
/// 3. Slew: the vector may change by maximumSlewRate * dt. Letting go is free: what the last force is longer
/// than the
///    request is dropped at once, so the result is never longer than the request and a request of zero is
///    obeyed in the same call. From the shortened last force the result moves towards the request by at most
///    the limit.
/// The result therefore lies on a straight line between two vectors no longer than the request: the limit can
/// hold a force back, it never pushes harder or further than asked. One thread; no allocation.
class ForceGuard
{
public:
  /// A limit that is negative or NaN counts as zero, an infinite one as no limit.
  explicit ForceGuard(const ForceLimits& limits = {});
  /// @param force newtons; @param dt seconds since the last call, above 0 (anything else counts as 0: no
  /// growth).
  /// @return the force to send, newtons; always finite.
  Vec3 limit(const Vec3& force, double dt) noexcept;
  /// As ForceLimits::maximumForce, from the next call on.
  void setMaximumForce(double newtons) noexcept;
  /// The last force counts as zero again: for a fault, after which nothing is known of the motors.
  void reset() noexcept;

private:
  ForceLimits limits_;
  Vec3 last_;
};

} // namespace pointhaptics
