/// @file
/// Part of VoxelKernelBody.h: places points in the lattice and deals their records out to the partitions.
#pragma once

#include "Core/Kernel/Fetch.h"
#include "Core/Kernel/InFours.h"
#include "Core/Kernel/RecordWriter.h"
#include "Core/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace kernel
{
namespace
{

/// Points placed while the records of as many before them are dealt out.
constexpr int kPlacedAtOnce = 128;
/// So many of each in turn: placing is work for the vector units, dealing for those that read and write
/// memory, and the processor does both at the same time if they are this near in the program.
constexpr int kPlacedInTurn = 8;

/// Records on their way to their partitions: fewer than are dealt out at once, and those placed next.
struct PlacedPoints
{
  static constexpr int kRoom = 2 * kPlacedAtOnce + kWidest;

  int size = 0;
  alignas(64) Record records[kRoom];
  alignas(64) std::uint64_t partitions[kRoom];
  alignas(64) std::uint32_t indices[kRoom];
};

/// The vectors that stay the same over all points.
template <class V>
struct PlacementVectors
{
  typename V::Doubles pivot[3], matrix[3][3], offset[3], offsetRest[3];
  typename V::Doubles quantum[3], reciprocal[3], remainder[3], limit[3];
  typename V::Bits blocksPerLayer;
  typename V::Shift toRowBlock, toLayerBlock;
  bool layersAreCut;

  explicit PlacementVectors(const Placement& p)
    : blocksPerLayer(V::allBits(p.blocksPerLayer))
    , toRowBlock(V::shift(p.fractionBits + p.rowShift))
    , toLayerBlock(V::shift(p.fractionBits + p.layerShift))
    , layersAreCut(p.blocksPerLayer > 1)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      pivot[axis] = V::all(p.pivot[axis]);
      offset[axis] = V::all(p.offset[axis]);
      offsetRest[axis] = V::all(p.offsetRest[axis]);
      quantum[axis] = V::all(p.quantum[axis]);
      reciprocal[axis] = V::all(p.reciprocal[axis]);
      remainder[axis] = V::all(p.remainder[axis]);
      limit[axis] = V::all(p.limit[axis]);
      for (int column = 0; column < 3; ++column)
      {
        matrix[axis][column] = V::all(p.matrix[axis][column]);
      }
    }
  }
};

/// v / quantum, correctly rounded. @tparam Pair: Placement::pairDivides.
template <class V, bool Pair>
inline typename V::Doubles quotient(const PlacementVectors<V>& c, typename V::Doubles v, int axis)
{
  if constexpr (V::hasFusedMultiply)
  {
    const typename V::Doubles u = V::multiplyAdd(v, c.reciprocal[axis], V::multiply(v, c.remainder[axis]));
    return Pair ? u : V::corrected(u, v, c.quantum[axis], c.reciprocal[axis]);
  }
  else
  {
    return V::quotient(v, c.quantum[axis]);
  }
}

/// A row of the matrix times a point, and the offset: the sum of all terms rounded, and what that took from
/// it (T. Ogita, S. M. Rump, S. Oishi, "Accurate sum and dot product", 2005).
template <class V>
inline typename V::Doubles compensatedDot(
  const PlacementVectors<V>& c, const typename V::Doubles p[3], int axis)
{
  using Doubles = typename V::Doubles;
  Doubles sum = c.offset[axis];
  Doubles rest = c.offsetRest[axis];
  for (int column = 0; column < 3; ++column)
  {
    const Doubles term = V::multiply(p[column], c.matrix[axis][column]);
    rest = V::add(rest, V::multiplyRest(p[column], c.matrix[axis][column], term));
    const Doubles total = V::add(sum, term);
    const Doubles added = V::subtract(total, sum);
    rest = V::add(rest, V::add(V::subtract(sum, V::subtract(total, added)), V::subtract(term, added)));
    sum = total;
  }
  return V::add(sum, rest);
}

/// @p v: V::width points in the lattice's frame. Part of the loop whatever the compiler thinks: a call would
/// take the constants out of the registers.
template <class V, Motion motion, typename Real>
__attribute__((always_inline)) inline void move(
  const PlacementVectors<V>& c, const Real* xyz, typename V::Doubles v[3])
{
  typename V::Doubles p[3];
  V::load(xyz, p[0], p[1], p[2]);
  if constexpr (motion == Motion::Compensated)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      v[axis] = compensatedDot<V>(c, p, axis);
    }
    return;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    p[axis] = V::subtract(p[axis], c.pivot[axis]);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (motion == Motion::Subtract || motion == Motion::Shift)
    {
      v[axis] = p[axis];
    }
    else if (motion == Motion::Scale)
    {
      v[axis] = V::multiply(p[axis], c.matrix[axis][axis]);
    }
    else
    {
      v[axis] = V::add(V::add(V::multiply(p[0], c.matrix[axis][0]), V::multiply(p[1], c.matrix[axis][1])),
        V::multiply(p[2], c.matrix[axis][2]));
    }
    if (motion != Motion::Subtract)
    {
      v[axis] = V::add(v[axis], c.offset[axis]);
    }
  }
}

/// Places V::width points, which are at @p u in quanta, at @p to and after it. Bit i of the result: point i
/// is inside.
template <class V>
inline unsigned placeGroup(
  const PlacementVectors<V>& c, const typename V::Doubles u[3], PlacedPoints& placed, std::int64_t to)
{
  typename V::Bits position[3];
  typename V::Mask inside = V::allTrue();
  for (int axis = 0; axis < 3; ++axis)
  {
    inside = V::below(inside, u[axis], c.limit[axis]);
    position[axis] = V::floorBits(u[axis]);
  }
  typename V::Bits partition = V::right(V::onlyPosition(position[2]), c.toLayerBlock);
  if (c.layersAreCut)
  {
    partition = V::addBits(
      V::multiply32(partition, c.blocksPerLayer), V::right(V::onlyPosition(position[1]), c.toRowBlock));
  }
  V::store(placed.partitions + to, partition);
  const typename V::Bits first = V::withLowBits(V::template left<kLowBits>(position[0]), position[2]);
  const typename V::Bits second =
    V::withLowBits(V::template left<kLowBits>(position[1]), V::template rightBy<kLowBits>(position[2]));
  V::storeRecords(placed.records + to, first, second);
  return V::toUnsigned(inside);
}

/// Moves the records of a group at @p group that are inside together. @return where the next group goes.
template <bool Indexed>
inline std::int64_t keepInside(PlacedPoints& placed, std::int64_t group, unsigned inside, std::uint32_t index)
{
  std::int64_t to = group;
  for (; inside != 0; inside &= inside - 1, ++to)
  {
    const int i = __builtin_ctz(inside);
    placed.records[to] = placed.records[group + i];
    placed.partitions[to] = placed.partitions[group + i];
    if (Indexed)
    {
      placed.indices[to] = index + std::uint32_t(i);
    }
  }
  return to;
}

/// Appends a placed record to its partition.
template <bool Indexed>
struct Dealer
{
  const PlacedPoints& placed;
  RecordWriter& writer;
  // Copies, which no store can change.
  Record** const cursors;
  const std::uintptr_t blockMask;

  Dealer(const PlacedPoints& from, RecordWriter& to)
    : placed(from)
    , writer(to)
    , cursors(to.cursors)
    , blockMask(to.blockMask)
  {
  }
  __attribute__((always_inline)) void operator()(int i) const
  {
    const std::uint64_t partition = placed.partitions[i];
    Record* const cursor = cursorOf(writer, cursors, blockMask, partition);
    cursors[partition] = cursor + 1;
    // The next lines wait in the second level: those of hundreds of cursors would crowd the first.
    fetch(cursor + 2 * kLineRecords);
    *cursor = placed.records[i];
    if (Indexed)
    {
      writer.slots[placed.indices[i]] = std::uint32_t(cursor - writer.records);
    }
  }
};

template <bool Indexed>
void dealAll(const PlacedPoints& placed, RecordWriter& writer)
{
  const Dealer<Indexed> deal(placed, writer);
  for (int i = 0; i < placed.size; ++i)
  {
    deal(i);
  }
}

/// Places groups of V::width points, at most kPlacedAtOnce points, and appends those inside to @p placed. Bit
/// i of @p present: point i of a group is one. @return how many are not finite. A function of its own,
/// without calls: the constants stay in registers. @tparam Deals: there are kPlacedAtOnce points, and the
/// first kPlacedAtOnce of @p earlier ones are dealt out.
template <class V, Motion motion, bool Pair, bool Indexed, bool Deals, typename Real>
__attribute__((noinline)) int placeGroups(const PlacementVectors<V>& given, const Real* xyz, int groups,
  unsigned present, std::uint32_t index, PlacedPoints& placed, const PlacedPoints& earlier,
  RecordWriter& writer)
{
  constexpr int kAhead = 2048 / int(sizeof(Real));
  constexpr int kGroups = kPlacedInTurn / V::width;
  constexpr int kTurns = kPlacedAtOnce / kPlacedInTurn;
  const PlacementVectors<V> constants = given;
  const Dealer<Indexed> deal(earlier, writer);
  std::int64_t size = placed.size;
  int invalid = 0;
  typename V::Doubles u[kGroups][3];
  for (int first = 0; first < groups; first += kGroups)
  {
    const int together = Deals || groups - first > kGroups ? kGroups : groups - first;
    for (int g = 0; g < together; ++g)
    {
      const Real* from = xyz + 3 * V::width * (first + g);
      __builtin_prefetch(from + kAhead);
      if (V::width * 3 * sizeof(Real) > 64)
      {
        __builtin_prefetch(from + kAhead + 64 / sizeof(Real));
      }
      typename V::Doubles v[3];
      move<V, motion>(constants, from, v);
      for (int axis = 0; axis < 3; ++axis)
      {
        u[g][axis] = quotient<V, Pair>(constants, v[axis], axis);
      }
    }
    for (int g = 0; g < together; ++g)
    {
      const std::uint32_t firstIndex = index + std::uint32_t(V::width * (first + g));
      const unsigned kept = present & placeGroup<V>(constants, u[g], placed, size);
      if (__builtin_expect(kept == V::full, true))
      {
        for (int i = 0; Indexed && i < V::width; ++i)
        {
          placed.indices[size + i] = firstIndex + std::uint32_t(i);
        }
        size += V::width;
        continue;
      }
      if (kept != present)
      {
        typename V::Doubles v[3];
        move<V, motion>(constants, xyz + 3 * V::width * (first + g), v);
        const unsigned finite =
          V::toUnsigned(V::both(V::finite(v[0]), V::both(V::finite(v[1]), V::finite(v[2]))));
        invalid += __builtin_popcount(present & ~finite);
      }
      size = keepInside<Indexed>(placed, size, kept, firstIndex);
    }
    if constexpr (Deals)
    {
      // Neighbours in a scan go to one partition, whose cursor is read soon after it was moved: so they are
      // not dealt out one after the other.
      visitPlaces<kTurns, 0, kPlacedInTurn>(first / kGroups, deal);
    }
  }
  placed.size = int(size);
  return invalid;
}

/// Moves the records beyond kPlacedAtOnce to @p others, which are none.
template <bool Indexed>
inline void moveOthers(PlacedPoints& placed, PlacedPoints& others)
{
  others.size = placed.size - kPlacedAtOnce;
  placed.size = kPlacedAtOnce;
  for (int i = 0; i < others.size; ++i)
  {
    others.records[i] = placed.records[kPlacedAtOnce + i];
    others.partitions[i] = placed.partitions[kPlacedAtOnce + i];
    if (Indexed)
    {
      others.indices[i] = placed.indices[kPlacedAtOnce + i];
    }
  }
}

template <class V, Motion motion, bool Pair, bool Indexed, typename Real>
void partitionAll(const Placement& placement, const Real* xyz, std::int64_t count, RecordWriter& writer)
{
  constexpr int kWhole = kPlacedAtOnce / V::width;
  const PlacementVectors<V> constants(placement);
  PlacedPoints both[2];
  int current = 0; // The other has kPlacedAtOnce points to deal out, or none.
  const auto place = [&](const Real* from, int groups, unsigned present, std::int64_t first)
  {
    PlacedPoints& placed = both[current];
    PlacedPoints& earlier = both[1 - current];
    const int before = placed.size;
    if (earlier.size > 0 && groups == kWhole)
    {
      writer.invalid += placeGroups<V, motion, Pair, Indexed, true>(
        constants, from, groups, present, std::uint32_t(first), placed, earlier, writer);
    }
    else
    {
      dealAll<Indexed>(earlier, writer);
      writer.invalid += placeGroups<V, motion, Pair, Indexed, false>(
        constants, from, groups, present, std::uint32_t(first), placed, earlier, writer);
    }
    earlier.size = 0;
    writer.inside += placed.size - before;
    if (placed.size >= kPlacedAtOnce)
    {
      moveOthers<Indexed>(placed, earlier);
      current = 1 - current;
    }
  };
  const std::int64_t whole = count / V::width;
  for (std::int64_t group = 0; group < whole; group += kWhole)
  {
    const std::int64_t left = whole - group;
    place(xyz + 3 * V::width * group, left < kWhole ? int(left) : kWhole, V::full, V::width * group);
  }
  if (const std::int64_t rest = count - V::width * whole)
  {
    Real last[3 * kWidest] = {};
    for (std::int64_t i = 0; i < 3 * rest; ++i)
    {
      last[i] = xyz[3 * V::width * whole + i];
    }
    place(last, 1, (1u << unsigned(rest)) - 1, V::width * whole);
  }
  dealAll<Indexed>(both[1 - current], writer);
  dealAll<Indexed>(both[current], writer);
}

template <class V, Motion motion, typename Real>
void partitionMoved(const Placement& placement, const Real* xyz, std::int64_t count, RecordWriter& writer)
{
  if (V::hasFusedMultiply && placement.pairDivides)
  {
    writer.slots ? partitionAll<V, motion, true, true>(placement, xyz, count, writer)
                 : partitionAll<V, motion, true, false>(placement, xyz, count, writer);
    return;
  }
  writer.slots ? partitionAll<V, motion, false, true>(placement, xyz, count, writer)
               : partitionAll<V, motion, false, false>(placement, xyz, count, writer);
}

template <class V, typename Real>
void partition(const Placement& placement, const Real* xyz, std::int64_t count, RecordWriter& writer)
{
  switch (placement.motion)
  {
    case Motion::Subtract:
      return partitionMoved<V, Motion::Subtract>(placement, xyz, count, writer);
    case Motion::Shift:
      return partitionMoved<V, Motion::Shift>(placement, xyz, count, writer);
    case Motion::Scale:
      return partitionMoved<V, Motion::Scale>(placement, xyz, count, writer);
    case Motion::General:
      return partitionMoved<V, Motion::General>(placement, xyz, count, writer);
    case Motion::Compensated:
      return partitionMoved<V, Motion::Compensated>(placement, xyz, count, writer);
  }
}

}
} // namespace kernel
} // namespace pointhaptics
