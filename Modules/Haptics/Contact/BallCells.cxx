#include "Haptics/Contact/BallCells.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace pointhaptics
{
namespace
{

/// Points are gathered further than requested, so that a sliding hand stays inside for some ticks: by these
/// parts of the requested way plus the typical radius, tried in order until the points fit. The first also
/// covers a glide after a slide. The last takes what was asked for.
constexpr double kMargins[] = { 0.9, 0.25, 0.0 };
/// If points were left out, a way shorter than this fraction of the last one is gathered anew: all may have
/// room. With 1 a tick beside a step in density takes 4 ms, as each of its ways is gathered.
constexpr double kShorterWay = 0.8;
/// Tolerance over the radius of a touched point: a way that comes nearer to that point by less is tangential.
/// Without it rounding would stop a sliding ball.
constexpr double kTangential = 1e-6;

}

/// Lowers the reach to the next smaller margin and removes the points beyond it, as add() does without a
/// branch. Called when more than kCapacity points were found. False: there is no smaller margin.
bool BallCells::shrink() noexcept
{
  if (margin_ + 1 == std::size(kMargins))
  {
    return false;
  }
  ++margin_;
  reach_ = this->reachOf(requestedWay_, kMargins[margin_]);
  const int all = size_;
  size_ = 0;
  for (int i = 0; i < all; ++i)
  {
    const Vec3 local(x_[i], y_[i], z_[i]);
    const double radius = radius_[i];
    x_[size_] = local.x;
    y_[size_] = local.y;
    z_[size_] = local.z;
    radius_[size_] = radius;
    size_ += norm2(local) < (radius + reach_) * (radius + reach_) ? 1 : 0;
  }
  return true;
}

/// Adds the cells of @p level within reach, out of the @p count that @p indexAt enumerates. False: they are
/// too many.
template <typename IndexAt>
bool BallCells::add(
  const ContactField& field, int level, std::uint32_t count, const IndexAt& indexAt) noexcept
{
  const Cell* const cells = field.pyramid().level(level).cells.data();
  const float* const radii = field.radii(level).data();
  std::uint32_t i = 0;
  do
  {
    // A branch on "inside" would be mispredicted. So each point is written, and the next one overwrites it if
    // it is outside.
    const double reach = reach_;
    const Vec3 center = center_;
    int size = size_;
    for (; i < count && size <= kCapacity; ++i)
    {
      const std::uint32_t index = indexAt(i);
      const Vec3 local = cells[index].mean - center;
      const double radius = double(radii[index]);
      x_[size] = local.x;
      y_[size] = local.y;
      z_[size] = local.z;
      radius_[size] = radius;
      size += norm2(local) < (radius + reach) * (radius + reach) ? 1 : 0;
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

bool BallCells::gatherFrom(const ContactField& field, int level, bool onePerVoxel) noexcept
{
  const CellPyramid::Level& l = field.pyramid().level(level);
  bool fits = true;
  size_ = 0;
  margin_ = 0;
  reach_ = this->reachOf(requestedWay_, kMargins[margin_]);
  ++passes_;
  field.visitRuns(level, center_, reach_,
    [&](std::uint32_t first, std::uint32_t last)
    {
      pointsExamined_ += last - first;
      if (!onePerVoxel)
      {
        fits = this->add(field, level, last - first, [first](std::uint32_t i) { return first + i; });
        return fits;
      }
      const auto slot = std::upper_bound(l.slotBegin.begin(), l.slotBegin.end(), first) - 1;
      const auto end = std::lower_bound(slot, l.slotBegin.end(), last);
      fits = this->add(
        field, level, std::uint32_t(end - slot), [slot](std::uint32_t i) { return slot[std::ptrdiff_t(i)]; });
      return fits;
    });
  return fits;
}

bool BallCells::gather(const ContactField& field, const Vec3& center, double way, double ball) noexcept
{
  const double left = reach_ - way;
  const bool isInside = pyramid_ == &field.pyramid() && left >= 0.0 && norm2(center - center_) <= left * left;
  if (isInside && (complete_ || way + ball >= kShorterWay * (requestedWay_ + typicalRadius_)))
  {
    return complete_;
  }
  pyramid_ = &field.pyramid();
  center_ = center;
  requestedWay_ = way;
  typicalRadius_ = ball;
  complete_ = gatherFrom(field, 0, false);
  bool fits = complete_ || gatherFrom(field, 0, true);
  for (int level = 1;
       !fits && level < pyramid_->numberOfCellLevels() && pyramid_->level(level).voxelSize <= 0.5 * ball;
       ++level)
  {
    fits = gatherFrom(field, level, false);
  }
  this->pad(size_);
  nearReach_ = -1.0;
  return complete_;
}

/// Fills up to @p end with points far away, as the loops take eight at a time.
void BallCells::pad(int end) noexcept
{
  for (int i = end; i % simd::kFitLanes != 0; ++i)
  {
    // No ball reaches it, and its square is finite.
    x_[i] = y_[i] = z_[i] = double(std::numeric_limits<float>::max());
    radius_[i] = 0.0;
  }
}

void BallCells::focus(const Vec3& center, double way) noexcept
{
  if (this->servesNear(center, way))
  {
    return;
  }
  nearCenter_ = center;
  nearReach_ = this->reachOf(way, kMargins[1]);
  int indices[kCapacity];
  nearSize_ =
    kernels_->ballsWithin(points({ 0, size_ }), center - center_, 1.0, nearReach_, indices, kCapacity);
  for (int k = 0; k < nearSize_; ++k)
  {
    x_[kNear + k] = x_[indices[k]];
    y_[kNear + k] = y_[indices[k]];
    z_[kNear + k] = z_[indices[k]];
    radius_[kNear + k] = radius_[indices[k]];
  }
  this->pad(kNear + nearSize_);
}

int BallCells::deepest(const Vec3& p, double scale) const noexcept
{
  const Vec3 local = p - center_;
  int indices[kCapacity];
  const Part part = partAbout(p, 0.0);
  const int count = kernels_->ballsWithin(points(part), local, scale, 0.0, indices, kCapacity);
  int best = -1;
  double most = -1.0;
  for (int k = 0; k < count; ++k)
  {
    const int i = part.first + indices[k];
    const double depth = scale * radius_[i] - norm(local - Vec3(x_[i], y_[i], z_[i]));
    best = depth > most ? i : best;
    most = std::max(most, depth);
  }
  return best;
}

double BallCells::roomAt(const Vec3& p) const noexcept
{
  double room = 1.0;
  this->visitTouched(
    p, 1.0, [&](const Vec3& offset, double radius) { room = std::min(room, norm(offset) / radius); });
  return room;
}

double BallCells::sweep(const Vec3& from, const Vec3& direction, double length, double scale) const noexcept
{
  const auto sweepIn = [&](const Part& part)
  { return kernels_->sweepBall(points(part), from - center_, direction, length, scale, kTangential); };
  // Most ways are short, even where a long one was asked for.
  if (this->servesNear(from, 0.0))
  {
    const double reached = sweepIn(Part{ kNear, nearSize_ });
    if (this->servesNear(from, reached))
    {
      return reached;
    }
  }
  return sweepIn(Part{ 0, size_ });
}

} // namespace pointhaptics
