/// @file
/// Largest stiffness with which a sampled spring gives the hand no more energy than it took.
#pragma once

#include "Core/Base/Status.h"

#include <limits>
#include <string>

namespace pointhaptics
{

struct HapticParameters;

/// Mechanics of the hand and of the device that reads and pushes it, as far as the servo loop must know them.
/// The defaults are those of a hand that no force moves: no limit.
struct HandLimits
{
  double damping =
    std::numeric_limits<double>::infinity(); ///< b: least viscous friction of drive and hand, N s/m.
  double friction = std::numeric_limits<double>::infinity(); ///< Least Coulomb friction, N.
  double positionStep = 0.0; ///< Largest step between two positions that the device can tell apart, m.
  double delayTicks = 0.0;   ///< Ticks from a position to the force that answers it.
  double maximumRateHz = std::numeric_limits<double>::infinity();
  double maximumForce = std::numeric_limits<double>::infinity(); ///< N that the device declares, above 0.
  double rampDownSeconds = 0.0; ///< Over which the loop takes the force away when it stops or is left alone.
  double rampUpSeconds = 0.0;   ///< Over which it lets the force come back.
};

/// A virtual wall f = K depth - B speed, sampled and held at @p rateHz (T = 1/rate) and answered @p
/// delayTicks later, is passive where
///   b > K T (1/2 + delayTicks) + B   and   K + B / T <= 2 friction / positionStep
/// (J. E. Colgate and G. G. Schenkel 1997, with the delay of N. Diolaiti et al. 2006; J. J. Abbott and A. M.
/// Okamura 2005 for the quantised position, from which the speed is taken by differences too). With
/// delayTicks = 0 and B = 0 this is the familiar 2 b / T. PassivityTest asserts by simulation that nothing
/// accepted gives energy back, and that far above the limit it does.
/// @return N/m: the largest K beside damping @p damping (N s/m); 0 where that alone is too much.
double largestPassiveStiffness(const HandLimits& limits, double damping, double rateHz) noexcept;

/// RateNotSupported, NotPassive, or Ok.
Status checkPassive(const HandLimits& limits, double stiffness, double damping, double rateHz) noexcept;

/// Ok; InvalidParameter where @p isValid is false or @p parameters are not; else what checkPassive() says of
/// their spring. @p message, where given, names the limit.
Status checkSpring(bool isValid, const HandLimits& limits, const HapticParameters& parameters, double rateHz,
  std::string* message);

} // namespace pointhaptics
