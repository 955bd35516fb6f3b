/// @file
/// One rule for how hard a hand may be pushed.
#pragma once

#include "Haptics/HapticParameters.h"
#include "Haptics/Servo/PassivityLimit.h"

#include <limits>
#include <string>

namespace pointhaptics
{

/// The least of three limits holds, in every mode and on every device; newtons, infinity: there is none.
struct ForceLimit
{
  double device = std::numeric_limits<double>::infinity();  ///< Declared by the device.
  double user = std::numeric_limits<double>::infinity();    ///< ContactParameters::forceLimit.
  double program = std::numeric_limits<double>::infinity(); ///< ServoSettings::limits; at most 8 in a servo
                                                            ///< loop.

  double newtons() const noexcept;
  /// Name of the least limit: "device", "user" or "program"; "none". Of equal ones: device, program, user.
  const char* name() const noexcept;
  /// "2 N (device)", or "none".
  std::string text() const;
};

/// No servo loop pushes harder, N: the Falcon's drive ends near there. Virtual time has no such limit.
constexpr double kMostServoForce = 8.0;

/// The limit of a servo loop whose device has @p limits and whose own limit is @p program.
ForceLimit servoForceLimit(
  const HandLimits& limits, const ContactParameters& contact, const ForceLimits& program) noexcept;

} // namespace pointhaptics
