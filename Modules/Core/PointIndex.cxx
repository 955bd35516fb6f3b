#include "Core/PointIndex.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>

namespace pointhaptics
{
namespace
{

constexpr std::uint32_t kNoBrick = ~std::uint32_t(0);
/// Bricks per axis: a surface then has a few hundred points in each that is not empty.
constexpr double kPointsPerCell = 20.0;
constexpr int kMostCells = 128;

int cellsPerAxis(std::int64_t points)
{
  return std::clamp(int(std::cbrt(double(points) / kPointsPerCell)), 1, kMostCells);
}

Bounds finiteBounds(const PointView& points, const Executor& executor)
{
  Bounds box;
  std::mutex mutex;
  forRange(executor, points.size(),
    [&](std::int64_t begin, std::int64_t end)
    {
      Bounds local;
      for (std::int64_t i = begin; i < end; ++i)
      {
        const Vec3 p = points[i];
        if (isFinite(p))
        {
          local.include(p);
        }
      }
      if (!local.empty())
      {
        const std::lock_guard<std::mutex> lock(mutex);
        box.include(local.minimum);
        box.include(local.maximum);
      }
    });
  return box;
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

}

Status PointIndex::build(const PointView& points, const Executor& executor)
{
  *this = PointIndex();
  if (points.size() > kMostPoints)
  {
    return Status::InvalidParameter;
  }
  cloudSize_ = points.size();
  const Bounds box = finiteBounds(points, executor);
  if (box.empty())
  {
    return Status::Empty;
  }
  const Grid grid(box, cellsPerAxis(points.size()));
  std::vector<std::uint32_t> cells(std::size_t(points.size()));
  // Slices of the cloud count and place their points by themselves.
  const std::int64_t slices = executor.concurrency();
  const std::int64_t sliceSize = (points.size() + slices - 1) / slices;
  const std::size_t cellCount = std::size_t(grid.cells) * std::size_t(grid.cells) * std::size_t(grid.cells);
  std::vector<std::uint32_t> places(cellCount * std::size_t(slices), 0);
  forRange(executor, slices, 1,
    [&](std::int64_t first, std::int64_t last)
    {
      for (std::int64_t slice = first; slice < last; ++slice)
      {
        std::uint32_t* counts = places.data() + cellCount * std::size_t(slice);
        const std::int64_t end = std::min(points.size(), (slice + 1) * sliceSize);
        for (std::int64_t i = slice * sliceSize; i < end; ++i)
        {
          const Vec3 p = points[i];
          const std::uint32_t cell = isFinite(p) ? grid.cellOf(p) : kNoBrick;
          cells[std::size_t(i)] = cell;
          if (cell != kNoBrick)
          {
            ++counts[cell];
          }
        }
      }
    });
  std::uint32_t sum = 0;
  for (std::size_t cell = 0; cell < cellCount; ++cell)
  {
    const std::uint32_t begin = sum;
    for (std::size_t slice = 0; slice < std::size_t(slices); ++slice)
    {
      std::uint32_t& place = places[cell + cellCount * slice];
      const std::uint32_t count = place;
      place = sum;
      sum += count;
    }
    if (sum > begin)
    {
      begins_.push_back(begin);
    }
  }
  size_ = sum;
  begins_.push_back(size_);
  single_ = points.floats() != nullptr;
  originals_.reserve(std::size_t(size_));
  if (single_)
  {
    fill(points, cells, places, floats_, executor);
  }
  else
  {
    fill(points, cells, places, doubles_, executor);
  }
  return Status::Ok;
}

template <typename Real>
void PointIndex::fill(const PointView& points, const std::vector<std::uint32_t>& cells,
  std::vector<std::uint32_t>& places, Buffer<Real>& copy, const Executor& executor)
{
  copy.reserve(3 * std::size_t(size_), Pages::Huge);
  const std::int64_t slices = executor.concurrency();
  const std::int64_t sliceSize = (points.size() + slices - 1) / slices;
  const std::size_t cellCount = places.size() / std::size_t(slices);
  forRange(executor, slices, 1,
    [&](std::int64_t first, std::int64_t last)
    {
      for (std::int64_t slice = first; slice < last; ++slice)
      {
        std::uint32_t* next = places.data() + cellCount * std::size_t(slice);
        const std::int64_t end = std::min(points.size(), (slice + 1) * sliceSize);
        for (std::int64_t i = slice * sliceSize; i < end; ++i)
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
      }
    });
  const PointView sorted = this->points();
  const std::size_t bricks = begins_.size() - 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    middles_[axis].resize(bricks);
    halves_[axis].resize(bricks);
  }
  constexpr std::int64_t kGrain = 64;
  forRange(executor, std::int64_t(bricks), kGrain,
    [&](std::int64_t first, std::int64_t last)
    {
      for (std::size_t b = std::size_t(first); b < std::size_t(last); ++b)
      {
        Bounds box;
        for (std::int64_t i = begins_[b]; i < begins_[b + 1]; ++i)
        {
          box.include(sorted[i]);
        }
        for (int axis = 0; axis < 3; ++axis)
        {
          middles_[axis][b] = 0.5 * box.minimum[axis] + 0.5 * box.maximum[axis];
          halves_[axis][b] = 0.5 * box.maximum[axis] - 0.5 * box.minimum[axis];
        }
      }
    });
  for (int axis = 0; axis < 3; ++axis)
  {
    farthest_[axis] = 0.0;
    for (std::size_t b = 0; b < bricks; ++b)
    {
      farthest_[axis] = std::max(farthest_[axis], std::abs(middles_[axis][b]) + halves_[axis][b]);
    }
  }
}

PointView PointIndex::points() const
{
  return single_ ? PointView(floats_.data(), size_) : PointView(doubles_.data(), size_);
}

std::vector<PointRange> PointIndex::rangesInside(
  const AffineTransform& transform, const Lattice& lattice) const
{
  // Far above what rounding can do to a bound, far below a brick.
  constexpr double kSlack = 1e-9;
  const std::size_t bricks = begins_.empty() ? 0 : begins_.size() - 1;
  if (bricks > 0 && !staysFinite(transform))
  {
    return { { 0, size_ } };
  }
  // Those that are outside on an axis are not asked about the next.
  std::vector<std::uint32_t> left(bricks);
  std::iota(left.begin(), left.end(), 0u);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* row = transform.m[axis];
    const double low = lattice.origin[axis];
    const double high = low +
      std::min(double(lattice.dimensions[std::size_t(axis)]), lattice.end[axis]) * lattice.spacing[axis];
    const double fixed = std::abs(row[3]) + std::abs(low);
    std::size_t size = 0;
    for (const std::uint32_t b : left)
    {
      const double x = row[0] * middles_[0][b];
      const double y = row[1] * middles_[1][b];
      const double z = row[2] * middles_[2][b];
      const double middle = row[3] + x + y + z;
      const double half = std::abs(row[0]) * halves_[0][b] + std::abs(row[1]) * halves_[1][b] +
        std::abs(row[2]) * halves_[2][b];
      const double reach = half + kSlack * (fixed + std::abs(x) + std::abs(y) + std::abs(z) + half);
      left[size] = b;
      size += (middle + reach >= low) & (middle - reach <= high);
    }
    left.resize(size);
  }
  std::vector<PointRange> ranges;
  for (const std::uint32_t b : left)
  {
    if (!ranges.empty() && ranges.back().end == begins_[b])
    {
      ranges.back().end = begins_[b + 1];
    }
    else
    {
      ranges.push_back({ begins_[b], begins_[b + 1] });
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

std::size_t PointIndex::bytes() const
{
  return floats_.bytes() + doubles_.bytes() + originals_.bytes() + begins_.capacity() * 7 * sizeof(double);
}

} // namespace pointhaptics
