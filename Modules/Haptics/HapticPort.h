/// @file
/// Interface of a servo loop to a device: a hand position in, a force out.
#pragma once

#include "Core/Base/Lifetime.h"
#include "Core/Base/Status.h"
#include "Core/Base/Vector3.h"
#include "Haptics/Servo/PassivityLimit.h"

#include <cstdint>
#include <limits>

namespace pointhaptics
{

/// One reading of the hand. Frame: workspace, metres; x right, y up, z towards the user.
struct HandState
{
  Vec3 position;
  std::uint32_t buttons = 0; ///< Bit i: button i pressed.
  /// True where the position was found anew (homing, a jump, another connection): the hand did not move
  /// there, and begins in free space.
  bool isNew = false;
};

/// Implemented by HapticDevice (Modules/Devices). Called from the servo thread only, between start and stop.
class HapticPort
{
public:
  virtual ~HapticPort() = default;
  /// Reads the hand at @p timeSeconds of the servo clock; must not wait longer than a tick. @return Ok,
  /// EndOfPath (the loop stops), DeviceNotReady (no position yet: the loop sends zero force and goes on), or
  /// a fault (the loop does that too, and counts it).
  virtual Status read(double timeSeconds, HandState& state) noexcept = 0;
  /// Sends a force in newtons, workspace frame; finite and within the limits of the ForceGuard.
  virtual Status write(double timeSeconds, const Vec3& force) noexcept = 0;
  /// Limits that the loop must keep to, constant in time. Asked by the thread that starts the loop or sets
  /// its parameters. Default: a hand that nothing moves, without any limit.
  virtual HandLimits limits() const noexcept { return {}; }
  /// Force that the device declares, N, above 0; the lesser of this and HandLimits::maximumForce counts.
  virtual double maximumForce() const noexcept { return std::numeric_limits<double>::infinity(); }
  /// True if the loop may idle while the hand stands still in free space, as nobody notices that an answer
  /// comes 20 ms late. Servo thread. Default: no.
  virtual bool mayIdle() const noexcept { return false; }
  /// Lifetime for those who point to the port without owning it.
  const Lifetime& lifetime() const noexcept { return lifetime_; }

private:
  Lifetime lifetime_;
};

} // namespace pointhaptics
