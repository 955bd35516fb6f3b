#include "Haptics/Contact/BallCells.h"

#include "Core/Base/Boxes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pointhaptics
{
namespace
{

/// How much further than asked for is gathered, so that a sliding hand stays inside for some ticks: the first
/// that does not overflow. The first is over the radius that will be asked for soon.
constexpr double kMargins[] = { 1.35, 1.35, 1.1, 1.0 + 1e-9 };
constexpr double kSmallerBall = 0.8;
/// The same of those looked at in detail.
constexpr double kNearMargin = 1.25;
/// Behind the last point: further than any ball reaches, squared still finite.
constexpr double kFarAway = 1e100;
/// Part of the radius by which a way may lead towards a touched point that it goes past: rounding.
constexpr double kTangential = 1e-6;

}

void BallCells::carryOver(const CellPyramid& pyramid, const Bounds& same) noexcept
{
  pyramid_ = containsBall(same, center_, reach_) ? &pyramid : nullptr;
}

/// Leaves out what is beyond the next smaller margin. False: there is none.
bool BallCells::shrink() noexcept
{
  if (margin_ + 1 == std::size(kMargins))
  {
    return false;
  }
  reach_ = kMargins[++margin_] * askedRadius_;
  const int all = size_;
  size_ = 0;
  for (int i = 0; i < all; ++i)
  {
    const Vec3 local(x_[i], y_[i], z_[i]);
    x_[size_] = local.x;
    y_[size_] = local.y;
    z_[size_] = local.z;
    size_ += norm2(local) < reach_ * reach_ ? 1 : 0;
  }
  return true;
}

/// Adds those of the @p count points that @p pointAt gives that are within reach. False: they are too many.
template <typename PointAt>
bool BallCells::add(std::uint32_t count, const PointAt& pointAt) noexcept
{
  std::uint32_t i = 0;
  do
  {
    // Which points lie inside is hard to predict: each is written, and the next one over it unless it does.
    const double reach2 = reach_ * reach_;
    const Vec3 center = center_;
    int size = size_;
    for (; i < count && size <= kCapacity; ++i)
    {
      const Vec3 local = pointAt(i) - center;
      x_[size] = local.x;
      y_[size] = local.y;
      z_[size] = local.z;
      size += norm2(local) < reach2 ? 1 : 0;
    }
    size_ = size;
    while (size_ > kCapacity)
    {
      if (!this->shrink())
      {
        size_ = kCapacity;
        return false;
      }
    }
  } while (i < count);
  return true;
}

bool BallCells::gatherFrom(const CellPyramid& pyramid, int level, double likely, bool onePerVoxel) noexcept
{
  const CellPyramid::Level& l = pyramid.level(level);
  const Cell* const cells = l.cells.data();
  bool fits = true;
  size_ = 0;
  margin_ = 0;
  reach_ = kMargins[0] * std::max(askedRadius_, likely);
  ++passes_;
  pyramid.visitRuns(level, center_, reach_,
    [&](std::uint32_t first, std::uint32_t last)
    {
      looked_ += last - first;
      if (!onePerVoxel)
      {
        fits = add(last - first, [&](std::uint32_t i) { return cells[first + i].mean; });
        return fits;
      }
      const auto slot = std::upper_bound(l.slotBegin.begin(), l.slotBegin.end(), first) - 1;
      const auto end = std::lower_bound(slot, l.slotBegin.end(), last);
      fits =
        add(std::uint32_t(end - slot), [&](std::uint32_t i) { return cells[slot[std::ptrdiff_t(i)]].mean; });
      return fits;
    });
  return fits;
}

bool BallCells::gather(
  const CellPyramid& pyramid, const Vec3& center, double radius, double coarsest, double likely) noexcept
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
  complete_ = gatherFrom(pyramid, 0, likely, false);
  bool fits = complete_ || gatherFrom(pyramid, 0, likely, true);
  for (int level = 1;
       !fits && level < pyramid.numberOfCellLevels() && pyramid.level(level).voxelSize <= coarsest; ++level)
  {
    fits = gatherFrom(pyramid, level, likely, false);
  }
  this->pad(size_);
  nearReach_ = -1.0;
  return complete_;
}

/// Points far away behind the last one, at @p end: the loops take eight at a time.
void BallCells::pad(int end) noexcept
{
  for (int i = end; i % simd::kFitLanes != 0; ++i)
  {
    x_[i] = y_[i] = z_[i] = kFarAway;
  }
}

void BallCells::focus(const Vec3& center, double radius) noexcept
{
  if (this->servesNear(center, radius))
  {
    return;
  }
  nearCenter_ = center;
  nearReach_ = kNearMargin * radius;
  int indices[kCapacity];
  nearSize_ = kernels_->pointsWithin(
    points({ 0, size_ }), center - center_, nearReach_ * nearReach_, indices, kCapacity);
  for (int k = 0; k < nearSize_; ++k)
  {
    x_[kNear + k] = x_[indices[k]];
    y_[kNear + k] = y_[indices[k]];
    z_[kNear + k] = z_[indices[k]];
  }
  this->pad(kNear + nearSize_);
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
  const Part part = partAbout(p, radius);
  const int count = kernels_->pointsWithin(points(part), local, radius * radius, indices, kCapacity);
  const auto distance2 = [&](int i)
  { return norm2(local - Vec3(x_[part.first + i], y_[part.first + i], z_[part.first + i])); };
  const int* const nearest =
    std::min_element(indices, indices + count, [&](int i, int j) { return distance2(i) < distance2(j); });
  return count > 0 ? part.first + *nearest : -1;
}

bool BallCells::nearestOf(
  const CellPyramid& pyramid, const Vec3& p, double search, Vec3& nearest) const noexcept
{
  const double known = pyramid_ == &pyramid && complete_ ? std::min(search, reach_ - norm(p - center_)) : 0.0;
  const int here = known > 0.0 ? this->nearestWithin(p, known) : -1;
  double ignored = 0.0;
  const std::int64_t cell = here < 0 && known < search ? pyramid.nearest(0, p, search, ignored) : -1;
  nearest = here >= 0 ? this->point(here)
    : cell >= 0       ? pyramid.level(0).cells[std::size_t(cell)].mean
                      : nearest;
  return here >= 0 || cell >= 0;
}

double BallCells::sweep(const Vec3& from, const Vec3& direction, double length, double radius) const noexcept
{
  const auto sweepIn = [&](const Part& part)
  {
    return kernels_->sweepBall(points(part), from - center_, direction, length, radius, kTangential * radius);
  };
  // Most ways are short, whatever was asked for.
  if (this->servesNear(from, radius))
  {
    const double reached = sweepIn(Part{ kNear, nearSize_ });
    if (this->servesNear(from, radius + reached))
    {
      return reached;
    }
  }
  return sweepIn(Part{ 0, size_ });
}

} // namespace pointhaptics
