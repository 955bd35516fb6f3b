#include "Core/Neighbors/PointIndex.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr std::int64_t kBrickPoints = 128;
/// Bricks in a piece of a parallel loop.
constexpr std::size_t kSliceBricks = 2048;

/// Appends a range; neighbours join.
void append(PointRange range, std::vector<PointRange>& ranges)
{
  if (!ranges.empty() && ranges.back().end == range.begin)
  {
    ranges.back().end = range.end;
    return;
  }
  ranges.push_back(range);
}

/// Whether a moved box can have a point in a lattice.
class BoxTest
{
public:
  BoxTest(const AffineTransform& transform, const Lattice& lattice)
    : transform_(transform)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      low_[axis] = lattice.origin[axis];
      high_[axis] = low_[axis] +
        std::min(double(lattice.dimensions[std::size_t(axis)]), lattice.end[axis]) * lattice.spacing[axis];
      fixed_[axis] = std::abs(transform.m[axis][3]) + std::abs(low_[axis]);
    }
  }
  bool mayTouch(const Bounds& box) const
  {
    // Halves: the extent of a box may overflow.
    const Vec3 center = box.center();
    const Vec3 extent = 0.5 * box.maximum - 0.5 * box.minimum;
    bool touches = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* row = transform_.m[axis];
      const double x = row[0] * center.x;
      const double y = row[1] * center.y;
      const double z = row[2] * center.z;
      const double middle = row[3] + x + y + z;
      const double half =
        std::abs(row[0]) * extent.x + std::abs(row[1]) * extent.y + std::abs(row[2]) * extent.z;
      const double reach = half + kSlack * (fixed_[axis] + std::abs(x) + std::abs(y) + std::abs(z) + half);
      touches = touches & (middle + reach >= low_[axis]) & (middle - reach <= high_[axis]);
    }
    return touches;
  }

private:
  /// Far above what rounding can do to a bound, far below a brick.
  static constexpr double kSlack = 1e-9;

  const AffineTransform& transform_;
  double low_[3];
  double high_[3];
  double fixed_[3];
};

}

Status PointIndex::build(const PointView& points, const Executor& executor, ProgressObserver* observer)
{
  *this = PointIndex();
  if (points.size() > kMostPoints)
  {
    return Status::InvalidParameter;
  }
  PointProgress progress(observer, points.size(), 2);
  std::vector<std::uint32_t> order = spatialOrder(points, kBrickPoints, executor);
  if (!progress.add(points.size()))
  {
    return Status::Aborted;
  }
  cloudSize_ = points.size();
  size_ = std::int64_t(order.size());
  originals_ = std::move(order);
  single_ = points.floats() != nullptr;
  const bool isFilled = single_ ? this->fill(points, floats_, executor, progress)
                                : this->fill(points, doubles_, executor, progress);
  if (!isFilled)
  {
    *this = PointIndex();
    return Status::Aborted;
  }
  return size_ > 0 ? Status::Ok : Status::Empty;
}

PointRange PointIndex::pointsOf(std::size_t brick) const
{
  const std::int64_t begin = std::int64_t(brick) * kBrickPoints;
  return { begin, std::min(begin + kBrickPoints, size_) };
}

template <typename Real>
bool PointIndex::fill(
  const PointView& points, Buffer<Real>& copy, const Executor& executor, PointProgress& progress)
{
  copy.reserve(3 * std::size_t(size_));
  bricks_.resize(std::size_t((size_ + kBrickPoints - 1) / kBrickPoints));
  const auto fillBrick = [&](std::size_t brick)
  {
    const PointRange range = this->pointsOf(brick);
    for (std::int64_t i = range.begin; i < range.end; ++i)
    {
      const Vec3 p = points[originals_[std::size_t(i)]];
      bricks_[brick].include(p);
      for (int axis = 0; axis < 3; ++axis)
      {
        copy[std::size_t(3 * i + axis)] = Real(p[axis]);
      }
    }
  };
  constexpr std::int64_t kBricks = kSmallestPiece / kBrickPoints;
  const bool isDone = forReportedSlices(size_, progress,
    [&](std::int64_t first, std::int64_t last)
    {
      const std::int64_t firstBrick = (first + kBrickPoints - 1) / kBrickPoints;
      const std::int64_t lastBrick = (last + kBrickPoints - 1) / kBrickPoints;
      forRange(executor, lastBrick - firstBrick, kBricks,
        [&](std::int64_t begin, std::int64_t end)
        {
          for (std::int64_t brick = firstBrick + begin; brick < firstBrick + end; ++brick)
          {
            fillBrick(std::size_t(brick));
          }
        });
    });
  for (const Bounds& brick : bricks_)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      farthest_[axis] =
        std::max({ farthest_[axis], std::abs(brick.minimum[axis]), std::abs(brick.maximum[axis]) });
    }
  }
  return isDone;
}

PointView PointIndex::points() const
{
  return single_ ? PointView(floats_.data(), size_) : PointView(doubles_.data(), size_);
}

std::vector<PointRange> PointIndex::rangesInside(
  const AffineTransform& transform, const Lattice& lattice, const Executor& executor) const
{
  if (size_ > 0 && !staysFinite(transform))
  {
    return { { 0, size_ } };
  }
  const BoxTest test(transform, lattice);
  std::vector<std::vector<PointRange>> found((bricks_.size() + kSliceBricks - 1) / kSliceBricks);
  forEachItem(executor, found.size(),
    [&](std::size_t slice)
    {
      const std::size_t end = std::min((slice + 1) * kSliceBricks, bricks_.size());
      std::vector<PointRange> ranges; // the thread's own, away from what others write
      for (std::size_t brick = slice * kSliceBricks; brick < end; ++brick)
      {
        if (test.mayTouch(bricks_[brick]))
        {
          append(this->pointsOf(brick), ranges);
        }
      }
      found[slice] = std::move(ranges);
    });
  std::vector<PointRange> ranges;
  for (const std::vector<PointRange>& ofSlice : found)
  {
    for (const PointRange& range : ofSlice)
    {
      append(range, ranges);
    }
  }
  return ranges;
}

/// Whether no point can become infinite, which would make it invalid instead of clipped.
bool PointIndex::staysFinite(const AffineTransform& transform) const
{
  constexpr double kLargest = 1e300;
  for (const auto& row : transform.m)
  {
    double sum = std::abs(row[3]);
    for (int axis = 0; axis < 3; ++axis)
    {
      sum += std::abs(row[axis]) * farthest_[axis];
    }
    if (!(sum <= kLargest))
    {
      return false;
    }
  }
  return true;
}

} // namespace pointhaptics
