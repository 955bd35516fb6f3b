/// @file
/// Force of an exact surface, for clouds that are samples of a known shape.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "Shapes/Shapes.h"

namespace pointhaptics
{

/// True if @p points are a sample of a shape as generateShape() draws it, in its own frame: the finite ones
/// of 1000 points spread over the cloud lie within 1 um of its surface. Of shapes with one surface the
/// plainest is named: the plane for the density step. False, and @p shape unchanged: of none, or there are no
/// points, or noise was added. Cost: below 0.1 s. Thread safe.
bool recognizeShape(const PointView& points, Shape& shape);

/// The spring K d of a hand d below the exact surface, on the side it came from; without friction and
/// damping. at() is called tick by tick in the order of time: it remembers the side. A hand that goes around
/// a rim changes its side. Of the sheet, which is thinner than a hand presses, nothing is known inside: NaN.
/// Not thread safe. Error: that of closestPoint(), times the scale.
class IdealForce
{
public:
  explicit IdealForce(Shape shape)
    : shape_(shape)
  {
  }

  /// Newtons, for a hand at @p hip (workspace, metres) and @p stiffness in N/m. @return NaN where
  /// @p modelToWorkspace is no turn, shift and even zoom, or the hand is not finite.
  double at(const Vec3& hip, const AffineTransform& modelToWorkspace, double stiffness) noexcept;

private:
  Shape shape_;
  double side_ = 0.0; // sign of the distance when the hand was free; 0: not seen yet
};

} // namespace pointhaptics
