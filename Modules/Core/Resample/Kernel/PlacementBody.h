/// @file
/// Part of VoxelKernelBody.h: places points in the lattice and deals their records out to the partitions.
#pragma once

#include "Core/Resample/Kernel/Fetch.h"
#include "Core/Resample/Kernel/InFours.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/RecordWriter.h"

namespace pointhaptics
{
namespace kernel
{
namespace
{

/// Records on their way to their partitions.
template <class V>
struct PlacedPoints
{
  /// Whole vectors are stored, the last one beyond what they were placed for.
  static constexpr int kRoom = V::placedAtOnce + kWidest;

  int size = 0;
  alignas(64) Record records[kRoom];
  alignas(64) std::uint64_t partitions[kRoom];
  alignas(64) std::uint32_t indices[kRoom];
};

/// Of two batches, one is placed while the other, which is whole (V::placedAtOnce points), is dealt out, in
/// turns of V::dealtInTurn records from all over it: neighbours in a scan go to one partition, whose cursor
/// would be read soon after it was moved. Placing is work for the vector units, dealing for those that read
/// and write memory, and where there are registers for both, turns of each that are near in the program are
/// done at the same time (V::dealsMeanwhile).
template <class V>
struct Batches
{
  static constexpr int kTurns = V::placedAtOnce / V::dealtInTurn;

  PlacedPoints<V> both[2];
  int current = 0;   ///< The one that is placed.
  int turn = kTurns; ///< That comes next for the other one.

  PlacedPoints<V>& placed() { return both[current]; }
  PlacedPoints<V>& dealt() { return both[1 - current]; }
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
  const PlacementVectors<V>& c, const typename V::Doubles u[3], PlacedPoints<V>& placed, std::int64_t to)
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
template <class V, bool Indexed>
inline std::int64_t keepInside(
  PlacedPoints<V>& placed, std::int64_t group, unsigned inside, std::uint32_t index)
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

/// Appends placed records to their partitions, from one of them on.
template <class V, bool Indexed>
struct Dealer
{
  const Record* records;
  const std::uint64_t* partitions;
  const std::uint32_t* indices;
  RecordWriter& writer;
  // Copies, which no store can change.
  Record** const cursors;
  const std::uintptr_t blockMask;

  Dealer(const PlacedPoints<V>& placed, int first, RecordWriter& to)
    : records(placed.records + first)
    , partitions(placed.partitions + first)
    , indices(placed.indices + first)
    , writer(to)
    , cursors(to.cursors)
    , blockMask(to.blockMask)
  {
  }
  __attribute__((always_inline)) void operator()(int i) const
  {
    const std::uint64_t partition = partitions[i];
    Record* const cursor = cursorOf(writer, cursors, blockMask, partition);
    cursors[partition] = cursor + 1;
    // In time for the points that are to come, although those of hundreds of cursors crowd the first level.
    fetchToWrite(cursor + 2 * kLineRecords);
    *cursor = records[i];
    if (Indexed)
    {
      writer.slots[indices[i]] = std::uint32_t(cursor - writer.records);
    }
  }
  /// Deals a turn of a whole batch out.
  __attribute__((always_inline)) void dealTurn()
  {
    visitPlaces<Batches<V>::kTurns, 0, V::dealtInTurn>(0, *this);
    ++records;
    ++partitions;
    ++indices;
  }
};

/// Places groups of V::width points, no more than it takes to make a batch whole, and appends those inside to
/// @p placed; meanwhile @p dealt, which is whole, is dealt out from @p turn on. Bit i of @p present: point i
/// of a group is one. @return how many are not finite. A function of its own, without calls: the constants
/// stay in registers.
template <class V, Motion motion, bool Pair, bool Indexed, typename Real>
__attribute__((noinline)) int placeGroups(const PlacementVectors<V>& given, const Real* xyz, int groups,
  unsigned present, std::uint32_t index, PlacedPoints<V>& placed, const PlacedPoints<V>& dealt, int& turn,
  RecordWriter& writer)
{
  constexpr int kAhead = 2048 / int(sizeof(Real));
  constexpr int kTurns = Batches<V>::kTurns;
  constexpr int kGroups = V::groupsTogether;
  static_assert(
    !V::dealsMeanwhile || kGroups * V::width == V::dealtInTurn, "as many are dealt out as are placed");
  const PlacementVectors<V> constants = given;
  Dealer<V, Indexed> dealer(dealt, turn, writer);
  int turns = kTurns - turn;
  std::int64_t size = placed.size;
  int invalid = 0;
  // Two loops have chains of operations half as long, of which the processor works on more at a time.
  typename V::Doubles u[kGroups][3];
  for (int first = 0; first < groups; first += kGroups)
  {
    const int together = groups - first < kGroups ? groups - first : kGroups;
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
      size = keepInside<V, Indexed>(placed, size, kept, firstIndex);
    }
    if (V::dealsMeanwhile && turns > 0)
    {
      dealer.dealTurn();
      --turns;
    }
  }
  placed.size = int(size);
  turn = kTurns - turns;
  return invalid;
}

/// Where the current batch is whole, the other one is dealt out: they change places, and points beyond a
/// whole batch are the first of the next one.
template <class V, bool Indexed>
inline void changePlaces(Batches<V>& batches)
{
  PlacedPoints<V>& whole = batches.placed();
  PlacedPoints<V>& next = batches.dealt();
  next.size = whole.size - V::placedAtOnce;
  for (int i = 0; i < next.size; ++i)
  {
    next.records[i] = whole.records[V::placedAtOnce + i];
    next.partitions[i] = whole.partitions[V::placedAtOnce + i];
    if (Indexed)
    {
      next.indices[i] = whole.indices[V::placedAtOnce + i];
    }
  }
  batches.current = 1 - batches.current;
  batches.turn = 0;
}

/// Deals the rest of the whole batch out.
template <class V, bool Indexed>
void dealWhole(Batches<V>& batches, RecordWriter& writer)
{
  Dealer<V, Indexed> dealer(batches.dealt(), batches.turn, writer);
  for (; batches.turn < batches.kTurns; ++batches.turn)
  {
    dealer.dealTurn();
  }
}

template <class V, Motion motion, bool Pair, bool Indexed, typename Real>
void partitionAll(const Placement& placement, const Real* xyz, const PointRange* ranges, std::int64_t count,
  RecordWriter& writer)
{
  const PlacementVectors<V> constants(placement);
  Batches<V> batches;
  const auto place = [&](const Real* from, std::int64_t first, int groups, unsigned present)
  {
    const int before = batches.placed().size;
    writer.invalid += placeGroups<V, motion, Pair, Indexed>(constants, from, groups, present,
      std::uint32_t(first - ranges[0].begin), batches.placed(), batches.dealt(), batches.turn, writer);
    writer.inside += batches.placed().size - before;
    if (batches.placed().size >= V::placedAtOnce)
    {
      changePlaces<V, Indexed>(batches);
      if (!V::dealsMeanwhile)
      {
        dealWhole<V, Indexed>(batches, writer);
      }
    }
  };
  for (std::int64_t r = 0; r < count; ++r)
  {
    std::int64_t i = ranges[r].begin;
    for (std::int64_t left = (ranges[r].end - i) / V::width; left > 0;)
    {
      const int most = (V::placedAtOnce - batches.placed().size + V::width - 1) / V::width;
      const int groups = left < most ? int(left) : most;
      place(xyz + 3 * i, i, groups, V::full);
      i += groups * V::width;
      left -= groups;
    }
    if (const std::int64_t rest = ranges[r].end - i)
    {
      Real last[3 * kWidest] = {};
      for (std::int64_t j = 0; j < 3 * rest; ++j)
      {
        last[j] = xyz[3 * i + j];
      }
      place(last, i, 1, (1u << unsigned(rest)) - 1);
    }
  }
  dealWhole<V, Indexed>(batches, writer);
  const Dealer<V, Indexed> dealer(batches.placed(), 0, writer);
  for (int i = 0; i < batches.placed().size; ++i)
  {
    dealer(i);
  }
}

template <class V, Motion motion, typename Real>
void partitionMoved(const Placement& placement, const Real* xyz, const PointRange* ranges, std::int64_t count,
  RecordWriter& writer)
{
  if (V::hasFusedMultiply && placement.pairDivides)
  {
    writer.slots ? partitionAll<V, motion, true, true>(placement, xyz, ranges, count, writer)
                 : partitionAll<V, motion, true, false>(placement, xyz, ranges, count, writer);
    return;
  }
  writer.slots ? partitionAll<V, motion, false, true>(placement, xyz, ranges, count, writer)
               : partitionAll<V, motion, false, false>(placement, xyz, ranges, count, writer);
}

template <class V, typename Real>
void partition(const Placement& placement, const Real* xyz, const PointRange* ranges, std::int64_t count,
  RecordWriter& writer)
{
  switch (placement.motion)
  {
    case Motion::Subtract:
      return partitionMoved<V, Motion::Subtract>(placement, xyz, ranges, count, writer);
    case Motion::Shift:
      return partitionMoved<V, Motion::Shift>(placement, xyz, ranges, count, writer);
    case Motion::Scale:
      return partitionMoved<V, Motion::Scale>(placement, xyz, ranges, count, writer);
    case Motion::General:
      return partitionMoved<V, Motion::General>(placement, xyz, ranges, count, writer);
    case Motion::Compensated:
      return partitionMoved<V, Motion::Compensated>(placement, xyz, ranges, count, writer);
  }
}

}
} // namespace kernel
} // namespace pointhaptics
