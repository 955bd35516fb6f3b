/// @file
/// Hands that move over shapes with exact answers, tick by tick at 1 kHz.
#pragma once

#include "Shapes/Shapes.h"

#include <cstddef>
#include <vector>

namespace pointhaptics::bench::proxy
{

constexpr double kTickSeconds = 1e-3;
constexpr double kTwoPi = 6.28318530717958647692;
constexpr double kSmallestMove =
  1e-6; ///< Metres of a hand's way below which a step of the force is not looked at.

/// HIP positions in metres, one a tick. The sheet's answer depends on the side the hand came from: courses
/// come from outside, above.
struct Course
{
  std::vector<Vec3> hip;
  /// Ticks [loopBegin, loopBegin + loopTicks) are one turn of a closed path, and the hand is back where the
  /// turn began; 0 ticks: the path is not closed.
  std::size_t loopBegin = 0;
  std::size_t loopTicks = 0;
};

/// The answer of a spring of @p stiffness N/m at @p hip, for a hand that came from the upper or outer
/// side.
struct ExactContact
{
  Vec3 force;         ///< N; 0 in free space.
  Vec3 normal;        ///< Unit, outward.
  double depth = 0.0; ///< Metres below the surface; negative outside.
};
ExactContact exactContact(Shape shape, const Vec3& hip, double stiffness);

/// From outside to a closed course over the shape, and twice around it, 0.6 to 3 mm deep (0.1 to 0.7 mm on
/// the sheet) at 47 mm/s.
Course slideCourse(Shape shape);
/// Along the surface at a constant depth of 1 mm and @p speed m/s, for friction.
Course frictionCourse(Shape shape, double speed, double travel);

} // namespace pointhaptics::bench::proxy
