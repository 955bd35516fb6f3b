/// @file
/// The flat place that the proxy's ball lies on.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Haptics/Contact/BallCells.h"
#include "Haptics/HapticScene.h"

namespace pointhaptics
{

/// A plane through the points about a ball, kept while the ball is near. Beside an edge the points show two
/// faces, but the ball still lies on the first. Lattice frame, metres. Plain state; one thread; nothing
/// allocates or throws.
class FlatPlace
{
public:
  /// Fits the plane. @param center of the ball. @param radius of the ball. @param reach of the points that
  /// count, from the center. @param away receives the direction from their middle to the ball. False: they
  /// are not flat, and nothing changes.
  bool find(const BallCells& cells, const Vec3& center, double radius, double reach, Vec3& away) noexcept;
  /// Sets the plane through @p point with the unit normal @p normal, under a ball at @p center.
  void set(const Vec3& point, const Vec3& normal, const Vec3& center) noexcept
  {
    point_ = point;
    normal_ = normal;
    foundAt_ = center;
    isKnown_ = true;
  }

  void invalidate() noexcept { isKnown_ = false; }
  /// Moves the place with the model.
  void carry(const AffineTransform& change) noexcept;

  bool isKnown() const noexcept { return isKnown_; }
  /// True if the place is known and was found with the center within @p distance of @p center.
  bool isNear(const Vec3& center, double distance) const noexcept
  {
    return isKnown_ && norm2(center - foundAt_) <= distance * distance;
  }
  /// Unit normal, to the ball's side. @pre known
  const Vec3& normal() const noexcept { return normal_; }
  /// Height of @p p above the plane. @pre known
  double height(const Vec3& p) const noexcept { return dot(p - point_, normal_); }
  /// @p v without its part along the normal. @pre known
  Vec3 along(const Vec3& v) const noexcept { return v - dot(v, normal_) * normal_; }
  /// True if a point of the plane lies near the foot of @p hip in the direction of @p slipped, the place to
  /// which bumps pushed a ball of @p radius. @pre known
  bool continuesUnder(
    const HapticScene& scene, const Vec3& hip, const Vec3& slipped, double radius) const noexcept;
  /// Length that a ball at @p center may go along the unit vector @p direction until it is @p most aside of
  /// @p hip. @pre known, and the ball is not so far aside yet
  double wayAside(const Vec3& center, const Vec3& hip, const Vec3& direction, double most) const noexcept;

private:
  Vec3 normal_;
  Vec3 point_;
  Vec3 foundAt_;
  bool isKnown_ = false;
};

} // namespace pointhaptics
