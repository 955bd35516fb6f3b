/// @file
/// Keeps a contact from giving the hand more energy than it took.
#pragma once

#include "Core/Base/Vector3.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{

/// The energy that the hand has put into the present contact. The energy stored in the spring that is felt,
/// |f|^2 / 2K, is kept at or below it: a surface that moves by itself, as among scattered points, cannot load
/// the spring. So a contact begins without a force, whatever its first depth, and returns no more than it
/// took and a tolerance of a tenth of a millijoule.
///
/// Work is counted by the trapezoid rule, force times way of the hand. An exact surface with a sampled spring
/// has no surplus by that count, and its forces pass unchanged, bit for bit. What a held force and the
/// device's delay add to any spring is bounded by PassivityLimit. Plain state; one thread.
class ContactEnergy
{
public:
  /// Joule that a contact may return beyond what it took: rounding and the curvature of the way within a
  /// tick. Without it spheres and tori of the test shapes lose force in the last digits.
  static constexpr double kSlack = 1e-6;
  /// A contact may return kTolerance of the work taken on top, and at most so many joule in all. Fits of a
  /// rough surface are no exact gradient of a distance: without this tolerance the force drifts some percent
  /// below the spring's while a hand slides over bare vertices.
  static constexpr double kTolerance = 0.01;
  static constexpr double kMostTolerance = 1e-4;

  void reset() noexcept { *this = ContactEnergy(); }

  /// Returns the largest part of @p wanted, 0 to 1, whose stored energy the hand has put in. @param before
  /// force of the last tick. @param wanted force of this one. @param moved way of the hand between them.
  double part(const Vec3& before, const Vec3& wanted, const Vec3& moved, double stiffness) const noexcept
  {
    // Solves a s^2 + b s <= c for the part s.
    const double a = 0.5 * norm2(wanted) / stiffness;
    const double b = 0.5 * dot(wanted, moved);
    const double c = taken_ - 0.5 * dot(before, moved);
    if (!(a + b > c))
    {
      return 1.0;
    }
    const double root2 = b * b + 4.0 * a * c;
    return root2 > 0.0 && a > 0.0 ? std::clamp((std::sqrt(root2) - b) / (2.0 * a), 0.0, 1.0) : 0.0;
  }

  /// Counts the work of a tick in which @p force was sent.
  void add(const Vec3& before, const Vec3& force, const Vec3& moved) noexcept
  {
    const double work = -0.5 * dot(before + force, moved);
    const double extra = std::clamp(kTolerance * work, 0.0, tolerance_);
    tolerance_ -= extra;
    taken_ = std::max(0.0, taken_ + work + extra);
  }

  /// Raises the allowed energy to what @p force stores now: work of the model, its scene or the parameters is
  /// no work of the hand.
  void allow(const Vec3& force, double stiffness) noexcept
  {
    taken_ = std::max(taken_, kSlack + 0.5 * norm2(force) / stiffness);
  }

private:
  double taken_ = kSlack;
  double tolerance_ = kMostTolerance;
};

} // namespace pointhaptics
