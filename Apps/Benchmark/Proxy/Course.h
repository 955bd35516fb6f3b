/// @file
/// Hands that move over shapes with exact answers, tick by tick at 1 kHz.
#pragma once

#include "Shapes/Shapes.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace proxy
{

constexpr double kTickSeconds = 1e-3;
constexpr double kTwoPi = 6.28318530717958647692;
constexpr double kSmallestMove = 1e-6; ///< Of a hand, metres: steps of force after less are not looked at.

/// HIP positions in metres, one a tick. The sheet's answer depends on the side the hand came from: courses
/// come from outside, above.
struct Course
{
  std::string name;
  std::vector<Vec3> hip;
  /// Ticks [loopBegin, loopBegin + loopTicks) are one turn of a closed path, and the hand is back where the
  /// turn began; 0 ticks: the path is not closed.
  std::size_t loopBegin = 0;
  std::size_t loopTicks = 0;
};

/// What a spring of @p stiffness N/m must answer at @p hip, for a hand that came from the upper or outer
/// side.
struct ExactContact
{
  Vec3 force;         ///< N; 0 in free space.
  Vec3 normal;        ///< Unit, outward.
  double depth = 0.0; ///< Metres below the surface; negative outside.
};
ExactContact exactContact(Shape shape, const Vec3& hip, double stiffness);

/// From outside to a closed course over the shape, and twice around it, 0.6 to 3 mm deep (0.1 to 0.7 mm on
/// the sheet) at 47 mm/s. @param scale zooms the shape and the way, not the depth or the speed.
Course slideCourse(Shape shape, double scale = 1.0);
/// Straight down onto one place to 3 mm, held, and out again, at 25 mm/s.
Course pressCourse(Shape shape);
/// Ten short taps, 1.5 mm deep, a slow roll of the hand under them.
Course tapCourse(Shape shape);
/// A circle of 4 mm radius at constant depth of 1 mm, 47 mm/s.
Course circleCourse(Shape shape);
/// Straight through and back along the normal at @p speed m/s, from 5 mm outside to 3 mm deep.
Course crossCourse(Shape shape, double speed, int start);
/// Along the surface at a constant depth of 1 mm and @p speed m/s, for friction.
Course frictionCourse(Shape shape, double speed, double travel);

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
