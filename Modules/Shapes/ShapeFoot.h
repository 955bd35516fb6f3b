/// @file
/// Nearest points of the simple shapes, one function each; sizes as in Shapes.h. Internal to Core.
#pragma once

#include "Shapes/Shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pointhaptics
{
namespace detail
{

constexpr double kPlaneHalf = 0.04;
constexpr double kSphereRadius = 0.025;
constexpr double kTorusRing = 0.025;
constexpr double kTorusTube = 0.010;
constexpr double kEllipsoidAxes[3] = { 0.040, 0.025, 0.018 };
constexpr double kSaddleHalf = 0.03;
constexpr double kSaddleLength = 0.1;
constexpr double kBoxHalf = 0.025;
constexpr double kEdgeWidth = 0.04;
constexpr double kSheetHalf = 0.03;
constexpr double kSheetHalfThickness = 0.0004;
constexpr double kHoleRadius = 0.010;

inline SurfacePoint footOn(const Vec3& position, const Vec3& point, const Vec3& normal, bool inside)
{
  const double distance = norm(position - point);
  return { point, normal, inside ? -distance : distance };
}

inline SurfacePoint planeFoot(const Vec3& p)
{
  const Vec3 foot{ std::clamp(p.x, -kPlaneHalf, kPlaneHalf), std::clamp(p.y, -kPlaneHalf, kPlaneHalf), 0.0 };
  return footOn(p, foot, { 0.0, 0.0, 1.0 }, p.z < 0.0);
}

inline SurfacePoint sphereFoot(const Vec3& p)
{
  const Vec3 normal = normalized(p);
  return { kSphereRadius * normal, normal, norm(p) - kSphereRadius };
}

inline SurfacePoint torusFoot(const Vec3& p)
{
  const double radial = std::hypot(p.x, p.y);
  const Vec3 outwards = radial > 0.0 ? Vec3{ p.x / radial, p.y / radial, 0.0 } : Vec3{ 1.0, 0.0, 0.0 };
  const Vec3 fromRing = p - kTorusRing * outwards;
  const Vec3 normal = normalized(fromRing, outwards);
  return { kTorusRing * outwards + kTorusTube * normal, normal, norm(fromRing) - kTorusTube };
}

/// Root of the secular equation of Eberly, "Distance from a Point to an Ellipse, an Ellipsoid, or a
/// Hyperellipsoid": foot_i = a_i^2 p_i / (t + a_i^2). The sum falls and is convex right of -c^2: Newton from
/// the left cannot overshoot.
inline SurfacePoint ellipsoidFoot(const Vec3& p)
{
  const auto& a = kEllipsoidAxes;
  const double c2 = a[2] * a[2];
  double t = -c2 + a[2] * std::abs(p.z);
  Vec3 foot;
  bool onRim = p.z == 0.0;
  if (onRim)
  {
    // The root may lie left of -c^2: then the foot leaves the plane z = 0.
    foot = { a[0] * a[0] * p.x / (a[0] * a[0] - c2), a[1] * a[1] * p.y / (a[1] * a[1] - c2), 0.0 };
    const double left = 1.0 - foot.x * foot.x / (a[0] * a[0]) - foot.y * foot.y / (a[1] * a[1]);
    onRim = left > 0.0;
    foot.z = onRim ? a[2] * std::sqrt(left) : 0.0;
  }
  for (int round = 0; round < 100 && !onRim; ++round)
  {
    double value = -1.0, slope = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double denominator = t + a[axis] * a[axis];
      const double ratio = p[axis] == 0.0 ? 0.0 : a[axis] * p[axis] / denominator;
      value += ratio * ratio;
      slope -= p[axis] == 0.0 ? 0.0 : 2.0 * ratio * ratio / denominator;
      foot[axis] = p[axis] == 0.0 ? 0.0 : a[axis] * ratio;
    }
    const double next = t - value / slope;
    if (!(next > t))
    {
      break;
    }
    t = next;
  }
  const Vec3 normal =
    normalized(Vec3{ foot.x / (a[0] * a[0]), foot.y / (a[1] * a[1]), foot.z / (a[2] * a[2]) });
  return footOn(p, foot, normal, dot(p - foot, normal) < 0.0);
}

/// The saddle's nearest point, x and y free or held at the rim. With t = (z - p.z)/k: x = p.x/(1 + 2t),
/// y = p.y/(1 - 2t), and the surface's equation rises in t between the poles: one root, bracketed,
/// safeguarded Newton.
inline Vec3 saddleStationary(const Vec3& p, bool freeX, bool freeY)
{
  const double k = kSaddleLength;
  const double px = std::abs(p.x), py = std::abs(p.y), rim = kSaddleHalf;
  double low = freeX ? -0.5 : -(std::abs(p.z) + rim) / k - 1.0;
  double high = freeY ? 0.5 : (std::abs(p.z) + rim + px * px) / k + 1.0;
  double t = std::clamp(-p.z / k, 0.9 * low, 0.9 * high);
  double x = 0.0, y = 0.0;
  for (int round = 0; round < 200; ++round)
  {
    const double u = 1.0 + 2.0 * t, v = 1.0 - 2.0 * t;
    x = freeX ? px / u : rim;
    y = freeY ? py / v : rim;
    const double value = p.z + k * t - (x * x - y * y) / k;
    const double slope = k + ((freeX ? 4.0 * x * x / u : 0.0) + (freeY ? 4.0 * y * y / v : 0.0)) / k;
    (value < 0.0 ? low : high) = t;
    double next = t - value / slope;
    if (!(next > low && next < high))
    {
      next = 0.5 * (low + high);
    }
    if (std::abs(next - t) <= 1e-17)
    {
      break;
    }
    t = next;
  }
  x = std::min(x, rim);
  y = std::min(y, rim);
  // At a pole (p on the other coordinate's plane, far from the surface) the equation gives the coordinate
  // left open.
  const double z = p.z + k * t;
  if (freeX && px == 0.0 && t < -0.5 + 1e-12)
  {
    x = std::sqrt(std::clamp(k * z + y * y, 0.0, rim * rim));
  }
  if (freeY && py == 0.0 && t > 0.5 - 1e-12)
  {
    y = std::sqrt(std::clamp(x * x - k * z, 0.0, rim * rim));
  }
  return { std::copysign(x, p.x), std::copysign(y, p.y), (x * x - y * y) / k };
}

inline SurfacePoint saddleFoot(const Vec3& p)
{
  // By symmetry the nearest point lies in the quadrant of p, where each of these is the only candidate of its
  // kind.
  Vec3 foot = saddleStationary(p, true, true);
  if (std::abs(foot.x) >= kSaddleHalf || std::abs(foot.y) >= kSaddleHalf)
  {
    const Vec3 rimX = saddleStationary(p, false, true);
    const Vec3 rimY = saddleStationary(p, true, false);
    foot = norm2(p - rimX) < norm2(p - rimY) ? rimX : rimY;
  }
  const Vec3 normal = normalized(Vec3{ -2.0 * foot.x / kSaddleLength, 2.0 * foot.y / kSaddleLength, 1.0 });
  return footOn(p, foot, normal, p.z < (p.x * p.x - p.y * p.y) / kSaddleLength);
}

inline SurfacePoint boxFoot(const Vec3& p)
{
  Vec3 foot;
  int nearestFace = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    foot[axis] = std::clamp(p[axis], -kBoxHalf, kBoxHalf);
    nearestFace = std::abs(p[axis]) > std::abs(p[nearestFace]) ? axis : nearestFace;
  }
  Vec3 faceNormal;
  faceNormal[nearestFace] = std::copysign(1.0, p[nearestFace]);
  if (foot != p)
  {
    return footOn(p, foot, normalized(p - foot, faceNormal), false);
  }
  foot[nearestFace] = std::copysign(kBoxHalf, p[nearestFace]);
  return footOn(p, foot, faceNormal, true);
}

inline SurfacePoint edgeFoot(const Vec3& p)
{
  const double y = std::clamp(p.y, -kPlaneHalf, kPlaneHalf);
  const Vec3 top{ std::clamp(p.x, -kEdgeWidth, 0.0), y, 0.0 };
  const Vec3 side{ 0.0, y, std::clamp(p.z, -kEdgeWidth, 0.0) };
  const bool inside = p.x < 0.0 && p.z < 0.0;
  if (p.x > 0.0 && p.z > 0.0)
  {
    return footOn(p, top, normalized(Vec3{ p.x, 0.0, p.z }), false);
  }
  return norm2(p - top) <= norm2(p - side) ? footOn(p, top, { 0.0, 0.0, 1.0 }, inside)
                                           : footOn(p, side, { 1.0, 0.0, 0.0 }, inside);
}

inline SurfacePoint sheetFoot(const Vec3& p)
{
  const double up = p.z >= 0.0 ? 1.0 : -1.0;
  const Vec3 foot{ std::clamp(p.x, -kSheetHalf, kSheetHalf), std::clamp(p.y, -kSheetHalf, kSheetHalf),
    up * kSheetHalfThickness };
  return footOn(p, foot, { 0.0, 0.0, up }, std::abs(p.z) < kSheetHalfThickness);
}

inline SurfacePoint holeFoot(const Vec3& p)
{
  const double radial = std::hypot(p.x, p.y);
  if (radial >= kHoleRadius)
  {
    return planeFoot(p);
  }
  const Vec3 outwards = radial > 0.0 ? Vec3{ p.x / radial, p.y / radial, 0.0 } : Vec3{ 1.0, 0.0, 0.0 };
  return footOn(p, kHoleRadius * outwards, { 0.0, 0.0, 1.0 }, p.z < 0.0);
}

} // namespace detail
} // namespace pointhaptics
