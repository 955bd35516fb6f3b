/// @file
/// Part of VoxelKernelBody.h: places points in the lattice and deals their records out to the partitions.
#pragma once

#include "Core/Kernel/Fetch.h"
#include "Core/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace kernel
{
namespace
{

/// Points placed before their records are dealt out: two loops over what stays in the first-level cache take
/// less time than one that does both.
constexpr int kPlacedAtOnce = 128;

/// Records on their way to their partitions.
struct PlacedPoints
{
  int size = 0;
  alignas(64) Record records[kPlacedAtOnce];
  alignas(64) std::uint32_t partitions[kPlacedAtOnce];
  alignas(64) std::uint32_t indices[kPlacedAtOnce];
};

/// The vectors that stay the same over all points.
template <class V>
struct PlacementVectors
{
  typename V::Doubles pivot[3], matrix[3][3], offset[3], spacing[3], reciprocal[3], remainder[3], limit[3],
    magic;
  typename V::Bits blocksPerLayer;
  typename V::Shift toRowBlock, toLayerBlock;
  bool layersAreCut;

  explicit PlacementVectors(const Placement& p)
    : magic(V::all(p.magic))
    , blocksPerLayer(V::allBits(p.blocksPerLayer))
    , toRowBlock(V::shift(p.fractionBits + p.rowShift))
    , toLayerBlock(V::shift(p.fractionBits + p.layerShift))
    , layersAreCut(p.blocksPerLayer > 1)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      pivot[axis] = V::all(p.pivot[axis]);
      offset[axis] = V::all(p.offset[axis]);
      spacing[axis] = V::all(p.spacing[axis]);
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

/// v / spacing, correctly rounded. @tparam Pair: Placement::pairDivides.
template <class V, bool Pair>
inline typename V::Doubles quotient(const PlacementVectors<V>& c, typename V::Doubles v, int axis)
{
  if constexpr (V::hasFusedMultiply)
  {
    const typename V::Doubles u = V::multiplyAdd(v, c.reciprocal[axis], V::multiply(v, c.remainder[axis]));
    return Pair ? u : V::corrected(u, v, c.spacing[axis], c.reciprocal[axis]);
  }
  else
  {
    return V::quotient(v, c.spacing[axis]);
  }
}

/// Places V::width points at @p to and after it. Bit i of the result: point i is inside; of @p finite: it has
/// finite coordinates, told only where one is outside.
template <class V, Motion motion, bool Pair, typename Real>
inline unsigned placeGroup(
  const PlacementVectors<V>& c, const Real* xyz, PlacedPoints& placed, int to, unsigned& finite)
{
  typename V::Doubles p[3], v[3];
  typename V::Bits position[3];
  V::load(xyz, p[0], p[1], p[2]);
  for (int axis = 0; axis < 3; ++axis)
  {
    p[axis] = V::subtract(p[axis], c.pivot[axis]);
  }
  typename V::Mask inside = V::allTrue();
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
    const typename V::Doubles u = quotient<V, Pair>(c, v[axis], axis);
    inside = V::below(inside, u, c.limit[axis]);
    position[axis] = V::floorBits(u, c.magic);
  }
  typename V::Bits partition = V::right(V::onlyPosition(position[2]), c.toLayerBlock);
  if (c.layersAreCut)
  {
    partition = V::addBits(
      V::multiply32(partition, c.blocksPerLayer), V::right(V::onlyPosition(position[1]), c.toRowBlock));
  }
  V::storeLow(placed.partitions + to, partition);
  const typename V::Bits first = V::withPosition(V::template left<kPositionBits>(position[2]), position[0]);
  const typename V::Bits second =
    V::withPosition(V::template left<kPositionBits>(V::template rightBy<kLowBits>(position[2])), position[1]);
  V::storeRecords(placed.records + to, first, second);
  const unsigned bits = V::toUnsigned(inside);
  if (bits != V::full)
  {
    finite = V::toUnsigned(V::both(V::finite(v[0]), V::both(V::finite(v[1]), V::finite(v[2]))));
  }
  return bits;
}

/// Moves the records of a group at @p group that are inside together. @return where the next group goes.
template <bool Indexed>
inline int keepInside(PlacedPoints& placed, int group, unsigned inside, std::uint32_t index)
{
  int to = group;
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

/// Fetches a line after a cursor's. A scan fills lines fast, and few: the one after the next is taken for
/// writing at once. Otherwise it takes hundreds of records until the next is needed, and in the first-level
/// cache those of hundreds of cursors would crowd each other out: they wait in the second level.
template <bool isScan>
inline void fetchAfter(const Record* cursor)
{
  isScan ? __builtin_prefetch(cursor + 2 * kLineRecords, 1) : fetch(cursor + kLineRecords);
}

/// @p cursors: the writer's. The caller's copy, which no store can change.
template <bool Indexed, bool isScan>
inline void dealOne(const PlacedPoints& placed, std::int64_t i, Record** cursors, std::uintptr_t blockMask,
  RecordWriter& writer)
{
  const std::uint32_t partition = placed.partitions[i];
  Record* cursor = cursors[partition];
  if ((reinterpret_cast<std::uintptr_t>(cursor) & blockMask) == 0)
  {
    cursor = writer.refill(writer, partition);
  }
  *cursor = placed.records[i];
  if (Indexed)
  {
    writer.slots[placed.indices[i]] = std::uint32_t(cursor - writer.records);
  }
  ++cursor;
  fetchAfter<isScan>(cursor);
  cursors[partition] = cursor;
}

/// Appends records that nearly all go to one partition. A cursor that is moved waits for the move before:
/// where four go to one they move it together. @return how many were appended: all but the last few.
inline int dealRun(const PlacedPoints& placed, std::uintptr_t blockMask, RecordWriter& writer)
{
  constexpr int kTogether = 4;
  int i = 0;
  for (; i + kTogether <= placed.size; i += kTogether)
  {
    const std::uint32_t* partitions = placed.partitions + i;
    Record* cursor = writer.cursors[partitions[0]];
    const auto inBlock = reinterpret_cast<std::uintptr_t>(cursor) & blockMask;
    const bool areOne = ((partitions[0] ^ partitions[1]) | (partitions[2] ^ partitions[3]) |
                          (partitions[0] ^ partitions[2])) == 0;
    if (areOne && inBlock != 0 && inBlock <= blockMask + 1 - kTogether * sizeof(Record))
    {
      for (int j = 0; j < kTogether; ++j)
      {
        cursor[j] = placed.records[i + j];
      }
      cursor += kTogether;
      fetchAfter<true>(cursor);
      writer.cursors[partitions[0]] = cursor;
      continue;
    }
    for (int j = 0; j < kTogether; ++j)
    {
      dealOne<false, true>(placed, i + j, writer.cursors, blockMask, writer);
    }
  }
  return i;
}

/// Whether many of some records go where the one before goes, as in a scan. Four samples tell.
inline bool isScan(const PlacedPoints& placed)
{
  constexpr int kSamples = 4;
  const int step = placed.size / kSamples;
  int repeats = 0;
  for (int i = 0; i < kSamples && step > 1; ++i)
  {
    repeats += placed.partitions[i * step] == placed.partitions[i * step + 1];
  }
  return 2 * repeats >= kSamples;
}

/// Appends the records to their partitions. How is asked once for all: a branch on each few guesses wrong.
template <bool Indexed>
inline void deal(const PlacedPoints& placed, RecordWriter& writer)
{
  const std::uintptr_t blockMask = writer.blockMask;
  Record** const cursors = writer.cursors;
  if (!isScan(placed))
  {
    const std::int64_t size = placed.size;
    for (std::int64_t i = 0; i < size; ++i)
    {
      dealOne<Indexed, false>(placed, i, cursors, blockMask, writer);
    }
    return;
  }
  const std::uint32_t first = placed.partitions[0];
  const bool isRun =
    first == placed.partitions[placed.size / 2] && first == placed.partitions[placed.size - 1];
  const int from = !Indexed && isRun ? dealRun(placed, blockMask, writer) : 0;
  const auto dealNext = [&](int j) { dealOne<Indexed, true>(placed, from + j, cursors, blockMask, writer); };
  if (from == 0 && placed.size == kPlacedAtOnce)
  {
    // The usual case, with places that the compiler knows.
    fromPlaces<8>(kPlacedAtOnce, dealNext);
    return;
  }
  fromPlaces<8>(placed.size - from, dealNext);
}

/// Places groups of V::width points, at most kPlacedAtOnce points, and keeps those inside. Bit i of @p
/// present: point i of a group is one. @return how many are not finite. A function of its own, without calls:
/// the constants stay in registers.
template <class V, Motion motion, bool Pair, bool Indexed, typename Real>
__attribute__((noinline)) int placeGroups(const PlacementVectors<V>& given, const Real* xyz, int groups,
  unsigned present, std::uint32_t index, PlacedPoints& placed)
{
  constexpr int kAhead = 2048 / int(sizeof(Real));
  const PlacementVectors<V> constants = given;
  int size = 0;
  int invalid = 0;
  for (int g = 0; g < groups; ++g, xyz += 3 * V::width, index += V::width)
  {
    __builtin_prefetch(xyz + kAhead);
    if (V::width * 3 * sizeof(Real) > 64)
    {
      __builtin_prefetch(xyz + kAhead + 64 / sizeof(Real));
    }
    unsigned finite = 0;
    const unsigned inside = placeGroup<V, motion, Pair>(constants, xyz, placed, size, finite);
    if ((inside & present) == V::full)
    {
      for (int i = 0; Indexed && i < V::width; ++i)
      {
        placed.indices[size + i] = index + std::uint32_t(i);
      }
      size += V::width;
      continue;
    }
    // Where not all of a group were present, finite was told if any of those was outside.
    const unsigned kept = inside & present;
    invalid += kept == present ? 0 : __builtin_popcount(present & ~inside & ~finite);
    size = keepInside<Indexed>(placed, size, kept, index);
  }
  placed.size = size;
  return invalid;
}

template <class V, Motion motion, bool Pair, bool Indexed, typename Real>
void partitionAll(const Placement& placement, const Real* xyz, std::int64_t count, RecordWriter& writer)
{
  const PlacementVectors<V> constants(placement);
  PlacedPoints placed;
  const auto place = [&](const Real* from, int groups, unsigned present, std::int64_t first)
  {
    writer.invalid +=
      placeGroups<V, motion, Pair, Indexed>(constants, from, groups, present, std::uint32_t(first), placed);
    writer.inside += placed.size;
    deal<Indexed>(placed, writer);
  };
  const std::int64_t whole = count / V::width;
  for (std::int64_t group = 0; group < whole; group += kPlacedAtOnce / V::width)
  {
    const std::int64_t left = whole - group;
    const int groups = left < kPlacedAtOnce / V::width ? int(left) : kPlacedAtOnce / V::width;
    place(xyz + 3 * V::width * group, groups, V::full, V::width * group);
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
  }
}

}
} // namespace kernel
} // namespace pointhaptics
