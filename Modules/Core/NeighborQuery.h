/// @file
/// Exact neighbours of a point: k nearest, or all in a ball.
#pragma once

#include "Core/PointView.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

struct Neighbor
{
  double squaredDistance = 0.0;
  std::int64_t index = 0; ///< In the points as given to build().
};

/// Nearer first; at equal distance the smaller index.
inline bool operator<(const Neighbor& a, const Neighbor& b)
{
  return a.squaredDistance != b.squaredDistance ? a.squaredDistance < b.squaredDistance : a.index < b.index;
}

/// A balanced k-d tree over a copy of the finite points. Queries are exact (equal to brute force, ties broken
/// by index), allocate nothing beyond what the caller passes in, and may run in any number of threads after
/// build(). build(): O(n log n), 48 bytes a point. Duplicates and any density are fine.
class NeighborQuery
{
public:
  /// Points that are not finite are left out.
  void build(const PointView& points);

  /// Finite points held.
  std::int64_t size() const { return std::int64_t(nodes_.size()); }

  /// The min(k, size()) nearest points, nearest first, written to @p neighbors (room for k). @return how
  /// many.
  int nearest(const Vec3& center, int k, Neighbor* neighbors) const noexcept;

  /// Calls visit(point, squaredDistance, index) for each point with distance <= radius, in no stated order.
  template <typename Visitor>
  void visitBall(const Vec3& center, double radius, Visitor&& visit) const
  {
    if (!nodes_.empty())
    {
      visitRange(0, size(), center, radius * radius, visit);
    }
  }

private:
  struct Node
  {
    Vec3 point;
    std::int64_t index;
    int axis;
  };
  static constexpr std::int64_t kLeafSize = 8;

  void split(std::int64_t first, std::int64_t last);
  void search(std::int64_t first, std::int64_t last, const Vec3& center, int k, Neighbor* heap,
    int& count) const noexcept;

  template <typename Visitor>
  void visitRange(std::int64_t first, std::int64_t last, const Vec3& center, double r2, Visitor& visit) const
  {
    if (last - first <= kLeafSize)
    {
      for (std::int64_t i = first; i < last; ++i)
      {
        visitNode(nodes_[std::size_t(i)], center, r2, visit);
      }
      return;
    }
    const std::int64_t middle = first + (last - first) / 2;
    const Node& node = nodes_[std::size_t(middle)];
    const double side = center[node.axis] - node.point[node.axis];
    if (side <= 0.0 || side * side <= r2)
    {
      visitRange(first, middle, center, r2, visit);
    }
    visitNode(node, center, r2, visit);
    if (side >= 0.0 || side * side <= r2)
    {
      visitRange(middle + 1, last, center, r2, visit);
    }
  }
  template <typename Visitor>
  static void visitNode(const Node& node, const Vec3& center, double r2, Visitor& visit)
  {
    const double d2 = norm2(node.point - center);
    if (d2 <= r2)
    {
      visit(node.point, d2, node.index);
    }
  }

  std::vector<Node> nodes_;
};

} // namespace pointhaptics
