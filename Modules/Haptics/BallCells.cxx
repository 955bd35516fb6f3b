#include "Haptics/BallCells.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// How much further than asked for is gathered: a sliding hand then stays inside for some ticks.
constexpr double kMargin = 1.35;
/// Part of the radius by which a way may lead towards a touched point that it goes past: rounding.
constexpr double kTangential = 1e-6;

}

bool BallCells::add(const Vec3& p) noexcept
{
  const Vec3 local = p - center_;
  if (norm2(local) >= reach_ * reach_)
  {
    return true;
  }
  if (size_ == kCapacity)
  {
    return false;
  }
  x_[size_] = local.x;
  y_[size_] = local.y;
  z_[size_] = local.z;
  ++size_;
  return true;
}

bool BallCells::gatherFrom(const CellPyramid& pyramid, int level, bool onePerVoxel) noexcept
{
  const CellPyramid::Level& l = pyramid.level(level);
  bool fits = true;
  size_ = 0;
  if (!onePerVoxel)
  {
    pyramid.visitRuns(level, center_, reach_,
      [&](std::uint32_t first, std::uint32_t last)
      {
        for (std::uint32_t i = first; i < last && fits; ++i)
        {
          fits = add(l.cells[i].mean);
        }
      });
    return fits;
  }
  std::uint32_t lastVoxel = ~std::uint32_t(0);
  pyramid.visitRuns(level, center_, reach_,
    [&](std::uint32_t first, std::uint32_t last)
    {
      auto slot = std::upper_bound(l.slotBegin.begin(), l.slotBegin.end(), first) - l.slotBegin.begin() - 1;
      for (; l.slotBegin[std::size_t(slot)] < last && fits; ++slot)
      {
        lastVoxel = l.slotBegin[std::size_t(slot)];
        fits = add(l.cells[lastVoxel].mean);
      }
    });
  return fits;
}

bool BallCells::gather(
  const CellPyramid& pyramid, const Vec3& center, double radius, double coarsest) noexcept
{
  const double left = reach_ - radius;
  if (pyramid_ == &pyramid && left >= 0.0 && norm2(center - center_) <= left * left)
  {
    return complete_;
  }
  pyramid_ = &pyramid;
  center_ = center;
  reach_ = kMargin * radius;
  complete_ = gatherFrom(pyramid, 0, false) || gatherFrom(pyramid, 0, true);
  for (int level = 1;
       !complete_ && level < pyramid.numberOfCellLevels() && pyramid.level(level).voxelSize <= coarsest;
       ++level)
  {
    complete_ = gatherFrom(pyramid, level, false);
  }
  return complete_;
}

int BallCells::nearest(const Vec3& p, double& distance2) const noexcept
{
  const Vec3 local = p - center_;
  int best = -1;
  distance2 = INFINITY;
  for (int i = 0; i < size_; ++i)
  {
    const double dx = local.x - x_[i];
    const double dy = local.y - y_[i];
    const double dz = local.z - z_[i];
    const double d2 = dx * dx + dy * dy + dz * dz;
    if (d2 < distance2)
    {
      distance2 = d2;
      best = i;
    }
  }
  return best;
}

double BallCells::sweep(const Vec3& from, const Vec3& direction, double length, double radius) const noexcept
{
  const Vec3 local = from - center_;
  const double r2 = radius * radius;
  const double tangential = kTangential * radius;
  double reached = length;
  for (int i = 0; i < size_; ++i)
  {
    const double dx = x_[i] - local.x;
    const double dy = y_[i] - local.y;
    const double dz = z_[i] - local.z;
    // The ball is at this distance from the point at t: sqrt(outside + (t - along)^2 - along^2 + r^2).
    const double along = dx * direction.x + dy * direction.y + dz * direction.z;
    const double outside = dx * dx + dy * dy + dz * dz - r2;
    const double inside = along * along - outside;
    if (along > tangential && inside > 0.0)
    {
      const double t = outside / (along + std::sqrt(inside));
      reached = t < reached ? t : reached;
    }
  }
  return reached > 0.0 ? reached : 0.0;
}

} // namespace pointhaptics
