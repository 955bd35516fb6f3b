/// @file
/// What a servo loop drives: a hand position in, a force out.
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
  /// The position was found anew (homing, a jump, another connection): the hand did not move there from the
  /// one before, and is taken as in free space.
  bool isNew = false;
};

/// Implemented by HapticDevice (Modules/Devices). Called from the servo thread only, between start and stop.
class HapticPort
{
public:
  virtual ~HapticPort() = default;
  /// The hand at @p timeSeconds of the servo clock. Must not wait longer than a tick.
  /// Ok, EndOfPath (the loop stops), DeviceNotReady (no position yet: the loop sends zero force and goes on),
  /// or a fault (the same, and the loop counts it).
  virtual Status read(double timeSeconds, HandState& state) noexcept = 0;
  /// Force on the hand in newtons, workspace frame; finite and within the limits of the ForceGuard.
  virtual Status write(double timeSeconds, const Vec3& force) noexcept = 0;
  /// Limits that the loop must keep to, constant in time. Asked by the thread that starts the loop or sets
  /// its parameters. Default: a hand that nothing moves, without any limit.
  virtual HandLimits limits() const noexcept { return {}; }
  /// N that the device declares, above 0; as HandLimits::maximumForce, of which the lesser one counts.
  virtual double maximumForce() const noexcept { return std::numeric_limits<double>::infinity(); }
  /// Servo thread. Whether the loop may idle while the hand stands still in free space: true only where
  /// nobody can tell that an answer came a fiftieth of a second late. Default: no.
  virtual bool mayIdle() const noexcept { return false; }
  /// For those who point to the port without owning it.
  const Lifetime& lifetime() const noexcept { return lifetime_; }

private:
  Lifetime lifetime_;
};

} // namespace pointhaptics
