/// @file
/// A valve for forces that closes and opens over time instead of at once.
#pragma once

namespace pointhaptics
{

/// The fraction of a force to let through, 0 to 1. One thread; no allocation.
class ForceGate
{
public:
  ForceGate() = default;
  /// @param closeSeconds from all to nothing. @param openSeconds from nothing to all. Negative or NaN: at
  /// once.
  ForceGate(double closeSeconds, double openSeconds) noexcept
    : close_(closeSeconds > 0.0 ? closeSeconds : 0.0)
    , open_(openSeconds > 0.0 ? openSeconds : 0.0)
  {
  }
  /// @param open where to move. @param dt seconds since the last call. @return the fraction now; exactly 1
  /// where the gate is open, exactly 0 where it is closed.
  double step(bool open, double dt) noexcept
  {
    const double duration = open ? open_ : close_;
    const double change = duration > 0.0 ? (dt > 0.0 ? dt / duration : 0.0) : 1.0;
    const double moved = open ? fraction_ + change : fraction_ - change;
    fraction_ = moved < kRounding ? 0.0 : moved > 1.0 - kRounding ? 1.0 : moved;
    return fraction_;
  }
  double fraction() const noexcept { return fraction_; }

private:
  /// A thousand steps of a thousandth are a whole.
  static constexpr double kRounding = 1e-9;
  double close_ = 0.0;
  double open_ = 0.0;
  double fraction_ = 1.0;
};

} // namespace pointhaptics
