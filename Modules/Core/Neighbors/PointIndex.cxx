#include "Core/Neighbors/PointIndex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr std::uint32_t kNoBrick = ~std::uint32_t(0);
/// Bricks per axis: a surface then has a few hundred points in each that is not empty.
constexpr double kPointsPerCell = 20.0;
constexpr int kMostCells = 128;
/// Bricks of a group: tested one by one only if the bounds around them all touch a view.
constexpr std::size_t kGroupBricks = 32;
/// Groups in a piece of a parallel loop.
constexpr std::size_t kSliceGroups = 64;

int cellsPerAxis(std::int64_t points)
{
  return std::clamp(int(std::cbrt(double(points) / kPointsPerCell)), 1, kMostCells);
}

/// A cloud's slices, one for each thread.
class Slices
{
public:
  Slices(std::int64_t points, const Executor& executor)
    : points_(points)
    , executor_(executor)
    , count_(executor.concurrency())
    , size_((points + count_ - 1) / count_)
  {
  }
  std::size_t count() const { return std::size_t(count_); }
  /// Calls visit(slice, begin, end) for parts of all slices, those of one slice in order. @return false if
  /// the observer aborted the work.
  template <typename Visit>
  bool pass(PointProgress& progress, Visit&& visit) const
  {
    const std::int64_t step = std::max<std::int64_t>(kPointsPerReport / count_, 1);
    for (std::int64_t done = 0; done < size_; done += step)
    {
      const std::int64_t part = std::min(step, size_ - done);
      forEachItem(executor_, std::size_t(count_),
        [&](std::size_t slice)
        {
          const std::int64_t begin = std::min(std::int64_t(slice) * size_ + done, points_);
          visit(slice, begin, std::min(begin + part, points_));
        });
      if (!progress.add(part * count_))
      {
        return false;
      }
    }
    return true;
  }

private:
  std::int64_t points_;
  const Executor& executor_;
  std::int64_t count_;
  std::int64_t size_;
};

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

/// Cells of a box, as many on each axis.
struct Grid
{
  Vec3 corner;
  Vec3 perUnit;
  int cells;

  Grid(const Bounds& box, int cells_)
    : corner(box.minimum)
    , cells(cells_)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      // Halves: the extent of a box may overflow.
      const double half = 0.5 * box.maximum[axis] - 0.5 * box.minimum[axis];
      perUnit[axis] = half > 0.0 && std::isfinite(0.5 * cells / half) ? 0.5 * cells / half : 0.0;
    }
  }
  std::uint32_t cellOf(const Vec3& p) const
  {
    std::uint32_t cell = 0;
    for (int axis = 2; axis >= 0; --axis)
    {
      const double u = (0.5 * p[axis] - 0.5 * corner[axis]) * 2.0 * perUnit[axis];
      cell = cell * std::uint32_t(cells) + std::uint32_t(std::min(std::max(u, 0.0), double(cells - 1)));
    }
    return cell;
  }
};

/// The box of the finite points, empty where there are none; nothing if the observer aborted the work.
std::optional<Bounds> boxOf(const PointView& points, const Slices& slices, PointProgress& progress)
{
  std::vector<Bounds> boxes(slices.count());
  const bool isDone = slices.pass(progress,
    [&](std::size_t slice, std::int64_t begin, std::int64_t end)
    {
      Bounds box = boxes[slice];
      for (std::int64_t i = begin; i < end; ++i)
      {
        const Vec3 p = points[i];
        if (isFinite(p))
        {
          box.include(p);
        }
      }
      boxes[slice] = box;
    });
  if (!isDone)
  {
    return std::nullopt;
  }
  Bounds box;
  for (const Bounds& ofSlice : boxes)
  {
    if (!ofSlice.empty())
    {
      box.include(ofSlice.minimum);
      box.include(ofSlice.maximum);
    }
  }
  return box;
}

}

Status PointIndex::build(const PointView& points, const Executor& executor, ProgressObserver* observer)
{
  *this = PointIndex();
  if (points.size() > kMostPoints)
  {
    return Status::InvalidParameter;
  }
  PointProgress progress(observer, points.size(), 4);
  const Status status = this->sort(points, executor, progress);
  if (status == Status::Aborted)
  {
    *this = PointIndex();
  }
  return status;
}

Status PointIndex::sort(const PointView& points, const Executor& executor, PointProgress& progress)
{
  cloudSize_ = points.size();
  const Slices slices(points.size(), executor);
  const std::optional<Bounds> box = boxOf(points, slices, progress);
  if (!box || box->empty())
  {
    return box ? Status::Empty : Status::Aborted;
  }
  // Slices count and place their points by themselves.
  const Grid grid(*box, cellsPerAxis(points.size()));
  std::vector<std::uint32_t> cells(std::size_t(points.size()));
  const std::size_t cellCount = std::size_t(grid.cells) * std::size_t(grid.cells) * std::size_t(grid.cells);
  std::vector<std::uint32_t> places(cellCount * slices.count(), 0);
  const bool isCounted = slices.pass(progress,
    [&](std::size_t slice, std::int64_t begin, std::int64_t end)
    {
      std::uint32_t* counts = places.data() + cellCount * slice;
      for (std::int64_t i = begin; i < end; ++i)
      {
        const Vec3 p = points[i];
        const std::uint32_t cell = isFinite(p) ? grid.cellOf(p) : kNoBrick;
        cells[std::size_t(i)] = cell;
        if (cell != kNoBrick)
        {
          ++counts[cell];
        }
      }
    });
  if (!isCounted)
  {
    return Status::Aborted;
  }
  this->assignPlaces(places, cellCount);
  single_ = points.floats() != nullptr;
  originals_.reserve(std::size_t(size_));
  const bool isFilled = single_ ? this->fill(points, cells, places, floats_, executor, progress)
                                : this->fill(points, cells, places, doubles_, executor, progress);
  return isFilled && this->bound(executor, progress) ? Status::Ok : Status::Aborted;
}

void PointIndex::assignPlaces(std::vector<std::uint32_t>& places, std::size_t cellCount)
{
  std::uint32_t sum = 0;
  for (std::size_t cell = 0; cell < cellCount; ++cell)
  {
    const std::uint32_t begin = sum;
    for (std::size_t place = cell; place < places.size(); place += cellCount)
    {
      const std::uint32_t count = places[place];
      places[place] = sum;
      sum += count;
    }
    if (sum > begin)
    {
      begins_.push_back(begin);
    }
  }
  size_ = sum;
  begins_.push_back(size_);
}

template <typename Real>
bool PointIndex::fill(const PointView& points, const std::vector<std::uint32_t>& cells,
  std::vector<std::uint32_t>& places, Buffer<Real>& copy, const Executor& executor, PointProgress& progress)
{
  copy.reserve(3 * std::size_t(size_));
  const Slices slices(points.size(), executor);
  const std::size_t cellCount = places.size() / slices.count();
  return slices.pass(progress,
    [&](std::size_t slice, std::int64_t begin, std::int64_t end)
    {
      std::uint32_t* next = places.data() + cellCount * slice;
      for (std::int64_t i = begin; i < end; ++i)
      {
        if (cells[std::size_t(i)] == kNoBrick)
        {
          continue;
        }
        const std::size_t to = next[cells[std::size_t(i)]]++;
        const Vec3 p = points[i];
        originals_[to] = std::uint32_t(i);
        for (int axis = 0; axis < 3; ++axis)
        {
          copy[3 * to + std::size_t(axis)] = Real(p[axis]);
        }
      }
    });
}

/// Computes the bounds of the bricks and of their groups.
bool PointIndex::bound(const Executor& executor, PointProgress& progress)
{
  const PointView sorted = this->points();
  const std::size_t bricks = begins_.size() - 1;
  boxes_.resize(bricks);
  groups_.resize((bricks - 1) / kGroupBricks + 1);
  const auto boxOf = [](const Bounds& bounds)
  {
    Box box;
    for (int axis = 0; axis < 3; ++axis)
    {
      box.middle[axis] = 0.5 * bounds.minimum[axis] + 0.5 * bounds.maximum[axis];
      box.half[axis] = 0.5 * bounds.maximum[axis] - 0.5 * bounds.minimum[axis];
    }
    return box;
  };
  const auto boundGroup = [&](std::size_t group)
  {
    Bounds all;
    for (std::size_t b = group * kGroupBricks; b < std::min((group + 1) * kGroupBricks, bricks); ++b)
    {
      Bounds bounds;
      for (std::int64_t i = begins_[b]; i < begins_[b + 1]; ++i)
      {
        bounds.include(sorted[i]);
      }
      all.include(bounds.minimum);
      all.include(bounds.maximum);
      boxes_[b] = boxOf(bounds);
    }
    groups_[group] = boxOf(all);
  };
  for (std::size_t first = 0, last = 0; first < groups_.size(); first = last)
  {
    const std::int64_t begin = begins_[first * kGroupBricks];
    const auto endOf = [&](std::size_t group) { return begins_[std::min(group * kGroupBricks, bricks)]; };
    do
    {
      ++last;
    } while (last < groups_.size() && endOf(last) - begin < kPointsPerReport);
    forEachItem(executor, last - first, [&](std::size_t group) { boundGroup(first + group); });
    if (!progress.add(endOf(last) - begin))
    {
      return false;
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    farthest_[axis] = 0.0;
    for (const Box& box : groups_)
    {
      farthest_[axis] = std::max(farthest_[axis], std::abs(box.middle[axis]) + box.half[axis]);
    }
  }
  return true;
}

/// Whether a moved box can have a point in a lattice.
class PointIndex::BoxTest
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
  bool mayTouch(const Box& box) const
  {
    bool touches = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* row = transform_.m[axis];
      const double x = row[0] * box.middle[0];
      const double y = row[1] * box.middle[1];
      const double z = row[2] * box.middle[2];
      const double middle = row[3] + x + y + z;
      const double half =
        std::abs(row[0]) * box.half[0] + std::abs(row[1]) * box.half[1] + std::abs(row[2]) * box.half[2];
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
  const std::size_t slices = (groups_.size() + kSliceGroups - 1) / kSliceGroups;
  std::vector<std::vector<PointRange>> found(slices);
  forEachItem(executor, slices,
    [&](std::size_t slice)
    {
      const std::size_t end = std::min((slice + 1) * kSliceGroups, groups_.size());
      std::vector<PointRange> ranges; // the thread's own, away from what others write
      for (std::size_t group = slice * kSliceGroups; group < end; ++group)
      {
        this->appendRanges(test, group, ranges);
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

/// Appends the ranges of the bricks of a group that may have points inside.
void PointIndex::appendRanges(const BoxTest& test, std::size_t group, std::vector<PointRange>& ranges) const
{
  if (!test.mayTouch(groups_[group]))
  {
    return;
  }
  const std::size_t end = std::min((group + 1) * kGroupBricks, boxes_.size());
  for (std::size_t b = group * kGroupBricks; b < end; ++b)
  {
    if (test.mayTouch(boxes_[b]))
    {
      append({ begins_[b], begins_[b + 1] }, ranges);
    }
  }
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

std::size_t PointIndex::bytes() const
{
  return floats_.bytes() + doubles_.bytes() + originals_.bytes() + begins_.capacity() * sizeof(std::int64_t) +
    (boxes_.capacity() + groups_.capacity()) * sizeof(Box);
}

} // namespace pointhaptics
