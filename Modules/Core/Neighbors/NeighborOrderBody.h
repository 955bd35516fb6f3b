/// @file
/// From the candidates of a search to its answer: nearest first, ties by index. Included by one source per
/// instruction set, as NeighborKernelBody.h is, which lists the operations of a set.
#pragma once

#include "Core/Neighbors/NeighborKernel.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// How many of the @p count listed are nearer than each.
template <typename Set>
void rankNear(int count, LeafSearch& search)
{
  constexpr int kTogether = 4;
  double* const near = search.near;
  std::int64_t* const ranks = search.ranks;
  for (int i = 0; i < kSlack; ++i)
  {
    near[count + i] = std::numeric_limits<double>::infinity();
  }
  for (int at = 0; at < count; at += kTogether * Set::width)
  {
    typename Set::Counts counts[kTogether];
    typename Set::Doubles values[kTogether];
    for (int v = 0; v < kTogether; ++v)
    {
      counts[v] = Set::none();
      const int from = at + v * Set::width;
      values[v] = Set::load(near + (from < count ? from : at));
    }
    for (int i = 0; i < count; ++i)
    {
      const auto other = Set::all(near[i]);
      for (int v = 0; v < kTogether; ++v)
      {
        counts[v] = Set::countLess(counts[v], other, values[v]);
      }
    }
    for (int v = 0; v < kTogether && at + v * Set::width < count; ++v)
    {
      Set::store(ranks + at + v * Set::width, counts[v]);
    }
  }
}

/// True if candidate @p a goes before @p b: it is nearer, or as near with the smaller index.
inline bool isNearer(const NeighborTree& tree, const LeafSearch& search, std::int32_t a, std::int32_t b)
{
  return search.near[a] != search.near[b] ? search.near[a] < search.near[b]
                                          : tree.indices[search.slots[search.nearCandidates[a]]] <
      tree.indices[search.slots[search.nearCandidates[b]]];
}

/// Equal distances have equal ranks: the smaller index goes first.
void orderTies(const NeighborTree& tree, int count, int k, LeafSearch& search)
{
  const auto index = [&](std::int32_t i) { return tree.indices[search.slots[search.nearCandidates[i]]]; };
  for (int i = 0; i < k; ++i)
  {
    search.order[i] = -1;
  }
  for (std::int32_t i = 0; i < count; ++i)
  {
    std::int32_t moving = i;
    std::int64_t at = search.ranks[i];
    for (; at < k && search.order[at] >= 0; ++at)
    {
      const std::int32_t there = search.order[at];
      if (index(there) > index(moving))
      {
        search.order[at] = moving;
        moving = there;
      }
    }
    if (at < k)
    {
      search.order[at] = moving;
    }
  }
}

/// Writes the first of search.order to the answer of point @p at of the leaf.
inline void writeAnswer(int at, LeafSearch& search)
{
  double* const distances = distancesOf(search, at);
  std::uint32_t* const slots = neighborsOf(search, at);
  const std::int32_t* const order = search.order;
  const int k = search.k;
  for (int i = 0; i < k; ++i)
  {
    distances[i] = search.near[order[i]];
    slots[i] = search.slots[search.nearCandidates[order[i]]];
  }
  search.found |= 1u << at;
}

/// Orders the listed by comparing each with each.
template <typename Set>
void orderByRank(const NeighborTree& tree, int count, LeafSearch& search)
{
  const int k = search.k;
  std::int32_t* const order = search.order;
  const std::int64_t* const ranks = search.ranks;
  rankNear<Set>(count, search);
  // Without ties each rank up to the one behind the last is taken.
  const int looked = k < count ? k + 1 : k;
  for (int i = 0; i < looked; ++i)
  {
    order[i] = -1;
  }
  for (std::int32_t i = 0; i < count; ++i)
  {
    order[ranks[i]] = i;
  }
  std::int32_t all = 0;
  for (int i = 0; i < looked; ++i)
  {
    all |= order[i];
  }
  if (all < 0)
  {
    orderTies(tree, count, k, search);
  }
}

/// Orders the listed, none beyond @p reach, in buckets of like distances. On a surface squared distances are
/// even, so that a bucket has about one; @return false where one has many.
inline bool orderByBuckets(const NeighborTree& tree, int count, double reach, LeafSearch& search)
{
  constexpr std::int64_t kMostInBucket = 32;
  const double perBucket = double(count) / reach;
  if (!(perBucket <= std::numeric_limits<double>::max()) || !(reach <= std::numeric_limits<double>::max()))
  {
    return false;
  }
  const auto bucketOf = [&](std::int32_t i)
  {
    const int bucket = int(search.near[i] * perBucket);
    return bucket < count ? bucket : count - 1;
  };
  std::int64_t* const begins = search.ranks;
  for (int i = 0; i < count; ++i)
  {
    begins[i] = 0;
  }
  std::int64_t largest = 0;
  for (std::int32_t i = 0; i < count; ++i)
  {
    const std::int64_t size = ++begins[bucketOf(i)];
    largest = size > largest ? size : largest;
  }
  if (largest > kMostInBucket)
  {
    return false;
  }
  std::int64_t sum = 0;
  for (int i = 0; i < count; ++i)
  {
    const std::int64_t size = begins[i];
    begins[i] = sum;
    sum += size;
  }
  for (std::int32_t i = 0; i < count; ++i)
  {
    search.order[begins[bucketOf(i)]++] = i;
  }
  for (int i = 1; i < count; ++i)
  {
    const std::int32_t moving = search.order[i];
    int to = i;
    for (; to > 0 && isNearer(tree, search, moving, search.order[to - 1]); --to)
    {
      search.order[to] = search.order[to - 1];
    }
    search.order[to] = moving;
  }
  return true;
}

/// Moves @p moving down from the root at @p at: a heap whose parents are the farther ones.
inline void siftDown(const NeighborTree& tree, int at, int count, std::int32_t moving, LeafSearch& search)
{
  for (int child = 2 * at + 1; child < count; child = 2 * at + 1)
  {
    child +=
      child + 1 < count && isNearer(tree, search, search.order[child], search.order[child + 1]) ? 1 : 0;
    if (!isNearer(tree, search, moving, search.order[child]))
    {
      break;
    }
    search.order[at] = search.order[child];
    at = child;
  }
  search.order[at] = moving;
}

/// Orders the listed whatever their distances are: heap sort, for the reason given in copyFromTwin().
inline void orderByHeap(const NeighborTree& tree, int count, LeafSearch& search)
{
  for (int i = 0; i < count; ++i)
  {
    search.order[i] = i;
  }
  for (int i = count / 2 - 1; i >= 0; --i)
  {
    siftDown(tree, i, count, search.order[i], search);
  }
  for (int last = count - 1; last > 0; --last)
  {
    const std::int32_t moving = search.order[last];
    search.order[last] = search.order[0];
    siftDown(tree, 0, last, moving, search);
  }
}

/// Sorts the listed, none beyond @p reach, and writes the first search.k to the answer of point @p at of the
/// leaf.
template <typename Set>
void answer(const NeighborTree& tree, int at, int count, double reach, LeafSearch& search)
{
  if (search.k <= kMostAlone)
  {
    orderByRank<Set>(tree, count, search);
  }
  else if (!orderByBuckets(tree, count, reach, search))
  {
    orderByHeap(tree, count, search);
  }
  writeAnswer(at, search);
}

}
} // namespace simd
} // namespace pointhaptics
