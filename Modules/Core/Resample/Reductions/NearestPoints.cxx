#include "Core/Resample/Reductions/NearestPoints.h"

#include "Core/Resample/Kernel/Loops.h"
#include "Core/Resample/Kernel/OrderedKey.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointhaptics::simd
{
namespace
{

/// -1, 0 or 1 where point @p a has the smaller value, the same values, or the larger one.
int compareValues(const AttributeView& view, std::int64_t a, std::int64_t b)
{
  int order = 0;
  withType(view.type,
    [&](auto example)
    {
      using T = decltype(example);
      for (int c = 0; c < view.components && order == 0; ++c)
      {
        T ofA;
        T ofB;
        std::memcpy(&ofA, view.tuple(a) + c * std::int64_t(sizeof(T)), sizeof(T));
        std::memcpy(&ofB, view.tuple(b) + c * std::int64_t(sizeof(T)), sizeof(T));
        order = int(orderedKey(ofB) < orderedKey(ofA)) - int(orderedKey(ofA) < orderedKey(ofB));
      }
    });
  return order;
}

const void* addressOf(const PointView& points, std::int64_t i)
{
  return points.floats() ? static_cast<const void*>(points.floats() + points.stride() * i)
                         : points.doubles() + points.stride() * i;
}

}

NearestPoints::NearestPoints(const VoxelRequest& request, int fractionBits)
  : request_(&request)
  , toMean_(request.representative == Representative::NearestToMean)
  , isIdentity_(request.transform.isIdentity())
  , middle_(std::ldexp(0.5, fractionBits))
{
  const Vec3& spacing = request.lattice.spacing;
  scale_ = spacing / std::max({ spacing.x, spacing.y, spacing.z });
}

inline Vec3 NearestPoints::placeOf(std::int64_t point) const
{
  const Vec3 p = request_->points[point];
  return isIdentity_ ? p : request_->transform.apply(p);
}

bool NearestPoints::goesBefore(std::int64_t a, std::int64_t b) const
{
  const Vec3 ofA = placeOf(a);
  const Vec3 ofB = placeOf(b);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (ofA[axis] != ofB[axis])
    {
      return ofA[axis] < ofB[axis];
    }
  }
  for (const AttributeView& values : request_->tieBreakers)
  {
    const int order = compareValues(values, a, b);
    if (order != 0)
    {
      return order < 0;
    }
  }
  return a < b;
}

void NearestPoints::write(VoxelWriter& writer, std::size_t first) const
{
  constexpr std::size_t kAhead = 32;
  for (std::size_t v = 0; v < size_; ++v)
  {
    fetch(addressOf(request_->points, nearest_[std::min(v + kAhead, size_ - 1)].point));
    writer.setPoint(first + v, placeOf(nearest_[v].point));
    writer.chosen()[first + v] = nearest_[v].point;
  }
}

} // namespace pointhaptics::simd
