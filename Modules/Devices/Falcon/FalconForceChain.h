/// @file
/// Limits between a force and the Falcon's motors, whatever the rest of the program does.
#pragma once

#include "Devices/Falcon/FalconFrame.h"
#include "Devices/Falcon/FalconKinematics.h"

#include "Core/Base/Status.h"
#include "Haptics/Servo/ForceGuard.h"

#include <cstdint>

namespace pointhaptics
{

/// The limits that a FalconForceChain keeps to.
struct FalconForceLimits
{
  double maximumForce = 4.0;       ///< N at the grip, 0 to 8.
  double maximumTorque = 0.4096;   ///< N m at a joint, 0 to 0.4096: where the motor value ends.
  double maximumTorqueRate = 40.0; ///< N m/s of the vector of torques, growing only: full torque in 10 ms.
  double rampSeconds = 1.0;        ///< From no force to all of it after arming, homing or a fault; 1 to 60.

  /// Ok, or InvalidParameter where a value is outside its range.
  Status check() const noexcept;
};

/// Newtons to motor values, in this order:
/// 1. A force or a pose that is not finite gives zero and restarts the ramp.
/// 2. Not homed or not armed: zero, and the ramp begins anew.
/// 3. Ramp: the force is multiplied by the time since arming over rampSeconds, at most 1.
/// 4. A force longer than maximumForce keeps its direction and gets that length.
/// 5. Torques by the Jacobian at the pose; a singular pose gives zero and restarts the ramp.
/// 6. Torques beyond maximumTorque are scaled together, so that the force keeps its direction.
/// 7. Slew: the torques grow by at most maximumTorqueRate; letting go is never delayed.
/// 8. Motor value = -10000 * torque, rounded, within +-4096.
/// Inside all limits and after the ramp the torques are those of the force bit for bit. One thread; no
/// allocation, lock or exception.
class FalconForceChain
{
public:
  /// @pre limits.check() == Ok; otherwise no force ever passes.
  explicit FalconForceChain(const FalconForceLimits& limits = {});

  /// @param force newtons on the hand, device frame. @param position metres, device frame, with its
  /// @p angles. @param dt seconds since the last call, above 0 (anything else counts as 0; more than 0.1 as
  /// 0.1). @return motor values to send now.
  std::array<std::int16_t, kFalconLegs> step(const Vec3& force, const Vec3& position,
    const FalconAngles& angles, bool homedAndArmed, double dt) noexcept;
  /// After anything unexpected: no force now, and the ramp begins anew.
  void restart() noexcept;

  /// Part of the force that the ramp lets through now, 0 to 1.
  double ramp() const noexcept { return ramp_; }
  /// Torques behind the last motor values, N m.
  const FalconAngles& torques() const noexcept { return torques_; }

private:
  FalconForceLimits limits_;
  ForceGuard force_;
  ForceGuard slew_;
  FalconAngles torques_{};
  double ramp_ = 0.0;
};

/// Motor value of a joint torque in N m, within +-4096.
std::int16_t falconMotorValue(double torque) noexcept;

} // namespace pointhaptics
