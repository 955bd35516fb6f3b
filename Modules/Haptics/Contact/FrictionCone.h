/// @file
/// Coulomb friction as a cone about the normal at the contact point.
#pragma once

#include "Haptics/HapticParameters.h"

#include "Core/Base/Vector3.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{

/// The contact point sticks while the spring's pull along the surface is within mu_s times its pull across
/// it. Else it slides to where the ratio is mu_d. On a curved surface the normal is that of the contact
/// point. Plain state; one thread.
class FrictionCone
{
public:
  /// Out of contact: the next contact point is the foot.
  void reset() noexcept { touched_ = false; }
  /// Carries the contact point along with the model.
  template <typename Change>
  void carry(const Change& change) noexcept
  {
    contact_ = change.apply(contact_);
  }

  /// @param foot the point nearest to @p hip on the surface, and @p normal there, unit. @param depth of the
  /// hip below it, metres. @param uncertain without friction, metres by which noise lets the foot move though
  /// the surface does not: a contact point so near stays, so that a hand at rest feels a spring to a fixed
  /// point, and forces that are no gradient cannot drive it in circles. @param along receives (tangent offset
  /// from the foot, point, normal): the surface there.
  /// @return the contact point.
  template <typename Surface>
  Vec3 contactPoint(const ContactParameters& parameters, const Vec3& foot, const Vec3& normal, double depth,
    double uncertain, const Vec3& hip, Surface&& along) noexcept
  {
    const bool isFirst = !touched_;
    touched_ = true;
    if (isFirst || !(parameters.staticFriction > 0.0))
    {
      // The first foot point: friction has nothing to hold yet.
      sticking_ = isFirst || sticking_;
      const Vec3 lag = contact_ - foot;
      const double length = norm(lag);
      contact_ = isFirst || !(uncertain > 0.0) ? foot
        : length > uncertain                   ? foot + (uncertain / length) * lag
                                               : contact_;
      return contact_;
    }
    const Vec3 offset = contact_ - foot;
    const Vec3 tangential = offset - dot(offset, normal) * normal;
    const double length = norm(tangential);
    Vec3 up;
    along(tangential, contact_, up);
    const double hold = sticking_ ? parameters.staticFriction : parameters.dynamicFriction;
    sticking_ = pullRatio(contact_ - hip, up) <= hold;
    if (sticking_ || !(length > 0.0))
    {
      return contact_;
    }
    // The ratio is nearly proportional to the distance from the foot.
    double slide = std::min(length, parameters.dynamicFriction * std::max(0.0, depth));
    for (int round = 0; round < kRounds; ++round)
    {
      along((slide / length) * tangential, contact_, up);
      const double ratio = pullRatio(contact_ - hip, up);
      if (!(ratio > 0.0))
      {
        break;
      }
      slide = std::clamp(slide * parameters.dynamicFriction / ratio, 0.0, length);
    }
    along((slide / length) * tangential, contact_, up);
    return contact_;
  }

private:
  static constexpr int kRounds = 4;

  /// Ratio of a spring's pull along the surface to its pull across it; infinite where nothing presses.
  static double pullRatio(const Vec3& pull, const Vec3& normal) noexcept
  {
    const double across = dot(pull, normal);
    const double along = norm(pull - across * normal);
    return across > 0.0 ? along / across : along > 0.0 ? INFINITY : 0.0;
  }

  Vec3 contact_;
  bool touched_ = false;
  bool sticking_ = false;
};

} // namespace pointhaptics
