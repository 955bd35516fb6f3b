#include "Haptics/Contact/BallCells.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pointhaptics
{
namespace
{

/// How much further than asked for is gathered, so that a sliding hand stays inside for some ticks: the first
/// that does not overflow.
constexpr double kMargins[] = { 1.35, 1.1, 1.0 + 1e-9 };
constexpr double kSmallerBall = 0.8;
/// Behind the last point: further than any ball reaches, squared still finite.
constexpr double kFarAway = 1e100;
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
  ++passes_;
  if (!onePerVoxel)
  {
    pyramid.visitRuns(level, center_, reach_,
      [&](std::uint32_t first, std::uint32_t last)
      {
        for (std::uint32_t i = first; i < last && fits; ++i)
        {
          fits = add(l.cells[i].mean);
        }
        return fits;
      });
    return fits;
  }
  pyramid.visitRuns(level, center_, reach_,
    [&](std::uint32_t first, std::uint32_t last)
    {
      auto slot = std::upper_bound(l.slotBegin.begin(), l.slotBegin.end(), first) - l.slotBegin.begin() - 1;
      for (; l.slotBegin[std::size_t(slot)] < last && fits; ++slot)
      {
        fits = add(l.cells[l.slotBegin[std::size_t(slot)]].mean);
      }
      return fits;
    });
  return fits;
}

bool BallCells::gather(
  const CellPyramid& pyramid, const Vec3& center, double radius, double coarsest) noexcept
{
  const double left = reach_ - radius;
  const bool isInside = pyramid_ == &pyramid && left >= 0.0 && norm2(center - center_) <= left * left;
  // Where points were left out a smaller ball may have room for them.
  if (isInside && (complete_ || radius >= kSmallerBall * askedRadius_))
  {
    return complete_;
  }
  pyramid_ = &pyramid;
  center_ = center;
  askedRadius_ = radius;
  const auto within = [&](int level, bool onePerVoxel)
  {
    return std::any_of(std::begin(kMargins), std::end(kMargins),
      [&](double margin)
      {
        reach_ = margin * radius;
        return gatherFrom(pyramid, level, onePerVoxel);
      });
  };
  complete_ = within(0, false);
  bool fits = complete_ || within(0, true);
  for (int level = 1;
       !fits && level < pyramid.numberOfCellLevels() && pyramid.level(level).voxelSize <= coarsest; ++level)
  {
    fits = within(level, false);
  }
  for (int i = size_; i % simd::kFitLanes != 0; ++i)
  {
    x_[i] = y_[i] = z_[i] = kFarAway;
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

int BallCells::nearestWithin(const Vec3& p, double radius) const noexcept
{
  const Vec3 local = p - center_;
  int indices[kCapacity];
  const int count = kernels_->pointsWithin(points(), local, radius * radius, indices, kCapacity);
  const auto distance2 = [&](int i) { return norm2(local - Vec3(x_[i], y_[i], z_[i])); };
  const int* const nearest =
    std::min_element(indices, indices + count, [&](int i, int j) { return distance2(i) < distance2(j); });
  return count > 0 ? *nearest : -1;
}

double BallCells::sweep(const Vec3& from, const Vec3& direction, double length, double radius) const noexcept
{
  return kernels_->sweepBall(points(), from - center_, direction, length, radius, kTangential * radius);
}

} // namespace pointhaptics
