#include "Devices/Falcon/FalconKinematics.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace falcon
{
namespace
{
constexpr double kPi = 3.14159265358979323846;
// Lengths of the legs, metres.
constexpr double kUpperArm = 0.060;       // a
constexpr double kLowerArm = 0.1025;      // b
constexpr double kGripRadius = 0.01443;   // c
constexpr double kHinges = 2.0 * 0.01125; // d + e
constexpr double kGripSide = -0.025;      // f
constexpr double kBaseRadius = 0.0400;    // r
constexpr double kBaseSide = -0.02309;    // s
constexpr double kEncoderZero = 35.0 * kPi / 180.0;
constexpr double kCountsPerTurn = 1280.0;
constexpr double kGear = 110.0 / 14.25;
constexpr int kMostSteps = 12;
constexpr double kConverged = 1e-12;
/// Longest step of Newton's method: the legs are a few centimetres long.
constexpr double kLongestStep = 0.03;
/// Range of a joint. A pose beyond it solves the equations, but the machine cannot take it.
constexpr double kLeastAngle = -50.0 * kPi / 180.0;
constexpr double kLargestAngle = 140.0 * kPi / 180.0;
/// Distance from the base beyond which the grip cannot be.
constexpr double kFarthest = 0.25;

/// cos and sin of 90 + 15, -30 + 15 and -150 + 15 degrees.
struct LegDirection
{
  double cosine;
  double sine;
};
const LegDirection kLegs[3] = { { std::cos(kPi * 105 / 180), std::sin(kPi * 105 / 180) },
  { std::cos(-kPi * 15 / 180), std::sin(-kPi * 15 / 180) },
  { std::cos(-kPi * 135 / 180), std::sin(-kPi * 135 / 180) } };

/// Turns a position into the frame of one leg.
Vec3 inLeg(const Vec3& p, const LegDirection& leg) noexcept
{
  return { p.x * leg.cosine + p.y * leg.sine - kBaseRadius, p.y * leg.cosine - p.x * leg.sine - kBaseSide,
    p.z };
}

/// Closure of one leg and its derivatives by the position (device frame) and by the angle.
struct Closure
{
  double value = 0.0;
  Vec3 byPosition;
  double byAngle = 0.0;
};

Closure closure(const Vec3& position, double angle, const LegDirection& leg) noexcept
{
  const Vec3 p = inLeg(position, leg);
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  const double u = p.x + kGripRadius - kUpperArm * cosine;
  const double v = p.y + kGripSide;
  const double w = p.z - kUpperArm * sine;
  const double h = std::hypot(u, w);
  const double q = h - kHinges;
  const double scale = 2.0 * q / h;
  Closure result;
  result.value = q * q + v * v - kLowerArm * kLowerArm;
  const double byU = scale * u;
  const double byV = 2.0 * v;
  result.byPosition = { byU * leg.cosine - byV * leg.sine, byU * leg.sine + byV * leg.cosine, scale * w };
  result.byAngle = scale * kUpperArm * (u * sine - w * cosine);
  return result;
}

struct Closures
{
  Closure leg[3];
  Vec3 cross[3]; ///< Cross product of the other two legs' gradients.
  double determinant = 0.0;
  bool singular = true;
};

Closures closures(const Vec3& position, const FalconAngles& angles) noexcept
{
  Closures result;
  for (int i = 0; i < 3; ++i)
  {
    result.leg[i] = closure(position, angles[std::size_t(i)], kLegs[i]);
  }
  double scale = 1.0;
  for (int i = 0; i < 3; ++i)
  {
    result.cross[i] =
      pointhaptics::cross(result.leg[(i + 1) % 3].byPosition, result.leg[(i + 2) % 3].byPosition);
    scale *= norm(result.leg[i].byPosition);
  }
  result.determinant = dot(result.leg[0].byPosition, result.cross[0]);
  // A part of the volume of three perpendicular gradients; NaN counts as singular.
  result.singular = !(std::abs(result.determinant) > 1e-3 * scale);
  return result;
}
}

double countsPerRadian() noexcept
{
  return kCountsPerTurn * kGear / (2.0 * kPi);
}

FalconAngles anglesFromCounts(const std::array<double, 3>& counts) noexcept
{
  FalconAngles angles;
  std::transform(counts.begin(), counts.end(), angles.begin(),
    [](double n) { return n / countsPerRadian() + kEncoderZero; });
  return angles;
}

bool inverse(const Vec3& position, FalconAngles& angles) noexcept
{
  FalconAngles result;
  for (int i = 0; i < 3; ++i)
  {
    const Vec3 p = inLeg(position, kLegs[i]);
    const double u = p.x + kGripRadius;
    const double v = p.y + kGripSide;
    // The lower arm's reach in the plane of the upper arm.
    const double reach2 = kLowerArm * kLowerArm - v * v;
    const double reach = kHinges + std::sqrt(std::max(0.0, reach2));
    const double distance = std::hypot(u, p.z);
    const double cosine =
      (distance * distance + kUpperArm * kUpperArm - reach * reach) / (2.0 * kUpperArm * distance);
    if (!(reach2 >= 0.0) || !(std::abs(cosine) <= 1.0))
    {
      return false;
    }
    result[std::size_t(i)] = std::atan2(p.z, u) - std::acos(cosine);
  }
  angles = result;
  return true;
}

bool forward(const FalconAngles& angles, const Vec3& guess, Vec3& position) noexcept
{
  for (double angle : angles)
  {
    if (!(angle >= kLeastAngle && angle <= kLargestAngle))
    {
      return false;
    }
  }
  Vec3 p = guess;
  for (int step = 0; step < kMostSteps; ++step)
  {
    const Closures all = closures(p, angles);
    if (all.singular)
    {
      return false;
    }
    Vec3 move;
    for (int i = 0; i < 3; ++i)
    {
      move -= all.leg[i].value / all.determinant * all.cross[i];
    }
    const double length = norm(move);
    p += length > kLongestStep ? kLongestStep / length * move : move;
    if (!(norm(p) < kFarthest))
    {
      return false;
    }
    if (length < kConverged)
    {
      position = p;
      return p.z > 0.0;
    }
  }
  return false;
}

bool jacobian(const Vec3& position, const FalconAngles& angles, std::array<Vec3, 3>& derivatives) noexcept
{
  const Closures all = closures(position, angles);
  if (all.singular)
  {
    return false;
  }
  for (int i = 0; i < 3; ++i)
  {
    derivatives[std::size_t(i)] = -all.leg[i].byAngle / all.determinant * all.cross[i];
  }
  return true;
}

bool torques(
  const Vec3& position, const FalconAngles& angles, const Vec3& force, FalconAngles& torques) noexcept
{
  std::array<Vec3, 3> derivatives;
  if (!jacobian(position, angles, derivatives))
  {
    return false;
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    torques[i] = dot(force, derivatives[i]);
  }
  return true;
}

} // namespace falcon
} // namespace pointhaptics
