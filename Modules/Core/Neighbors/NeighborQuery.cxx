#include "Core/Neighbors/NeighborQuery.h"

#include "Core/Neighbors/SpatialOrder.h"

#include <algorithm>
#include <atomic>

namespace pointhaptics
{
namespace
{

using simd::BoxGroup;
using simd::kBranches;
using simd::kLeafPoints;

static_assert(NeighborQuery::kMostPoints == kMostOrderedPoints, "the order takes as many");

std::int64_t quotientUp(std::int64_t a, std::int64_t b)
{
  return (a + b - 1) / b;
}

void setBox(BoxGroup& group, int box, const Bounds& bounds, std::uint32_t firstIndex)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    group.low[axis][box] = bounds.minimum[axis];
    group.high[axis][box] = bounds.maximum[axis];
  }
  group.firstIndex[box] = firstIndex;
}

}

void NeighborQuery::build(const PointView& points, const Executor& executor)
{
  tree_ = {};
  indices_ = spatialOrder(points, kLeafPoints, executor);
  repeats_.clear();
  tree_.size = std::int64_t(indices_.size());
  if (tree_.size == 0)
  {
    return;
  }
  copyPoints(points, executor);
  dropRepeats(executor);
  std::int64_t boxes = quotientUp(tree_.size, kLeafPoints);
  do
  {
    const int level = tree_.levels++;
    tree_.boxes[level] = boxes;
    boxes = quotientUp(boxes, kBranches);
    groups_[level].resize(std::size_t(boxes));
    tree_.groups[level] = groups_[level].data();
    level == 0 ? boundLeaves(executor) : boundGroups(level, executor);
  } while (boxes > 1);
}

void NeighborQuery::copyPoints(const PointView& points, const Executor& executor)
{
  const std::size_t padded = std::size_t(quotientUp(tree_.size, kLeafPoints) * kLeafPoints);
  for (int axis = 0; axis < 3; ++axis)
  {
    places_[axis].resize(padded);
    tree_.places[axis] = places_[axis].data();
  }
  forEachIndex(executor, tree_.size,
    [&](std::int64_t slot)
    {
      const Vec3 p = points[indices_[std::size_t(slot)]];
      places_[0][std::size_t(slot)] = p.x;
      places_[1][std::size_t(slot)] = p.y;
      places_[2][std::size_t(slot)] = p.z;
    });
}

/// The slot of the same place among those before @p slot, or -1. Points of one place share a cell of the
/// order, which holds at most a leaf's points of several places.
std::int64_t NeighborQuery::sameBefore(const Vec3& place, std::int64_t slot) const
{
  const std::int64_t first = std::max<std::int64_t>(0, slot - kLeafPoints);
  while (--slot >= first)
  {
    if (place == point(slot))
    {
      return slot;
    }
  }
  return -1;
}

/// Keeps the first point of each place, pads the last leaf, and publishes the memory in the tree.
void NeighborQuery::dropRepeats(const Executor& executor)
{
  std::atomic<bool> repeats{ false };
  forEachIndex(executor, tree_.size,
    [&](std::int64_t slot)
    {
      if (!repeats.load(std::memory_order_relaxed) && sameBefore(point(slot), slot) >= 0)
      {
        repeats.store(true, std::memory_order_relaxed);
      }
    });
  std::int64_t kept = repeats ? 0 : tree_.size;
  for (std::int64_t slot = kept; slot < tree_.size; ++slot)
  {
    const Vec3 place = point(slot);
    const std::uint32_t index = indices_[std::size_t(slot)];
    const std::int64_t same = sameBefore(place, kept);
    if (same >= 0)
    {
      repeats_.push_back({ index, std::uint32_t(same) });
      continue;
    }
    indices_[std::size_t(kept)] = index;
    for (int axis = 0; axis < 3; ++axis)
    {
      places_[axis][std::size_t(kept)] = place[axis];
    }
    ++kept;
  }
  tree_.size = kept;
  indices_.resize(std::size_t(kept));
  tree_.indices = indices_.data();
  for (std::vector<double>& ofAxis : places_)
  {
    ofAxis.resize(std::size_t(quotientUp(kept, kLeafPoints) * kLeafPoints));
    std::fill(ofAxis.begin() + kept, ofAxis.end(), NAN);
  }
}

void NeighborQuery::boundLeaves(const Executor& executor)
{
  forRange(executor, tree_.boxes[0], kSmallestPiece / kLeafPoints,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t leaf = begin; leaf < end; ++leaf)
      {
        Bounds bounds;
        const std::int64_t first = leaf * kLeafPoints;
        const std::int64_t last = std::min(first + kLeafPoints, tree_.size);
        for (std::int64_t slot = first; slot < last; ++slot)
        {
          bounds.include(point(slot));
        }
        const std::uint32_t least = *std::min_element(indices_.begin() + first, indices_.begin() + last);
        setBox(groups_[0][std::size_t(leaf / kBranches)], int(leaf % kBranches), bounds, least);
      }
    });
}

void NeighborQuery::boundGroups(int level, const Executor& executor)
{
  forEachIndex(executor, tree_.boxes[level],
    [&](std::int64_t child)
    {
      const BoxGroup& below = groups_[level - 1][std::size_t(child)];
      const int boxes = simd::boxesOf(tree_, level - 1, child);
      Bounds bounds;
      for (int box = 0; box < boxes; ++box)
      {
        bounds.include({ below.low[0][box], below.low[1][box], below.low[2][box] });
        bounds.include({ below.high[0][box], below.high[1][box], below.high[2][box] });
      }
      const std::uint32_t least = *std::min_element(below.firstIndex, below.firstIndex + boxes);
      setBox(groups_[level][std::size_t(child / kBranches)], int(child % kBranches), bounds, least);
    });
}

int NeighborQuery::nearest(const Vec3& center, int k, Neighbor* neighbors) const noexcept
{
  const int count = nearestSlots(center, k, neighbors);
  for (int i = 0; i < count; ++i)
  {
    neighbors[i].index >>= kSlotBits;
  }
  return count;
}

/// The best so far: sorted where they are few, else a heap.
struct NeighborQuery::Search
{
  Vec3 center;
  int k;
  Neighbor* best;
  int count;

  static constexpr int kFew = 64;

  bool few() const { return k <= kFew; }
  bool full() const { return count == k; }
  const Neighbor& worst() const { return few() ? best[count - 1] : best[0]; }
  double reach() const { return full() ? worst().squaredDistance : INFINITY; }

  void offer(const Neighbor& candidate)
  {
    if (full() && !(candidate < worst()))
    {
      return;
    }
    few() ? insert(candidate) : push(candidate);
  }
  void insert(const Neighbor& candidate)
  {
    int to = full() ? count - 1 : count++;
    for (; to > 0 && candidate.squaredDistance < best[to - 1].squaredDistance; --to)
    {
      best[to] = best[to - 1];
    }
    for (; to > 0 && candidate < best[to - 1]; --to)
    {
      best[to] = best[to - 1];
    }
    best[to] = candidate;
  }
  void push(const Neighbor& candidate)
  {
    if (full())
    {
      std::pop_heap(best, best + count--);
    }
    best[count++] = candidate;
    std::push_heap(best, best + count);
  }
};

int NeighborQuery::nearestSlots(const Vec3& center, int k, Neighbor* neighbors) const noexcept
{
  Search search{ center, k, neighbors, 0 };
  if (k > 0 && size() > 0)
  {
    searchGroup(tree_.levels - 1, 0, search);
    if (!search.few())
    {
      std::sort_heap(neighbors, neighbors + search.count);
    }
  }
  return search.count;
}

/// Boxes nearer first; of those as near as the k-th neighbour only those that may hold a smaller index.
void NeighborQuery::searchGroup(int level, std::int64_t group, Search& search) const noexcept
{
  const BoxGroup& boxes = tree_.groups[level][group];
  double gaps[kBranches];
  for (int box = 0; box < kBranches; ++box)
  {
    gaps[box] = simd::squaredGap(boxes, box, &search.center.x);
  }
  for (unsigned left = (1u << simd::boxesOf(tree_, level, group)) - 1u; left != 0;)
  {
    int next = __builtin_ctz(left);
    for (unsigned others = left & (left - 1u); others != 0; others &= others - 1u)
    {
      const int other = __builtin_ctz(others);
      next = gaps[other] < gaps[next] ? other : next;
    }
    left &= ~(1u << next);
    const Neighbor least{ gaps[next], std::int64_t(boxes.firstIndex[next]) << kSlotBits };
    if (search.full() && least.squaredDistance > search.worst().squaredDistance)
    {
      return;
    }
    if (!search.full() || least < search.worst())
    {
      const std::int64_t below = group * kBranches + next;
      level > 0 ? searchGroup(level - 1, below, search) : searchLeaf(below, search);
    }
  }
}

void NeighborQuery::searchLeaf(std::int64_t leaf, Search& search) const noexcept
{
  visitLeaf(leaf, search.center, search.reach(),
    [&](double d2, std::int64_t slot) {
      search.offer({ d2, packed(slot) });
    });
}

} // namespace pointhaptics
