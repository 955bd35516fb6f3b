/// @file
/// Step length towards a foot point that moves while one approaches it.
#pragma once

namespace pointhaptics
{

/// A fit changes with its origin. So the foot that one fit shows is not the place where rounds of fit and
/// step end. This class learns by Broyden's method how far to go, from round to round; the next target
/// profits too. Lengths in the plane of the fit's tangents. Plain state; one thread; nothing allocates or
/// throws.
class FootSearch
{
public:
  struct Way
  {
    double a = 0.0;
    double b = 0.0;
  };

  /// Forgets all it learned: the way to go is then the way to the foot.
  void reset() noexcept { *this = FootSearch(); }
  /// Returns the way to go if the fit shows the foot @p left away.
  Way wayFor(const Way& left) noexcept;
  /// Learns that a step by @p went brought the foot nearer by @p less.
  void learn(const Way& went, const Way& less) noexcept;

private:
  Way along(const Way& way) const noexcept
  {
    return { gain_[0] * way.a + gain_[1] * way.b, gain_[2] * way.a + gain_[3] * way.b };
  }

  double gain_[4] = { 1.0, 0.0, 0.0, 1.0 }; ///< Maps the remaining way to the way to go; two rows.
};

} // namespace pointhaptics
