/// @file
/// The loops of NeighborKernel.h over a set of vector operations. Included by one source per instruction set;
/// all is in an anonymous namespace, so that the linker cannot choose one set's version for the others.
///
/// A set has: width; Doubles, Counts, Mask; all, load, add, subtract, multiply, maximum (the second
/// where one is NaN); atMost (a <= b),
/// bits; none, countLess (counts + 1 where a < b), store; compress, which stores the chosen lanes one after
/// the other, and lanes, which stores first + their numbers. Both may write a whole vector.
#pragma once

#include "Core/Neighbors/HilbertKeyBody.h"
#include "Core/Neighbors/NeighborKernel.h"
#include "Core/Neighbors/NeighborOrderBody.h"

#include <limits>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Attempts at a leaf, and how much farther each looks than the one before, squared.
constexpr int kAttempts = 3;
constexpr double kFarther = 2.5;
/// How much farther than the k-th neighbour of the point before to look first, squared: for a point, and for
/// all points of the next leaf.
constexpr double kPointMargin = 1.5;
constexpr double kLeafMargin = 1.2;
/// Candidates beyond half as many again as are wanted that make it worth while to lower a single search's
/// reach.
constexpr int kSurplus = 4;

struct Box
{
  double low[3];
  double high[3];
};

Box boxOfLeaf(const NeighborTree& tree, std::int64_t leaf)
{
  const BoxGroup& group = tree.groups[0][leaf / kBranches];
  const int lane = int(leaf % kBranches);
  Box box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] = group.low[axis][lane];
    box.high[axis] = group.high[axis][lane];
  }
  return box;
}

/// Squared distance between boxes, rounded as that between two points is: never above that of any two points
/// in them.
template <typename Set>
typename Set::Doubles squaredGap(
  const Box& box, const double* const (&low)[3], const double* const (&high)[3], int at)
{
  typename Set::Doubles sum = Set::all(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto below = Set::subtract(Set::all(box.low[axis]), Set::load(high[axis] + at));
    const auto above = Set::subtract(Set::load(low[axis] + at), Set::all(box.high[axis]));
    // A place that is NaN, behind the last point, must stay one: maximum gives its second argument then.
    const auto gap = Set::maximum(Set::all(0.0), Set::maximum(below, above));
    const auto square = Set::multiply(gap, gap);
    sum = axis == 0 ? square : Set::add(sum, square);
  }
  return sum;
}

template <typename Set>
unsigned boxesWithin(const BoxGroup& group, const Box& box, double reach)
{
  const double* const low[3] = { group.low[0], group.low[1], group.low[2] };
  const double* const high[3] = { group.high[0], group.high[1], group.high[2] };
  unsigned within = 0;
  for (int at = 0; at < kBranches; at += Set::width)
  {
    within |= Set::bits(Set::atMost(squaredGap<Set>(box, low, high, at), Set::all(reach))) << at;
  }
  return within;
}

/// Adds the points of @p leaf within @p reach of @p box to the candidates.
template <typename Set>
void appendLeaf(const NeighborTree& tree, std::int64_t leaf, const Box& box, double reach, LeafSearch& search)
{
  const std::int64_t first = leaf * kLeafPoints;
  const double* const places[3] = { tree.places[0] + first, tree.places[1] + first, tree.places[2] + first };
  int to = search.candidates;
  for (int at = 0; at < kLeafPoints; at += Set::width)
  {
    const auto mask = Set::atMost(squaredGap<Set>(box, places, places, at), Set::all(reach));
    const unsigned bits = Set::bits(mask);
    for (int axis = 0; axis < 3; ++axis)
    {
      Set::compress(search.places[axis] + to, bits, Set::load(places[axis] + at));
    }
    Set::lanes(search.slots + to, bits, std::uint32_t(first + at));
    to += __builtin_popcount(bits);
  }
  search.candidates = to;
}

/// All points within @p reach of @p box. @return false where they are too many.
template <typename Set>
bool gather(const NeighborTree& tree, const Box& box, double reach, LeafSearch& search)
{
  struct Place
  {
    int level;
    std::int64_t group;
  };
  Place stack[kMostLevels * kBranches];
  int depth = 0;
  stack[depth++] = { tree.levels - 1, 0 };
  search.candidates = 0;
  while (depth > 0)
  {
    const Place here = stack[--depth];
    unsigned within = boxesWithin<Set>(tree.groups[here.level][here.group], box, reach);
    within &= (1u << boxesOf(tree, here.level, here.group)) - 1u;
    for (; within != 0; within &= within - 1u)
    {
      const std::int64_t child = here.group * kBranches + __builtin_ctz(within);
      if (here.level > 0)
      {
        stack[depth++] = { here.level - 1, child };
      }
      else if (search.candidates + kLeafPoints > search.mostCandidates)
      {
        return false;
      }
      else
      {
        appendLeaf<Set>(tree, child, box, reach, search);
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < kSlack; ++i)
    {
      search.places[axis][search.candidates + i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return true;
}

/// Lists the candidates within @p reach of a point. @return their number.
template <typename Set>
int listNear(const double (&center)[3], double reach, LeafSearch& search)
{
  const auto x = Set::all(center[0]);
  const auto y = Set::all(center[1]);
  const auto z = Set::all(center[2]);
  const auto limit = Set::all(reach);
  // Stores of vectors may alias the pointers: copies of these stay in registers.
  const double* const places[3] = { search.places[0], search.places[1], search.places[2] };
  double* const near = search.near;
  std::uint32_t* const numbers = search.nearCandidates;
  const int candidates = search.candidates;
  int count = 0;
  for (int at = 0; at < candidates; at += Set::width)
  {
    const auto dx = Set::subtract(Set::load(places[0] + at), x);
    const auto dy = Set::subtract(Set::load(places[1] + at), y);
    const auto dz = Set::subtract(Set::load(places[2] + at), z);
    const auto d2 = Set::add(Set::add(Set::multiply(dx, dx), Set::multiply(dy, dy)), Set::multiply(dz, dz));
    const unsigned bits = Set::bits(Set::atMost(d2, limit));
    Set::compress(near + count, bits, d2);
    Set::lanes(numbers + count, bits, std::uint32_t(at));
    count += __builtin_popcount(bits);
  }
  return count;
}

/// @param reach what the candidates are complete to. @param first where to look first, at most reach.
/// @return the squared distance of the k-th neighbour; below 0 where it was not found.
template <typename Set>
double searchPoint(
  const NeighborTree& tree, std::int64_t slot, int at, double first, double reach, LeafSearch& search)
{
  const double center[3] = { tree.places[0][slot], tree.places[1][slot], tree.places[2][slot] };
  double limit = first;
  int count = listNear<Set>(center, limit, search);
  if (count < search.k && limit < reach)
  {
    limit = reach;
    count = listNear<Set>(center, limit, search);
  }
  if (count > search.mostNear)
  {
    // On a surface the number grows like the squared distance.
    limit *= 0.5 * (search.k + search.mostNear) / count;
    count = listNear<Set>(center, limit, search);
  }
  if (count < search.k || count > search.mostNear)
  {
    return -1.0;
  }
  answer<Set>(tree, at, count, limit, search);
  return distancesOf(search, at)[search.k - 1];
}

/// Points at one place stand side by side and have one answer. @return whether it was there to be copied from
/// the point before.
bool copyFromTwin(const NeighborTree& tree, std::int64_t slot, int at, LeafSearch& search)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (at == 0 || tree.places[axis][slot] != tree.places[axis][slot - 1])
    {
      return false;
    }
  }
  if ((search.found >> (at - 1) & 1u) == 0)
  {
    return false;
  }
  // No algorithm of the standard library: the linker could choose its version for another instruction set.
  for (int i = 0; i < search.k; ++i)
  {
    distancesOf(search, at)[i] = distancesOf(search, at - 1)[i];
    neighborsOf(search, at)[i] = neighborsOf(search, at - 1)[i];
  }
  search.found |= 1u << at;
  return true;
}

/// @return the largest squared distance found, 0 for none.
template <typename Set>
double searchPoints(const NeighborTree& tree, std::int64_t leaf, double reach, LeafSearch& search)
{
  const std::int64_t first = leaf * kLeafPoints;
  const int points = tree.size - first < kLeafPoints ? int(tree.size - first) : kLeafPoints;
  double largest = 0.0;
  double near = reach;
  for (int at = 0; at < points; ++at)
  {
    if ((search.found >> at & 1u) == 0 && !copyFromTwin(tree, first + at, at, search))
    {
      const double d2 = searchPoint<Set>(tree, first + at, at, near, reach, search);
      largest = d2 > largest ? d2 : largest;
      near = d2 >= 0.0 && d2 * kPointMargin < reach ? d2 * kPointMargin : reach;
    }
  }
  return largest;
}

template <typename Set>
void searchLeaf(const NeighborTree& tree, std::int64_t leaf, LeafSearch& search)
{
  const Box box = boxOfLeaf(tree, leaf);
  const std::int64_t left = tree.size - leaf * kLeafPoints;
  const unsigned all = (1u << (left < kLeafPoints ? left : kLeafPoints)) - 1u;
  search.found = 0;
  double largest = 0.0;
  double reach = search.reach;
  for (int attempt = 0; attempt < kAttempts && search.found != all; ++attempt)
  {
    if (!gather<Set>(tree, box, reach, search))
    {
      break;
    }
    const double d2 = searchPoints<Set>(tree, leaf, reach, search);
    largest = d2 > largest ? d2 : largest;
    reach *= kFarther;
  }
  search.reach = search.found == all ? kLeafMargin * largest : 0.0;
}

/// Squared distances of the points from @p slot on, one vector of them.
template <typename Set>
typename Set::Doubles squaredDistances(const NeighborTree& tree, std::int64_t slot, const double (&center)[3])
{
  const auto dx = Set::subtract(Set::load(tree.places[0] + slot), Set::all(center[0]));
  const auto dy = Set::subtract(Set::load(tree.places[1] + slot), Set::all(center[1]));
  const auto dz = Set::subtract(Set::load(tree.places[2] + slot), Set::all(center[2]));
  return Set::add(Set::add(Set::multiply(dx, dx), Set::multiply(dy, dy)), Set::multiply(dz, dz));
}

template <typename Set>
unsigned leafDistances(const NeighborTree& tree, std::int64_t leaf, const double (&center)[3], double reach,
  double (&distances)[kLeafPoints])
{
  const std::int64_t first = leaf * kLeafPoints;
  unsigned within = 0;
  for (int at = 0; at < kLeafPoints; at += Set::width)
  {
    const auto d2 = squaredDistances<Set>(tree, first + at, center);
    Set::store(distances + at, d2);
    within |= Set::bits(Set::atMost(d2, Set::all(reach))) << at;
  }
  return within;
}

template <typename Set>
void groupGaps(const BoxGroup& group, const double (&center)[3], double (&gaps)[kBranches])
{
  const Box box = { { center[0], center[1], center[2] }, { center[0], center[1], center[2] } };
  const double* const low[3] = { group.low[0], group.low[1], group.low[2] };
  const double* const high[3] = { group.high[0], group.high[1], group.high[2] };
  for (int at = 0; at < kBranches; at += Set::width)
  {
    Set::store(gaps + at, squaredGap<Set>(box, low, high, at));
  }
}

/// The search about one place: its candidates are unordered, and complete to a reach that falls now and then.
struct PlaceSearch
{
  const NeighborTree& tree;
  const double (&center)[3];
  const int k;
  LeafSearch& memory; ///< near and slots hold the candidates.
  int count = 0;
  double reach = std::numeric_limits<double>::infinity();
};

/// Lowers the reach to the k-th distance so far and leaves out what is beyond.
template <typename Set>
void lowerReach(PlaceSearch& search)
{
  LeafSearch& memory = search.memory;
  rankNear<Set>(search.count, memory);
  double reach = 0.0;
  for (int i = 0; i < search.count; ++i)
  {
    const double d2 = memory.ranks[i] < search.k ? memory.near[i] : 0.0;
    reach = d2 > reach ? d2 : reach;
  }
  int kept = 0;
  for (int i = 0; i < search.count; ++i)
  {
    memory.near[kept] = memory.near[i];
    memory.slots[kept] = memory.slots[i];
    kept += memory.near[i] <= reach ? 1 : 0;
  }
  search.count = kept;
  search.reach = reach;
}

/// @return false where too many are at the same distance.
template <typename Set>
bool searchLeafAbout(std::int64_t leaf, PlaceSearch& search)
{
  LeafSearch& memory = search.memory;
  const std::int64_t first = leaf * kLeafPoints;
  for (int at = 0; at < kLeafPoints; at += Set::width)
  {
    const auto d2 = squaredDistances<Set>(search.tree, first + at, search.center);
    const unsigned bits = Set::bits(Set::atMost(d2, Set::all(search.reach)));
    Set::compress(memory.near + search.count, bits, d2);
    Set::lanes(memory.slots + search.count, bits, std::uint32_t(first + at));
    search.count += __builtin_popcount(bits);
  }
  if (search.count >= search.k + search.k / 2 + kSurplus)
  {
    lowerReach<Set>(search);
  }
  return search.count + kLeafPoints <= kMostRanked;
}

/// Nearer boxes first; none beyond the reach.
template <typename Set>
bool searchGroupAbout(int level, std::int64_t group, PlaceSearch& search)
{
  const BoxGroup& boxes = search.tree.groups[level][group];
  double gaps[kBranches];
  groupGaps<Set>(boxes, search.center, gaps);
  unsigned left = (1u << boxesOf(search.tree, level, group)) - 1u;
  while (left != 0)
  {
    int next = __builtin_ctz(left);
    for (unsigned others = left & (left - 1u); others != 0; others &= others - 1u)
    {
      const int other = __builtin_ctz(others);
      next = gaps[other] < gaps[next] ? other : next;
    }
    left &= ~(1u << next);
    if (!(gaps[next] <= search.reach))
    {
      return true;
    }
    const std::int64_t below = group * kBranches + next;
    if (!(level > 0 ? searchGroupAbout<Set>(level - 1, below, search) : searchLeafAbout<Set>(below, search)))
    {
      return false;
    }
  }
  return true;
}

template <typename Set>
bool searchPlace(const NeighborTree& tree, const double (&center)[3], LeafSearch& memory)
{
  PlaceSearch search{ tree, center, memory.k, memory };
  if (!searchGroupAbout<Set>(tree.levels - 1, 0, search) || search.count < search.k)
  {
    return false;
  }
  for (int i = 0; i < search.count; ++i)
  {
    memory.nearCandidates[i] = std::uint32_t(i);
  }
  answer<Set>(tree, 0, search.count, search.reach, memory);
  return true;
}

template <typename Set>
NeighborKernels makeNeighborKernels()
{
  return { searchLeaf<Set>, searchPlace<Set>, groupGaps<Set>, leafDistances<Set>, hilbertKeys };
}

}
} // namespace simd
} // namespace pointhaptics
