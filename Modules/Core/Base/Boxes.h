/// @file
/// Tests of points against boxes, and of coordinates that are no place.
#pragma once

#include "Core/Base/PointView.h"

#include <cstdint>

namespace pointhaptics
{

/// True if the ball lies in @p box, its surface included. False for an empty box, and where a number is NaN.
inline bool containsBall(const Bounds& box, const Vec3& center, double radius) noexcept
{
  bool result = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    result =
      result && center[axis] - radius >= box.minimum[axis] && center[axis] + radius <= box.maximum[axis];
  }
  return result;
}

inline bool contains(const Bounds& box, const Vec3& p) noexcept
{
  return containsBall(box, p, 0.0);
}

/// @p box with @p margin more on each side.
inline Bounds grown(const Bounds& box, double margin) noexcept
{
  const Vec3 by(margin, margin, margin);
  Bounds result = box;
  result.minimum -= by;
  result.maximum += by;
  return result;
}

/// True for the origin, at which scanners write rays that did not return. Squares of denormals are 0.
inline bool isAtZero(const Vec3& p) noexcept
{
  return p.x == 0.0 && p.y == 0.0 && p.z == 0.0;
}

/// True if @p atZero of @p finite points stand for rays that did not return: one may well be a point, and all
/// are better than nothing.
inline bool areNoReturns(std::int64_t atZero, std::int64_t finite) noexcept
{
  return atZero > 1 && atZero < finite;
}

/// The box that lies in both; empty where they do not meet.
inline Bounds intersection(const Bounds& a, const Bounds& b) noexcept
{
  Bounds result;
  for (int axis = 0; axis < 3; ++axis)
  {
    result.minimum[axis] = a.minimum[axis] > b.minimum[axis] ? a.minimum[axis] : b.minimum[axis];
    result.maximum[axis] = a.maximum[axis] < b.maximum[axis] ? a.maximum[axis] : b.maximum[axis];
  }
  return result;
}

/// The smallest box about the places where @p map takes the corners of @p box.
template <typename Map>
Bounds boxOfCorners(const Bounds& box, const Map& map)
{
  Bounds result;
  for (int corner = 0; corner < 8; ++corner)
  {
    result.include(map({ corner & 1 ? box.maximum.x : box.minimum.x,
      corner & 2 ? box.maximum.y : box.minimum.y, corner & 4 ? box.maximum.z : box.minimum.z }));
  }
  return result;
}

} // namespace pointhaptics
