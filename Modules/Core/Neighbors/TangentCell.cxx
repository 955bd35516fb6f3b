#include "Core/Neighbors/TangentCell.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// Part of the half way that a corner may be short of it.
constexpr double kNearlyHalf = 0.03;

}

TangentCell::TangentCell(const Vec3& normal, double largest)
  : u_(anyPerpendicular(normal))
  , v_(cross(normal, u_))
  , largest_(largest)
  , farthest2_(2.0 * largest * largest)
  , corners_{ { largest, largest }, { -largest, largest }, { -largest, -largest }, { largest, -largest } }
{
}

bool TangentCell::add(const Vec3& place)
{
  const double x = dot(place, u_);
  const double y = dot(place, v_);
  const double half = 0.5 * (x * x + y * y);
  // The line half way lies beyond all corners, and where it is of a place farther away, too.
  if (0.25 * norm2(place) >= farthest2_)
  {
    return false;
  }
  double beyond[kMostCorners];
  bool cuts = false;
  for (int i = 0; i < count_; ++i)
  {
    beyond[i] = corners_[i].x * x + corners_[i].y * y - half;
    cuts = cuts || beyond[i] > 0.0;
  }
  if (!cuts || half <= 0.0 || count_ + 2 > kMostCorners)
  {
    return true;
  }
  Corner kept[kMostCorners];
  int count = 0;
  farthest2_ = 0.0;
  const auto keep = [&](double cx, double cy)
  {
    kept[count++] = { cx, cy };
    farthest2_ = std::max(farthest2_, cx * cx + cy * cy);
  };
  for (int i = 0; i < count_; ++i)
  {
    const int next = i + 1 < count_ ? i + 1 : 0;
    if (beyond[i] <= 0.0)
    {
      keep(corners_[i].x, corners_[i].y);
    }
    if ((beyond[i] <= 0.0) != (beyond[next] <= 0.0))
    {
      const double t = beyond[i] / (beyond[i] - beyond[next]);
      keep(corners_[i].x + t * (corners_[next].x - corners_[i].x),
        corners_[i].y + t * (corners_[next].y - corners_[i].y));
    }
  }
  count_ = count;
  std::copy_n(kept, count, corners_);
  return true;
}

double TangentCell::farthestCorner(Vec3& place) const
{
  double most2 = 0.0;
  for (int i = 0; i < count_; ++i)
  {
    const Vec3 corner = corners_[i].x * u_ + corners_[i].y * v_;
    place = norm2(corner) > most2 ? corner : place;
    most2 = std::max(most2, norm2(corner));
  }
  return std::sqrt(most2);
}

double TangentCell::reach() const
{
  return farthest2_ < largest_ * largest_ * (1.0 - 1e-12) ? std::sqrt(farthest2_) : 0.0;
}

bool TangentCell::touches(const Vec3& place) const
{
  const double x = dot(place, u_);
  const double y = dot(place, v_);
  const double half = 0.5 * (x * x + y * y);
  return half > 0.0 &&
    std::any_of(corners_, corners_ + count_,
      [&](const Corner& corner) { return corner.x * x + corner.y * y > (1.0 - kNearlyHalf) * half; });
}

} // namespace pointhaptics
