#include "Core/Neighbors/SpatialOrder.h"

#include "Core/Base/RadixSort.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace pointhaptics
{
namespace
{

/// A key in the upper half, the index of its point in the lower.
using Entry = std::uint64_t;

constexpr int kBitsPerAxis = 10;
constexpr double kCellsPerAxis = 1 << kBitsPerAxis;
/// Above all keys.
constexpr std::uint32_t kNoKey = ~0u;
/// Points processed together.
constexpr std::int64_t kBlock = 1024;
/// Fewer entries are sorted by comparing them.
constexpr std::int64_t kSmallSort = 2048;

std::uint32_t indexOf(Entry entry)
{
  return std::uint32_t(entry);
}
std::uint32_t keyOf(Entry entry)
{
  return std::uint32_t(entry >> 32);
}

/// 10 bits with two free places before every one.
inline std::uint32_t spreadBits(std::uint32_t v)
{
  v = (v | v << 16) & 0x030000FFu;
  v = (v | v << 8) & 0x0300F00Fu;
  v = (v | v << 4) & 0x030C30C3u;
  return (v | v << 2) & 0x09249249u;
}

/// Position along Hilbert's curve through 2^30 cells: Skilling's AxesToTranspose without branches, then the
/// bits of the three words in turn.
inline std::uint32_t hilbertKey(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  for (int bit = kBitsPerAxis - 1; bit > 0; --bit)
  {
    const std::uint32_t low = (1u << bit) - 1u;
    x ^= low & (0u - (x >> bit & 1u));
    for (std::uint32_t* const other : { &y, &z })
    {
      const std::uint32_t isSet = 0u - (*other >> bit & 1u);
      const std::uint32_t swapped = (x ^ *other) & low & ~isSet;
      x ^= swapped ^ (low & isSet);
      *other ^= swapped;
    }
  }
  y ^= x;
  z ^= y;
  std::uint32_t flip = 0;
  for (int bit = kBitsPerAxis - 1; bit > 0; --bit)
  {
    flip ^= ((1u << bit) - 1u) & (0u - (z >> bit & 1u));
  }
  return spreadBits(x ^ flip) << 2 | spreadBits(y ^ flip) << 1 | spreadBits(z ^ flip);
}

/// From places in a box to cells of the cube about it. Halves, so that no extent overflows.
struct Grid
{
  Vec3 corner;
  double scale = 0.0;

  explicit Grid(const Bounds& box)
    : corner(0.5 * box.minimum)
  {
    const Vec3 extent = 0.5 * box.maximum - corner;
    const double perUnit = kCellsPerAxis / std::max(extent.x, std::max(extent.y, extent.z));
    scale = std::isfinite(perUnit) ? perUnit : 0.0;
  }
  /// Else the box is a point, or so small that its cells cannot be distinguished: all have the same key.
  bool usable() const { return scale > 0.0; }

  std::uint32_t cell(double place, int axis) const
  {
    return std::uint32_t(std::min((0.5 * place - corner[axis]) * scale, kCellsPerAxis - 1.0));
  }
  Entry entryOf(const Vec3& p, std::uint32_t index) const
  {
    return Entry(hilbertKey(cell(p.x, 0), cell(p.y, 1), cell(p.z, 2))) << 32 | index;
  }
};

bool lexicographic(const Vec3& a, const Vec3& b)
{
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

class Orderer
{
public:
  Orderer(const PointView& points, std::int64_t mostPerCell, const Executor& executor)
    : points_(points)
    , mostPerCell_(mostPerCell)
    , executor_(executor)
  {
  }

  std::vector<std::uint32_t> order()
  {
    const Bounds box = survey();
    entries_.resize(std::size_t(points_.size()));
    spare_.resize(entries_.size());
    fill(Grid(box));
    sortRun({ 0, points_.size() });
    const auto none = std::partition_point(
      entries_.begin(), entries_.end(), [](Entry entry) { return keyOf(entry) != kNoKey; });
    entries_.resize(std::size_t(none - entries_.begin()));
    const auto count = std::int64_t(entries_.size());
    // The points of overfull cells, recursively.
    collectOverfullCells({ 0, count });
    while (!overfull_.empty())
    {
      const Run run = overfull_.back();
      overfull_.pop_back();
      refine(run);
    }
    std::vector<std::uint32_t> result(entries_.size());
    forRange(executor_, count,
      [&](std::int64_t begin, std::int64_t end)
      { std::transform(entries_.begin() + begin, entries_.begin() + end, result.begin() + begin, indexOf); });
    return result;
  }

private:
  struct Run
  {
    std::int64_t begin;
    std::int64_t end;
  };
  /// @return the bounds of the finite points.
  Bounds survey() const
  {
    std::mutex mutex;
    Bounds box;
    forRange(executor_, points_.size(),
      [&](std::int64_t begin, std::int64_t end)
      {
        Bounds own;
        for (std::int64_t i = begin; i < end; ++i)
        {
          const Vec3 p = points_[i];
          if (isFinite(p))
          {
            own.include(p);
          }
        }
        const std::lock_guard<std::mutex> lock(mutex);
        box.include(own.minimum);
        box.include(own.maximum);
      });
    return box;
  }

  /// Points that are not finite get a key behind all others.
  void fill(const Grid& grid)
  {
    forRange(executor_, points_.size(),
      [&](std::int64_t begin, std::int64_t end)
      {
        std::uint32_t cells[3][kBlock];
        std::uint32_t noKey[kBlock];
        for (; begin < end; begin += kBlock)
        {
          const std::int64_t count = std::min(kBlock, end - begin);
          for (std::int64_t i = 0; i < count; ++i)
          {
            const Vec3 p = points_[begin + i];
            const bool isPlace = isFinite(p);
            noKey[i] = isPlace ? 0 : kNoKey;
            for (int axis = 0; axis < 3; ++axis)
            {
              cells[axis][i] = isPlace ? grid.cell(p[axis], axis) : 0;
            }
          }
          Entry* const to = entries_.data() + begin;
          for (std::int64_t i = 0; i < count; ++i)
          {
            to[i] = Entry(hilbertKey(cells[0][i], cells[1][i], cells[2][i]) | noKey[i]) << 32 |
              std::uint32_t(begin + i);
          }
        }
      });
  }

  /// By key, then by index: entries come in with ascending indices.
  void sortRun(const Run& run)
  {
    if (run.end - run.begin <= kSmallSort)
    {
      std::sort(entries_.begin() + run.begin, entries_.begin() + run.end);
      return;
    }
    Entry* sorted = entries_.data() + run.begin;
    Entry* other = spare_.data() + run.begin;
    radixSort(sorted, other, std::size_t(run.end - run.begin), keyOf);
    if (sorted != entries_.data() + run.begin)
    {
      std::copy_n(sorted, run.end - run.begin, other);
    }
  }

  /// Lists the runs of equal keys that are longer than mostPerCell.
  void collectOverfullCells(const Run& run)
  {
    for (std::int64_t begin = run.begin; begin + mostPerCell_ < run.end;)
    {
      const std::uint32_t key = keyOf(entries_[std::size_t(begin)]);
      std::int64_t end = begin + 1;
      while (end < run.end && keyOf(entries_[std::size_t(end)]) == key)
      {
        ++end;
      }
      if (end - begin > mostPerCell_)
      {
        overfull_.push_back({ begin, end });
      }
      begin = end;
    }
  }

  void refine(const Run& run)
  {
    Bounds box;
    for (std::int64_t i = run.begin; i < run.end; ++i)
    {
      box.include(points_[indexOf(entries_[std::size_t(i)])]);
    }
    if (box.minimum == box.maximum)
    {
      return;
    }
    const Grid grid(box);
    if (!grid.usable())
    {
      std::stable_sort(entries_.begin() + run.begin, entries_.begin() + run.end,
        [this](Entry a, Entry b) { return lexicographic(points_[indexOf(a)], points_[indexOf(b)]); });
      return;
    }
    std::for_each(entries_.begin() + run.begin, entries_.begin() + run.end,
      [&](Entry& entry) { entry = grid.entryOf(points_[indexOf(entry)], indexOf(entry)); });
    sortRun(run);
    collectOverfullCells(run);
  }

  const PointView& points_;
  const std::int64_t mostPerCell_;
  const Executor& executor_;
  std::vector<Entry> entries_;
  std::vector<Entry> spare_;
  std::vector<Run> overfull_;
};

}

std::vector<std::uint32_t> spatialOrder(
  const PointView& points, std::int64_t mostPerCell, const Executor& executor)
{
  if (points.size() > kMostOrderedPoints)
  {
    return {};
  }
  return Orderer(points, mostPerCell, executor).order();
}

} // namespace pointhaptics
