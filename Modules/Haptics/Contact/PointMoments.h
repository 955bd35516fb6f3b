/// @file
/// Count, mean and covariance of a few points.
#pragma once

#include "Core/Base/Vector3.h"

namespace pointhaptics
{

/// Sums over the offsets of points from one place.
struct PointMoments
{
  double count = 0.0;
  Vec3 sum;
  SymMat3 squares;

  void add(const Vec3& offset) noexcept
  {
    count += 1.0;
    sum += offset;
    squares += outerProduct(offset);
  }
  Vec3 mean() const noexcept { return count > 0.0 ? sum / count : Vec3(); }
  SymMat3 covariance() const noexcept
  {
    SymMat3 result = squares;
    result *= count > 0.0 ? 1.0 / count : 0.0;
    SymMat3 middle = outerProduct(mean());
    middle *= -1.0;
    result += middle;
    return result;
  }
};

} // namespace pointhaptics
