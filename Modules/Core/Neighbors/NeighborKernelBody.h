/// @file
/// The loops of NeighborKernel.h over Simd/Words.h, whatever the width of a pack. Included by one source per
/// instruction set; all is in an anonymous namespace, so that the linker cannot choose one set's version for
/// the others. For the same reason nothing of the standard library's algorithms is called.
#pragma once

#include "Core/Neighbors/NeighborKernel.h"
#include "Core/Simd/Words.h"

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

static_assert(kSlack >= kWidth, "stores write a whole pack");

struct Box
{
  double low[3];
  double high[3];
};

#if defined(__AVX2__)
/// The chosen of four numbers first, for each choice: as pairs of 32-bit words, and their lanes.
struct Choices
{
  alignas(32) std::uint32_t words[16][8] = {};
  alignas(16) std::uint32_t lanes[16][4] = {};

  constexpr Choices()
  {
    for (unsigned bits = 0; bits < 16; ++bits)
    {
      for (unsigned lane = 0, to = 0; lane < 4; ++lane)
      {
        if ((bits >> lane & 1u) != 0)
        {
          words[bits][2 * to] = 2 * lane;
          words[bits][2 * to + 1] = 2 * lane + 1;
          lanes[bits][to++] = lane;
        }
      }
    }
  }
};
constexpr Choices kChoices;
#endif

/// Stores the chosen numbers one after the other. May write a whole pack.
inline void storeChosen(double* to, unsigned bits, const Pack& v)
{
#if defined(__AVX2__)
  const __m256i words = _mm256_load_si256(reinterpret_cast<const __m256i*>(kChoices.words[bits]));
  _mm256_storeu_pd(to, _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(v), words)));
#else
  to[0] = (bits & 1u) != 0 ? v[0] : v[1];
  to[1] = v[1];
#endif
}

/// Stores the lanes of the chosen numbers, counted from @p first. May write a whole pack.
inline void storeLanes(std::uint32_t* to, unsigned bits, std::uint32_t first)
{
#if defined(__AVX2__)
  const __m128i lanes = _mm_load_si128(reinterpret_cast<const __m128i*>(kChoices.lanes[bits]));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_add_epi32(lanes, _mm_set1_epi32(int(first))));
#else
  to[0] = first + (~bits & 1u);
  to[1] = first + 1u;
#endif
}

/// Bit i is set where number i of @p v is at most @p x.
inline unsigned atMostBits(const Pack& v, double x)
{
  return signBits(reinterpret_cast<Pack>(v <= x));
}

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
inline Pack squaredGap(const Box& box, const double* const (&low)[3], const double* const (&high)[3], int at)
{
  Pack sum;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Pack below = box.low[axis] - numbersAt(high[axis] + at);
    const Pack above = numbersAt(low[axis] + at) - box.high[axis];
    // A place that is NaN, behind the last point, must stay one.
    const Pack gap = larger(all(0.0), larger(below, above));
    sum = axis == 0 ? gap * gap : sum + gap * gap;
  }
  return sum;
}

unsigned boxesWithin(const BoxGroup& group, const Box& box, double reach)
{
  const double* const low[3] = { group.low[0], group.low[1], group.low[2] };
  const double* const high[3] = { group.high[0], group.high[1], group.high[2] };
  unsigned within = 0;
  for (int at = 0; at < kBranches; at += kWidth)
  {
    within |= atMostBits(squaredGap(box, low, high, at), reach) << at;
  }
  return within;
}

/// Adds the points of @p leaf within @p reach of @p box to the candidates.
void appendLeaf(const NeighborTree& tree, std::int64_t leaf, const Box& box, double reach, LeafSearch& search)
{
  const std::int64_t first = leaf * kLeafPoints;
  const double* const places[3] = { tree.places[0] + first, tree.places[1] + first, tree.places[2] + first };
  int to = search.candidates;
  for (int at = 0; at < kLeafPoints; at += kWidth)
  {
    const unsigned bits = atMostBits(squaredGap(box, places, places, at), reach);
    for (int axis = 0; axis < 3; ++axis)
    {
      storeChosen(search.places[axis] + to, bits, numbersAt(places[axis] + at));
    }
    storeLanes(search.slots + to, bits, std::uint32_t(first + at));
    to += __builtin_popcount(bits);
  }
  search.candidates = to;
}

/// All points within @p reach of @p box. @return false where they are too many.
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
    unsigned within = boxesWithin(tree.groups[here.level][here.group], box, reach);
    within &= (1u << boxesOf(tree, here.level, here.group)) - 1u;
    for (; within != 0; within &= within - 1u)
    {
      const std::int64_t child = here.group * kBranches + __builtin_ctz(within);
      if (here.level > 0)
      {
        stack[depth++] = { here.level - 1, child };
      }
      else if (search.candidates + kLeafPoints > mostCandidates(search.k))
      {
        return false;
      }
      else
      {
        appendLeaf(tree, child, box, reach, search);
      }
    }
  }
  for (auto& ofAxis : search.places)
  {
    for (int i = 0; i < kSlack; ++i)
    {
      ofAxis[search.candidates + i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return true;
}

/// Lists the candidates within @p reach of a point. @return their number.
int listNear(const double (&center)[3], double reach, LeafSearch& search)
{
  int count = 0;
  for (int at = 0; at < search.candidates; at += kWidth)
  {
    const Pack dx = numbersAt(search.places[0] + at) - center[0];
    const Pack dy = numbersAt(search.places[1] + at) - center[1];
    const Pack dz = numbersAt(search.places[2] + at) - center[2];
    const Pack d2 = dx * dx + dy * dy + dz * dz;
    const unsigned bits = atMostBits(d2, reach);
    storeChosen(search.near + count, bits, d2);
    storeLanes(search.nearCandidates + count, bits, std::uint32_t(at));
    count += __builtin_popcount(bits);
  }
  return count;
}

/// How many of the @p count listed are nearer than each.
void rankNear(int count, LeafSearch& search)
{
  constexpr int kTogether = 4;
  for (int i = 0; i < kSlack; ++i)
  {
    search.near[count + i] = std::numeric_limits<double>::infinity();
  }
  for (int at = 0; at < count; at += kTogether * kWidth)
  {
    Words counts[kTogether];
    Pack values[kTogether];
    for (int v = 0; v < kTogether; ++v)
    {
      counts[v] = Words{};
      const int from = at + v * kWidth;
      values[v] = numbersAt(search.near + (from < count ? from : at));
    }
    for (int i = 0; i < count; ++i)
    {
      const Pack other = all(search.near[i]);
      for (int v = 0; v < kTogether; ++v)
      {
        counts[v] -= reinterpret_cast<Words>(other < values[v]); // A true comparison is -1.
      }
    }
    for (int v = 0; v < kTogether && at + v * kWidth < count; ++v)
    {
      *reinterpret_cast<WordsAt*>(search.ranks + at + v * kWidth) = counts[v];
    }
  }
}

/// Orders the @p count listed, by comparing each with each, and writes the first search.k to the answer of
/// point @p at of the leaf. Equal distances have equal ranks: the smaller index goes first.
void answer(const NeighborTree& tree, int at, int count, LeafSearch& search)
{
  const auto index = [&](std::int32_t i) { return tree.indices[search.slots[search.nearCandidates[i]]]; };
  rankNear(count, search);
  for (int i = 0; i < count; ++i)
  {
    search.order[i] = -1;
  }
  for (std::int32_t i = 0; i < count; ++i)
  {
    std::int32_t moving = i;
    std::uint64_t rank = search.ranks[i];
    for (; __builtin_expect(search.order[rank] >= 0, false); ++rank)
    {
      const std::int32_t there = search.order[rank];
      if (index(there) > index(moving))
      {
        search.order[rank] = moving;
        moving = there;
      }
    }
    search.order[rank] = moving;
  }
  for (int i = 0; i < search.k; ++i)
  {
    search.squaredDistances[at][i] = search.near[search.order[i]];
    search.neighbors[at][i] = search.slots[search.nearCandidates[search.order[i]]];
  }
  search.found |= 1u << at;
}

/// @param reach what the candidates are complete to. @param first where to look first, at most reach.
/// @return the squared distance of the k-th neighbour; below 0 where it was not found.
double searchPoint(
  const NeighborTree& tree, std::int64_t slot, int at, double first, double reach, LeafSearch& search)
{
  const double center[3] = { tree.places[0][slot], tree.places[1][slot], tree.places[2][slot] };
  const int most = mostNear(search.k);
  double limit = first;
  int count = listNear(center, limit, search);
  if (count < search.k && limit < reach)
  {
    limit = reach;
    count = listNear(center, limit, search);
  }
  if (count > most)
  {
    // On a surface the number grows like the squared distance.
    limit *= 0.5 * (search.k + most) / count;
    count = listNear(center, limit, search);
  }
  if (count < search.k || count > most)
  {
    return -1.0;
  }
  answer(tree, at, count, search);
  return search.squaredDistances[at][search.k - 1];
}

/// @return the largest squared distance found, 0 for none.
double searchPoints(const NeighborTree& tree, std::int64_t leaf, double reach, LeafSearch& search)
{
  const std::int64_t first = leaf * kLeafPoints;
  const int points = tree.size - first < kLeafPoints ? int(tree.size - first) : kLeafPoints;
  double largest = 0.0;
  double near = reach;
  for (int at = 0; at < points; ++at)
  {
    if (((search.wanted & ~search.found) >> at & 1u) != 0)
    {
      const double d2 = searchPoint(tree, first + at, at, near, reach, search);
      largest = d2 > largest ? d2 : largest;
      near = d2 >= 0.0 && d2 * kPointMargin < reach ? d2 * kPointMargin : reach;
    }
  }
  return largest;
}

void searchLeaf(const NeighborTree& tree, std::int64_t leaf, LeafSearch& search)
{
  const Box box = boxOfLeaf(tree, leaf);
  const std::int64_t left = tree.size - leaf * kLeafPoints;
  const unsigned all = search.wanted & ((1u << (left < kLeafPoints ? left : kLeafPoints)) - 1u);
  search.found = 0;
  double largest = 0.0;
  double reach = search.reach;
  for (int attempt = 0; attempt < kAttempts && search.found != all; ++attempt)
  {
    if (!gather(tree, box, reach, search))
    {
      break;
    }
    const double d2 = searchPoints(tree, leaf, reach, search);
    largest = d2 > largest ? d2 : largest;
    reach *= kFarther;
  }
  search.reach = search.found == all ? kLeafMargin * largest : 0.0;
}

constexpr NeighborKernels kKernels = { searchLeaf };

}
} // namespace simd
} // namespace pointhaptics
