/// @file
/// Geometry of the Falcon's three legs: from joint angles to the grip and back, from forces to torques.
#pragma once

#include "Core/Base/Vector3.h"

#include <array>

namespace pointhaptics
{

/// One number per leg.
using FalconAngles = std::array<double, 3>;

/// Frame of the device: origin in the middle of the base, x right, y up, z out of the base towards the
/// person; metres, radians, newtons, newton metres. Pure functions; no allocation, bounded work.
///
/// Each leg closes a loop: with the position turned into the leg's frame and shifted by the base's radius,
///   U = u + c - a cos(theta),  V = v + f,  W = w - a sin(theta),
///   (sqrt(U^2 + W^2) - (d + e))^2 + V^2 = b^2.
/// That is a torus about the end of the upper arm, so angles follow from a position in closed form and a
/// position from angles by Newton's method on the three equations; the Jacobian comes from the same
/// gradients.
namespace falcon
{

/// Middle of the workspace in the device frame, metres: of the 10 cm cube about it 98.7 % can be reached.
constexpr Vec3 kCenter(0.0, 0.0, 0.12);

/// Counts of the motor's encoder per radian of the joint (the drum gears 110 : 14.25).
double countsPerRadian() noexcept;
FalconAngles anglesFromCounts(const std::array<double, 3>& counts) noexcept;

/// Joint angles that put the grip at @p position. False: it is out of reach; @p angles is then unchanged.
/// Exact up to rounding: forward() leads back to within 1e-12 m (FalconKinematicsTest).
bool inverse(const Vec3& position, FalconAngles& angles) noexcept;

/// Position of the grip for @p angles, by Newton's method from @p guess (the last position, or
/// kCenter), 12 steps at most. False: no convergence to 1e-12 m, a singular pose, or an angle
/// outside -50 to 140 degrees; @p position is then unchanged.
bool forward(const FalconAngles& angles, const Vec3& guess, Vec3& position) noexcept;

/// Rows: d(position) / d(angle i), metres per radian: derivative i is jacobian[i]. False where the pose is
/// singular.
bool jacobian(const Vec3& position, const FalconAngles& angles, std::array<Vec3, 3>& derivatives) noexcept;

/// Joint torques that push the hand with @p force: torque_i = force . d(position)/d(angle_i), the principle
/// of virtual work. False where the pose is singular; @p torques is then unchanged.
bool torques(
  const Vec3& position, const FalconAngles& angles, const Vec3& force, FalconAngles& torques) noexcept;

} // namespace falcon
} // namespace pointhaptics
