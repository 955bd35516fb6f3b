/// @file
/// The spring between contact point and hand: limited, and gone where the hand has gone away.
#pragma once

#include <algorithm>
#include <cmath>

namespace pointhaptics
{

/// Magnitude of the spring's force over its length. It is K times the length up to the force limit F, stays
/// at F up to twice the hold length, and fades smoothly to 0 at three times the hold length. So a press into
/// a solid stays hard, and no hand is pulled for ever. The hold length is F/K, within 5 and 15 mm: a hand
/// tells a shorter way from a tremor, and a longer one does not fit into the reach of desktop devices; a
/// spring softer than F over 30 mm is below F where it fades. With an infinite limit the spring is plain and
/// never fades. Newtons, metres; any thread.
class ContactSpring
{
public:
  static constexpr double kLeastHold = 5e-3;
  static constexpr double kMostHold = 15e-3;
  /// Begin and end of the fade, over the hold length.
  static constexpr double kFadeBegins = 2.0;
  static constexpr double kFadeEnds = 3.0;

  ContactSpring(double stiffness, double forceLimit) noexcept
    : stiffness_(stiffness)
    , limit_(forceLimit)
    , hold_(std::isfinite(forceLimit) ? std::clamp(forceLimit / stiffness, kLeastHold, kMostHold) : INFINITY)
  {
  }

  /// Length from which on the spring has no force, metres.
  double end() const noexcept { return kFadeEnds * hold_; }

  /// @return the factor on the plain spring's force at this length, 0 to 1; exactly 1 below limit and fade.
  double part(double length) const noexcept
  {
    const double plain = stiffness_ * length;
    const double within = plain > limit_ ? limit_ / plain : 1.0;
    const double t = std::clamp(length / hold_ - kFadeBegins, 0.0, kFadeEnds - kFadeBegins);
    return within * (1.0 - t * t * (3.0 - 2.0 * t));
  }

private:
  double stiffness_;
  double limit_;
  double hold_;
};

} // namespace pointhaptics
