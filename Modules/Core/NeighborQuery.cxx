#include "Core/NeighborQuery.h"

#include <algorithm>

namespace pointhaptics
{

void NeighborQuery::build(const PointView& points)
{
  nodes_.clear();
  nodes_.reserve(std::size_t(points.size()));
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p = points[i];
    if (isFinite(p))
    {
      nodes_.push_back({ p, i, 0 });
    }
  }
  split(0, size());
}

/// Halves the longest axis at the median, again and again; the depth is the logarithm of the size.
void NeighborQuery::split(std::int64_t first, std::int64_t last)
{
  if (last - first <= kLeafSize)
  {
    return;
  }
  Bounds box;
  for (std::int64_t i = first; i < last; ++i)
  {
    box.include(nodes_[std::size_t(i)].point);
  }
  const Vec3 extent = box.extent();
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::int64_t middle = first + (last - first) / 2;
  std::nth_element(nodes_.begin() + first, nodes_.begin() + middle, nodes_.begin() + last,
    [axis](const Node& a, const Node& b)
    { return a.point[axis] != b.point[axis] ? a.point[axis] < b.point[axis] : a.index < b.index; });
  nodes_[std::size_t(middle)].axis = axis;
  split(first, middle);
  split(middle + 1, last);
}

int NeighborQuery::nearest(const Vec3& center, int k, Neighbor* neighbors) const noexcept
{
  int count = 0;
  if (k > 0 && !nodes_.empty())
  {
    search(0, size(), center, k, neighbors, count);
    std::sort_heap(neighbors, neighbors + count);
  }
  return count;
}

void NeighborQuery::search(
  std::int64_t first, std::int64_t last, const Vec3& center, int k, Neighbor* heap, int& count) const noexcept
{
  const auto offer = [&](const Node& node)
  {
    const Neighbor candidate = { norm2(node.point - center), node.index };
    if (count < k)
    {
      heap[count++] = candidate;
      std::push_heap(heap, heap + count);
    }
    else if (candidate < heap[0])
    {
      std::pop_heap(heap, heap + count);
      heap[count - 1] = candidate;
      std::push_heap(heap, heap + count);
    }
  };
  if (last - first <= kLeafSize)
  {
    for (std::int64_t i = first; i < last; ++i)
    {
      offer(nodes_[std::size_t(i)]);
    }
    return;
  }
  const std::int64_t middle = first + (last - first) / 2;
  const Node& node = nodes_[std::size_t(middle)];
  const double side = center[node.axis] - node.point[node.axis];
  // The half the centre lies in first; the other only if the ball of the k-th neighbour reaches it. Equal
  // distance counts as reaching: a smaller index may wait there.
  const bool lowFirst = side < 0.0;
  search(lowFirst ? first : middle + 1, lowFirst ? middle : last, center, k, heap, count);
  offer(node);
  if (count < k || side * side <= heap[0].squaredDistance)
  {
    search(lowFirst ? middle + 1 : first, lowFirst ? last : middle, center, k, heap, count);
  }
}

} // namespace pointhaptics
