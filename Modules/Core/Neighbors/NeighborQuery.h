/// @file
/// Exact neighbours of a point: k nearest, or all in a ball.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/PointView.h"
#include "Core/Neighbors/NeighborTree.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// A point that a query found.
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

/// The places of the finite points in the order of SpatialOrder.h, sixteen to a leaf, and a tree of boxes
/// about the leaves, eight to a group. Points at one place are one neighbour, with the index of the first of
/// them: how often a file repeats a point tells nothing of the surface. Queries are exact: equal to brute
/// force in double numbers, ties broken by index. They allocate nothing beyond what the caller passes in,
/// loop no further than the tree, and may run in any number of threads after build(), the servo thread among
/// them. Any density and extent is fine. For the neighbours of all points at once use NeighborSweep, which is
/// several times as fast. build(): O(n), see SpatialOrder.h; 32 bytes a place, 8 a repeated point, and 16 a
/// point more while it runs. nearest(): O(log n + k log k) as a rule, 2 us for 17 of 200,000 points.
class NeighborQuery
{
public:
  /// More points than these (2^31 - 1) are not taken: the query stays empty.
  static constexpr std::int64_t kMostPoints = (std::int64_t(1) << 31) - 1;

  /// Points that are not finite are left out. Independent of @p executor.
  void build(const PointView& points, const Executor& executor = {});

  /// Places held.
  std::int64_t size() const { return tree_.size; }
  /// Finite points given to build().
  std::int64_t finitePoints() const { return size() + std::int64_t(repeats_.size()); }
  /// Calls visit(index, slot) for each point at the place of an earlier one.
  template <typename Visitor>
  void visitRepeats(Visitor&& visit) const
  {
    for (const Repeat& repeat : repeats_)
    {
      visit(std::int64_t(repeat.index), std::int64_t(repeat.slot));
    }
  }
  /// value(index) for each slot; join(a, b) of them where several points are at the place.
  template <typename Value, typename Join>
  std::vector<double> valuesOfPlaces(Value&& value, Join&& join) const
  {
    std::vector<double> values(indices_.size());
    for (std::size_t slot = 0; slot < values.size(); ++slot)
    {
      values[slot] = value(index(std::int64_t(slot)));
    }
    visitRepeats([&](std::int64_t repeated, std::int64_t slot)
      { values[std::size_t(slot)] = join(values[std::size_t(slot)], value(repeated)); });
    return values;
  }
  /// Gives repeated points the value of the first one. @param values one for each point given to build().
  template <typename T>
  void copyToRepeats(std::vector<T>& values) const
  {
    visitRepeats([&](std::int64_t repeated, std::int64_t slot)
      { values[std::size_t(repeated)] = values[std::size_t(index(slot))]; });
  }

  /// The min(k, size()) nearest places, nearest first, written to @p neighbors (room for k). @return how
  /// many.
  int nearest(const Vec3& center, int k, Neighbor* neighbors) const noexcept;

  /// Calls visit(point, squaredDistance, index) for each place with distance <= radius, in no stated order.
  template <typename Visitor>
  void visitBall(const Vec3& center, double radius, Visitor&& visit) const
  {
    visitBallSlots(center, radius,
      [&](double squaredDistance, std::int64_t slot) { visit(point(slot), squaredDistance, index(slot)); });
  }

  // The places by slot: their rank in spatial order, 0 to size() - 1.
  Vec3 point(std::int64_t slot) const
  {
    return { tree_.places[0][slot], tree_.places[1][slot], tree_.places[2][slot] };
  }
  std::int64_t index(std::int64_t slot) const { return std::int64_t(tree_.indices[slot]); }
  /// nearest() with the slot beside the index: Neighbor::index is packed(slot).
  int nearestSlots(const Vec3& center, int k, Neighbor* neighbors) const noexcept;
  /// Calls visit(squaredDistance, slot) as visitBall does.
  template <typename Visitor>
  void visitBallSlots(const Vec3& center, double radius, Visitor&& visit) const
  {
    if (size() > 0)
    {
      visitGroup(tree_.levels - 1, 0, center, radius * radius, visit);
    }
  }
  /// Index and slot in one number that compares as the index does.
  std::int64_t packed(std::int64_t slot) const { return index(slot) << kSlotBits | slot; }
  static std::int64_t slotOf(const Neighbor& packed) { return packed.index & kSlotMask; }

  const simd::NeighborTree& tree() const { return tree_; }

  NeighborQuery() = default;
  NeighborQuery(const NeighborQuery&) = delete;
  NeighborQuery& operator=(const NeighborQuery&) = delete;

private:
  static constexpr int kSlotBits = 32;
  static constexpr std::int64_t kSlotMask = (std::int64_t(1) << kSlotBits) - 1;

  struct Search;
  struct Repeat
  {
    std::uint32_t index;
    std::uint32_t slot; ///< the one of its place
  };
  void copyPoints(const PointView& points, const Executor& executor);
  std::int64_t sameBefore(const Vec3& place, std::int64_t slot) const;
  void dropRepeats(const Executor& executor);
  void boundLeaves(const Executor& executor);
  void boundGroups(int level, const Executor& executor);
  void searchGroup(int level, std::int64_t group, Search& search) const noexcept;
  void searchLeaf(std::int64_t leaf, Search& search) const noexcept;

  template <typename Visitor>
  void visitGroup(int level, std::int64_t group, const Vec3& center, double r2, Visitor& visit) const
  {
    const simd::BoxGroup& boxes = tree_.groups[level][group];
    for (int box = 0; box < simd::boxesOf(tree_, level, group); ++box)
    {
      if (simd::squaredGap(boxes, box, &center.x) > r2)
      {
        continue;
      }
      const std::int64_t child = group * simd::kBranches + box;
      if (level > 0)
      {
        visitGroup(level - 1, child, center, r2, visit);
      }
      else
      {
        visitLeaf(child, center, r2, visit);
      }
    }
  }
  template <typename Visitor>
  void visitLeaf(std::int64_t leaf, const Vec3& center, double r2, Visitor&& visit) const
  {
    const std::int64_t begin = leaf * simd::kLeafPoints;
    const std::int64_t end = begin + simd::kLeafPoints < size() ? begin + simd::kLeafPoints : size();
    for (std::int64_t slot = begin; slot < end; ++slot)
    {
      const double d2 = norm2(point(slot) - center);
      if (d2 <= r2)
      {
        visit(d2, slot);
      }
    }
  }

  std::vector<std::uint32_t> indices_;
  std::vector<Repeat> repeats_;
  std::vector<double> places_[3];
  std::vector<simd::BoxGroup> groups_[simd::kMostLevels];
  simd::NeighborTree tree_;
};

} // namespace pointhaptics
