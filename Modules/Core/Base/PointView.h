/// @file
/// A non-owning view of coordinates: pointer, count and stride, float or double, x y z together.
#pragma once

#include "Core/Base/Vector3.h"

#include <cstdint>

namespace pointhaptics
{

/// Does not own. Safe to read from any number of threads while the memory it points at is not written.
class PointView
{
public:
  PointView() = default;
  /// @param stride numbers from one point's x to the next one's, at least 3: other fields may lie between.
  PointView(const double* xyz, std::int64_t count, std::int64_t stride = 3)
    : doubles_(xyz)
    , size_(count)
    , stride_(stride)
  {
  }
  PointView(const float* xyz, std::int64_t count, std::int64_t stride = 3)
    : floats_(xyz)
    , size_(count)
    , stride_(stride)
  {
  }
  PointView(const Vec3* points, std::int64_t count)
    : PointView(count ? &points->x : nullptr, count)
  {
  }
  std::int64_t size() const { return size_; }
  std::int64_t stride() const { return stride_; }
  /// The first point's coordinates; null where they are of the other type. The next ones are stride()
  /// further.
  const float* floats() const { return floats_; }
  const double* doubles() const { return doubles_; }
  /// @pre 0 <= i < size()
  Vec3 operator[](std::int64_t i) const
  {
    if (floats_)
    {
      const float* p = floats_ + stride_ * i;
      return { static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]) };
    }
    const double* p = doubles_ + stride_ * i;
    return { p[0], p[1], p[2] };
  }

private:
  const double* doubles_ = nullptr;
  const float* floats_ = nullptr;
  std::int64_t size_ = 0;
  std::int64_t stride_ = 3;
};
static_assert(sizeof(Vec3) == 3 * sizeof(double), "PointView reads Vec3 arrays as doubles");

/// Axis-aligned box; empty (minimum above maximum) by default.
struct Bounds
{
  Vec3 minimum{ INFINITY, INFINITY, INFINITY };
  Vec3 maximum{ -INFINITY, -INFINITY, -INFINITY };

  bool empty() const { return !(minimum.x <= maximum.x && minimum.y <= maximum.y && minimum.z <= maximum.z); }
  void include(const Vec3& p)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      minimum[axis] = p[axis] < minimum[axis] ? p[axis] : minimum[axis];
      maximum[axis] = p[axis] > maximum[axis] ? p[axis] : maximum[axis];
    }
  }
  Vec3 center() const { return 0.5 * minimum + 0.5 * maximum; }
  Vec3 extent() const { return maximum - minimum; }
};
inline bool operator==(const Bounds& a, const Bounds& b)
{
  return a.minimum == b.minimum && a.maximum == b.maximum;
}

} // namespace pointhaptics
