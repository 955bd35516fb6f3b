#include "Core/Neighbors/SpatialOrder.h"

#include "Core/Neighbors/NeighborKernel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// A key in the upper half, the index of its point in the lower.
using Entry = std::uint64_t;

constexpr int kBitsPerAxis = 10;
constexpr double kCellsPerAxis = 1 << kBitsPerAxis;
/// Points processed together.
constexpr std::int64_t kBlock = 4096;
constexpr int kDigitBits = 10;
constexpr int kDigits = 3 * kBitsPerAxis / kDigitBits;
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
};

/// Turns points into keyed entries, some at once.
class Keyer
{
public:
  Keyer(const simd::NeighborKernels& kernels, const Grid& grid, Entry* to)
    : kernels_(kernels)
    , grid_(grid)
    , to_(to)
  {
  }
  void add(const Vec3& p, std::uint32_t index)
  {
    x_[count_] = grid_.cell(p.x, 0);
    y_[count_] = grid_.cell(p.y, 1);
    z_[count_] = grid_.cell(p.z, 2);
    indices_[count_] = index;
    if (++count_ == kTogether)
    {
      flush();
    }
  }
  void flush()
  {
    kernels_.hilbertKeys(x_, y_, z_, count_, keys_);
    for (int i = 0; i < count_; ++i)
    {
      *to_++ = Entry(keys_[i]) << 32 | indices_[i];
    }
    count_ = 0;
  }

private:
  static constexpr int kTogether = 256;

  const simd::NeighborKernels& kernels_;
  const Grid& grid_;
  Entry* to_;
  int count_ = 0;
  std::uint32_t x_[kTogether];
  std::uint32_t y_[kTogether];
  std::uint32_t z_[kTogether];
  std::uint32_t indices_[kTogether];
  std::uint32_t keys_[kTogether];
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
    spare_.resize(entries_.size());
    fill(Grid(box));
    const std::int64_t count = std::int64_t(entries_.size());
    sortRun({ 0, count });
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
  struct Block
  {
    Bounds box;
    std::int64_t count = 0;
    std::int64_t first = 0;
  };

  template <typename Function>
  void forBlocks(Function&& function)
  {
    forRange(executor_, std::int64_t(blocks_.size()), 1,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t b = begin; b < end; ++b)
        {
          function(blocks_[std::size_t(b)], b * kBlock, std::min(points_.size(), (b + 1) * kBlock));
        }
      });
  }

  /// Counts the finite points, block by block, and makes room for them. @return their bounds.
  Bounds survey()
  {
    blocks_.resize(std::size_t((points_.size() + kBlock - 1) / kBlock));
    forBlocks(
      [this](Block& block, std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          const Vec3 p = points_[i];
          if (isFinite(p))
          {
            block.box.include(p);
            ++block.count;
          }
        }
      });
    Bounds box;
    std::int64_t count = 0;
    for (Block& block : blocks_)
    {
      block.first = count;
      count += block.count;
      if (block.count > 0)
      {
        box.include(block.box.minimum);
        box.include(block.box.maximum);
      }
    }
    entries_.resize(std::size_t(count));
    return box;
  }

  void fill(const Grid& grid)
  {
    forBlocks(
      [&](Block& block, std::int64_t begin, std::int64_t end)
      {
        Keyer keyer(kernels_, grid, entries_.data() + block.first);
        for (std::int64_t i = begin; i < end; ++i)
        {
          const Vec3 p = points_[i];
          if (isFinite(p))
          {
            keyer.add(p, std::uint32_t(i));
          }
        }
        keyer.flush();
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
    constexpr std::uint32_t kMask = (1u << kDigitBits) - 1u;
    std::array<std::array<std::uint32_t, kMask + 1>, kDigits> places{};
    for (std::int64_t i = run.begin; i < run.end; ++i)
    {
      const std::uint32_t key = keyOf(entries_[std::size_t(i)]);
      for (int digit = 0; digit < kDigits; ++digit)
      {
        ++places[std::size_t(digit)][key >> (digit * kDigitBits) & kMask];
      }
    }
    Entry* from = entries_.data() + run.begin;
    Entry* to = spare_.data() + run.begin;
    const std::int64_t count = run.end - run.begin;
    for (int digit = 0; digit < kDigits; ++digit)
    {
      std::array<std::uint32_t, kMask + 1>& place = places[std::size_t(digit)];
      std::uint32_t sum = 0;
      for (std::uint32_t& p : place)
      {
        sum += std::exchange(p, sum);
      }
      for (std::int64_t i = 0; i < count; ++i)
      {
        to[place[keyOf(from[i]) >> (digit * kDigitBits) & kMask]++] = from[i];
      }
      std::swap(from, to);
    }
    std::copy(from, from + count, entries_.data() + run.begin);
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
    Keyer keyer(kernels_, grid, entries_.data() + run.begin);
    for (std::int64_t i = run.begin; i < run.end; ++i)
    {
      const std::uint32_t index = indexOf(entries_[std::size_t(i)]);
      keyer.add(points_[index], index);
    }
    keyer.flush();
    sortRun(run);
    collectOverfullCells(run);
  }

  const PointView& points_;
  const std::int64_t mostPerCell_;
  const Executor& executor_;
  const simd::NeighborKernels& kernels_ = simd::neighborKernels();
  std::vector<Block> blocks_;
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
