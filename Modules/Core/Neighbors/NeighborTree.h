/// @file
/// The data of neighbour search: points in spatial order in leaves, and boxes about them. Private to Core:
/// NeighborQuery holds the memory, the loops of NeighborKernel.h traverse it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pointhaptics
{
namespace simd
{

/// Points of a leaf; the last one may have fewer.
constexpr int kLeafPoints = 16;
/// Boxes of a group.
constexpr int kBranches = 8;
/// Enough for 2^31 points.
constexpr int kMostLevels = 10;

/// Boxes of up to eight leaves or groups, and the smallest index of a point in each.
struct BoxGroup
{
  double low[3][kBranches];
  double high[3][kBranches];
  std::uint32_t firstIndex[kBranches];
};

/// A slot is an index in spatial order: leaf l has the slots from l kLeafPoints. On level 0 group g has the
/// boxes of the leaves from 8 g, on level l those of the groups from 8 g of level l - 1. The last level is
/// one group.
struct NeighborTree
{
  /// Coordinates by slot, NaN from size to a full leaf.
  const double* places[3] = {};
  const std::uint32_t* indices = nullptr; ///< Indices of the points in the cloud, by slot.
  std::int64_t size = 0;
  int levels = 0;
  const BoxGroup* groups[kMostLevels] = {};
  std::int64_t boxes[kMostLevels] = {}; ///< Leaves or groups below, of each level.
};

/// Squared distance of a point from a box: rounded as that between two points is, so that it is never above
/// that of a point in the box.
static inline double squaredGap(const BoxGroup& group, int box, const double* center)
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double below = group.low[axis][box] - center[axis];
    const double above = center[axis] - group.high[axis][box];
    const double most = below > above ? below : above;
    const double gap = most > 0.0 ? most : 0.0;
    sum += gap * gap;
  }
  return sum;
}

/// Boxes in use of a group.
static inline int boxesOf(const NeighborTree& tree, int level, std::int64_t group)
{
  const std::int64_t left = tree.boxes[level] - group * kBranches;
  return left < kBranches ? int(left) : kBranches;
}

} // namespace simd
} // namespace pointhaptics
