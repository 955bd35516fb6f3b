/// @file
/// A hand without hardware: a mass on a spring and a damper, which the mouse or a test pulls.
#pragma once

#include "Devices/HapticDevice.h"
#include "Devices/HipPath.h"

#include "Haptics/Servo/LatestValue.h"

#include <atomic>

namespace pointhaptics
{

/// Arm of a person holding the grip; figures of a relaxed grasp.
struct SimulatedHandSettings
{
  double mass = 0.1;            ///< kg, above 0.
  double gripStiffness = 200.0; ///< Stiffness between the person's target and the hand, N/m; above 0.
  double gripDamping = 9.0;     ///< N s/m, 0 or more; critical damping for the defaults.
  bool yieldsToForce = true;    ///< If false, the hand is exactly at its target, whatever the force.
  bool holdsAtEnd = false;      ///< After the end of its path the hand stays there; read() is Ok.
  Vec3 start;                   ///< Position at open(), metres; clamped to the workspace.
  Bounds workspace; ///< The hand and its targets stay in it; empty: the 10 cm cube about the origin.
};

/// m x'' = k (target - x) - c x' + f, with the force held from one write() to the next, as a real drive does.
/// Integrated by the implicit Euler rule in steps of at most 0.1 ms (at most 1000 of them a call): stable for
/// every spring, damper and rate; the trajectory is right to about 0.5 % of a step response with the default
/// settings (SimulatedDeviceTest asserts 1 %). The workspace has hard ends: position and speed are bounded
/// whatever the force.
///
/// The person's target comes from setTarget(), such as the mouse, or from a path (setPath()).
///
/// setTarget(), placeAt() and setButtons() may be called from one other thread at any time; neither side
/// waits for the other.
class SimulatedDevice : public HapticDevice
{
public:
  explicit SimulatedDevice(const SimulatedHandSettings& settings = {});

  /// "path" for a hand that is exactly where its path is.
  const char* name() const noexcept override;
  DeviceCapabilities capabilities() const noexcept override;
  /// Limits of the springs, by the grip's damping; none where the hand does not yield.
  HandLimits limits() const noexcept override;
  /// True unless a path moves the hand: a target that comes from the mouse is later than that.
  bool mayIdle() const noexcept override { return path_.points.empty(); }
  /// Makes the target follow @p path in servo time from the next open() on, its first point at time 0, in
  /// place of setTarget(); read() gives EndOfPath after its end. A hand that does not yield may go anywhere
  /// on it, one that does stays in the workspace. An empty path restores setTarget(). Not while open.
  void setPath(HipPath path);
  const HipPath& path() const noexcept { return path_; }
  /// Puts the hand at rest at settings.start (or at the path's first point), which is also the target.
  /// InvalidParameter: a setting out of its range, or a path that is none (HipPath::problem()).
  Status open() override;
  void close() override;
  /// Moves the hand to @p timeSeconds. A time that is not after the last one moves nothing.
  Status read(double timeSeconds, HandState& state) noexcept override;
  /// InvalidParameter: @p force is not finite; the hand then feels none.
  Status write(double timeSeconds, const Vec3& force) noexcept override;

  /// Sets the person's target, workspace frame, metres; one that is not finite is ignored.
  void setTarget(const Vec3& target) noexcept;
  /// Sets the target and moves the hand there by the next read(), at rest, without a way from where it was
  /// (HandState::isNew): nothing in between is touched.
  void placeAt(const Vec3& target) noexcept;
  /// The target in effect, after clamping. Any thread.
  Vec3 target() const noexcept { return target_.read(); }
  void setButtons(std::uint32_t buttons) noexcept { buttons_.store(buttons, std::memory_order_relaxed); }

private:
  void move(double seconds) noexcept;

  SimulatedHandSettings settings_;
  HipPath path_;
  std::size_t row_ = 0;
  LatestValue<Vec3> target_;
  std::atomic<std::uint32_t> buttons_{ 0 };
  std::atomic<std::uint32_t> placings_{ 0 }; ///< Number of calls of placeAt().
  std::uint32_t seenPlacings_ = 0;
  Vec3 lastTarget_;
  Vec3 position_;
  Vec3 velocity_;
  Vec3 force_;
  double lastTime_ = 0.0;
  bool timed_ = false; ///< True if lastTime_ is that of a read since open().
  bool open_ = false;
};

} // namespace pointhaptics
