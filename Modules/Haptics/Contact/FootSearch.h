/// @file
/// How far to go towards a foot point that moves as one comes nearer.
#pragma once

namespace pointhaptics
{

/// A fit changes with its origin, so the foot of a target on it lies further, or less far, than where rounds
/// of fit and foot end. This learns from round to round, by Broyden's method, what of the way to go; what it
/// learned serves the next target too. Lengths in the plane of the fit's tangents. Plain state; one thread;
/// nothing allocates or throws.
class FootSearch
{
public:
  struct Way
  {
    double a = 0.0;
    double b = 0.0;
  };

  /// Forgets what it learned: to go is the way to the foot.
  void reset() noexcept { *this = FootSearch(); }
  /// The way to go where the foot is @p left away.
  Way wayFor(const Way& left) noexcept;
  /// Having gone @p went, what is left is less by @p less.
  void learn(const Way& went, const Way& less) noexcept;

private:
  Way along(const Way& way) const noexcept
  {
    return { gain_[0] * way.a + gain_[1] * way.b, gain_[2] * way.a + gain_[3] * way.b };
  }

  double gain_[4] = { 1.0, 0.0, 0.0, 1.0 }; ///< Maps the remaining way to the way to go; two rows.
};

} // namespace pointhaptics
