/// @file
/// Part of VoxelKernelBody.h: quantizes points and bins their records into the partitions.
#pragma once

#include "Core/Resample/Kernel/Fetch.h"
#include "Core/Resample/Kernel/InFours.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/PointRecordWriter.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Quantized points: their records and partitions, not yet binned.
template <class V>
struct QuantizedPoints
{
  /// Whole vectors are stored: the last one may reach beyond the batch.
  static constexpr int kRoom = V::quantizedAtOnce + kWidest;

  int size = 0;
  alignas(64) PointRecord records[kRoom];
  alignas(64) std::uint64_t partitions[kRoom];
  alignas(64) std::uint32_t indices[kRoom];
};

/// Two batches: one is quantized while the other, which is full (V::quantizedAtOnce points), is binned.
///
/// Binning takes turns of V::binnedPerTurn records, spread over the batch. Neighbours in a scan go to one
/// partition, and a record would wait for the cursor that the record before has just moved. Quantizing uses
/// the vector units and binning the load and store units: where there are registers for both, turns of each
/// alternate, so that the processor overlaps them (V::binsMeanwhile).
template <class V>
struct Batches
{
  static constexpr int kTurns = V::quantizedAtOnce / V::binnedPerTurn;

  QuantizedPoints<V> both[2];
  int current = 0;   ///< The one that is quantized.
  int turn = kTurns; ///< The next turn of the other one.

  QuantizedPoints<V>& quantized() { return both[current]; }
  QuantizedPoints<V>& binned() { return both[1 - current]; }
};

/// The vectors that stay the same over all points.
template <class V>
struct QuantizerVectors
{
  typename V::Doubles pivot[3], matrix[3][3], offset[3], offsetRest[3];
  typename V::Doubles quantum[3], reciprocal[3], remainder[3], limit[3];
  typename V::Bits blocksPerLayer;
  typename V::Shift toRowBlock, toLayerBlock;
  bool layersAreCut;

  explicit QuantizerVectors(const PointQuantizer& p)
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

/// v / quantum, correctly rounded. @tparam Pair: PointQuantizer::pairDivides.
template <class V, bool Pair>
inline typename V::Doubles quotient(const QuantizerVectors<V>& c, typename V::Doubles v, int axis)
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
  const QuantizerVectors<V>& c, const typename V::Doubles p[3], int axis)
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
  const QuantizerVectors<V>& c, const Real* xyz, typename V::Doubles v[3])
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

/// @p u: V::width points in quanta. Fetches points that come later.
template <class V, Motion motion, bool Pair, typename Real>
__attribute__((always_inline)) inline void locate(
  const QuantizerVectors<V>& c, const Real* xyz, typename V::Doubles u[3])
{
  constexpr int kAhead = 2048 / int(sizeof(Real));
  __builtin_prefetch(xyz + kAhead);
  if (V::width * 3 * sizeof(Real) > 64)
  {
    __builtin_prefetch(xyz + kAhead + 64 / sizeof(Real));
  }
  typename V::Doubles v[3];
  move<V, motion>(c, xyz, v);
  for (int axis = 0; axis < 3; ++axis)
  {
    u[axis] = quotient<V, Pair>(c, v[axis], axis);
  }
}

/// Quantizes V::width points, which are at @p u in quanta, into @p to and after it. Bit i of the result:
/// point i is inside.
template <class V>
inline unsigned quantizeGroup(const QuantizerVectors<V>& c, const typename V::Doubles u[3],
  QuantizedPoints<V>& quantized, std::int64_t to)
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
  V::store(quantized.partitions + to, partition);
  const typename V::Bits first = V::withLowBits(V::template left<kLowBits>(position[0]), position[2]);
  const typename V::Bits second =
    V::withLowBits(V::template left<kLowBits>(position[1]), V::template rightBy<kLowBits>(position[2]));
  V::storeRecords(quantized.records + to, first, second);
  return V::toUnsigned(inside);
}

/// Moves the records of a group at @p group that are inside together. @return where the next group goes.
template <class V, bool Indexed>
inline std::int64_t keepInside(
  QuantizedPoints<V>& quantized, std::int64_t group, unsigned inside, std::uint32_t index)
{
  std::int64_t to = group;
  for (; inside != 0; inside &= inside - 1, ++to)
  {
    const int i = __builtin_ctz(inside);
    quantized.records[to] = quantized.records[group + i];
    quantized.partitions[to] = quantized.partitions[group + i];
    if (Indexed)
    {
      quantized.indices[to] = index + std::uint32_t(i);
    }
  }
  return to;
}

/// Bins quantized points: appends their records to the partitions, from record @p first on.
template <class V, bool Indexed>
struct PointBinner
{
  const PointRecord* records;
  const std::uint64_t* partitions;
  const std::uint32_t* indices;
  PointRecordWriter& writer;
  // Copies, which no store can change.
  PointRecord** const cursors;
  const std::uintptr_t blockMask;

  PointBinner(const QuantizedPoints<V>& quantized, int first, PointRecordWriter& to)
    : records(quantized.records + first)
    , partitions(quantized.partitions + first)
    , indices(quantized.indices + first)
    , writer(to)
    , cursors(to.cursors)
    , blockMask(to.blockMask)
  {
  }
  __attribute__((always_inline)) void operator()(int i) const
  {
    const std::uint64_t partition = partitions[i];
    PointRecord* const cursor = cursorOf(writer, cursors, blockMask, partition);
    cursors[partition] = cursor + 1;
    // In time for the next points, although the lines of hundreds of cursors do not fit the first-level
    // cache.
    fetchToWrite(cursor + 2 * kLineRecords);
    *cursor = records[i];
    if (Indexed)
    {
      writer.slots[indices[i]] = std::uint32_t(cursor - writer.records);
    }
  }
  /// Bins one turn of a full batch.
  __attribute__((always_inline)) void binTurn()
  {
    visitStrided<Batches<V>::kTurns, 0, V::binnedPerTurn>(0, *this);
    ++records;
    ++partitions;
    ++indices;
  }
};

/// Quantizes groups of V::width points, no more than fill a batch, and appends those inside to @p quantized;
/// meanwhile @p binned, which is full, is binned from @p turn on. Bit i of @p present: a group has a point i.
/// @return how many are not finite. A function of its own, without calls: the constants stay in registers.
template <class V, Motion motion, bool Pair, bool Indexed, typename Real>
__attribute__((noinline)) int quantizeGroups(const QuantizerVectors<V>& given, const Real* xyz, int groups,
  unsigned present, std::uint32_t index, QuantizedPoints<V>& quantized, const QuantizedPoints<V>& binned,
  int& turn, PointRecordWriter& writer)
{
  constexpr int kTurns = Batches<V>::kTurns;
  constexpr int kGroups = V::groupsTogether;
  static_assert(
    !V::binsMeanwhile || kGroups * V::width == V::binnedPerTurn, "as many are binned as are quantized");
  const QuantizerVectors<V> constants = given;
  PointBinner<V, Indexed> binner(binned, turn, writer);
  int turns = kTurns - turn;
  std::int64_t size = quantized.size;
  int invalid = 0;
  // Two loops have chains of operations half as long, of which the processor works on more at a time.
  typename V::Doubles u[kGroups][3];
  for (int first = 0; first < groups; first += kGroups)
  {
    const int together = groups - first < kGroups ? groups - first : kGroups;
    for (int g = 0; g < together; ++g)
    {
      locate<V, motion, Pair>(constants, xyz + 3 * V::width * (first + g), u[g]);
    }
    for (int g = 0; g < together; ++g)
    {
      const std::uint32_t firstIndex = index + std::uint32_t(V::width * (first + g));
      const unsigned kept = present & quantizeGroup<V>(constants, u[g], quantized, size);
      if (__builtin_expect(kept == V::full, true))
      {
        for (int i = 0; Indexed && i < V::width; ++i)
        {
          quantized.indices[size + i] = firstIndex + std::uint32_t(i);
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
      size = keepInside<V, Indexed>(quantized, size, kept, firstIndex);
    }
    if (V::binsMeanwhile && turns > 0)
    {
      binner.binTurn();
      --turns;
    }
  }
  quantized.size = int(size);
  turn = kTurns - turns;
  return invalid;
}

/// Swaps the batches once the current one is full and the other one is binned. Points beyond a full batch
/// become the first of the next one.
template <class V, bool Indexed>
inline void swapBatches(Batches<V>& batches)
{
  QuantizedPoints<V>& whole = batches.quantized();
  QuantizedPoints<V>& next = batches.binned();
  next.size = whole.size - V::quantizedAtOnce;
  for (int i = 0; i < next.size; ++i)
  {
    next.records[i] = whole.records[V::quantizedAtOnce + i];
    next.partitions[i] = whole.partitions[V::quantizedAtOnce + i];
    if (Indexed)
    {
      next.indices[i] = whole.indices[V::quantizedAtOnce + i];
    }
  }
  batches.current = 1 - batches.current;
  batches.turn = 0;
}

/// Bins the remaining turns of the full batch.
template <class V, bool Indexed>
void binWhole(Batches<V>& batches, PointRecordWriter& writer)
{
  PointBinner<V, Indexed> binner(batches.binned(), batches.turn, writer);
  for (; batches.turn < batches.kTurns; ++batches.turn)
  {
    binner.binTurn();
  }
}

template <class V, Motion motion, bool Pair, bool Indexed, typename Real>
void partitionAll(const PointQuantizer& quantizer, const Real* xyz, const PointRange* ranges,
  std::int64_t count, PointRecordWriter& writer)
{
  const QuantizerVectors<V> constants(quantizer);
  Batches<V> batches;
  const auto quantize = [&](const Real* from, std::int64_t first, int groups, unsigned present)
  {
    const int before = batches.quantized().size;
    writer.invalid += quantizeGroups<V, motion, Pair, Indexed>(constants, from, groups, present,
      std::uint32_t(first - ranges[0].begin), batches.quantized(), batches.binned(), batches.turn, writer);
    writer.inside += batches.quantized().size - before;
    if (batches.quantized().size >= V::quantizedAtOnce)
    {
      swapBatches<V, Indexed>(batches);
      if (!V::binsMeanwhile)
      {
        binWhole<V, Indexed>(batches, writer);
      }
    }
  };
  for (std::int64_t r = 0; r < count; ++r)
  {
    std::int64_t i = ranges[r].begin;
    for (std::int64_t left = (ranges[r].end - i) / V::width; left > 0;)
    {
      const int most = (V::quantizedAtOnce - batches.quantized().size + V::width - 1) / V::width;
      const int groups = left < most ? int(left) : most;
      quantize(xyz + 3 * i, i, groups, V::full);
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
      quantize(last, i, 1, (1u << unsigned(rest)) - 1);
    }
  }
  binWhole<V, Indexed>(batches, writer);
  const PointBinner<V, Indexed> binner(batches.quantized(), 0, writer);
  for (int i = 0; i < batches.quantized().size; ++i)
  {
    binner(i);
  }
}

template <class V, Motion motion, typename Real>
void partitionMoved(const PointQuantizer& quantizer, const Real* xyz, const PointRange* ranges,
  std::int64_t count, PointRecordWriter& writer)
{
  if (V::hasFusedMultiply && quantizer.pairDivides)
  {
    writer.slots ? partitionAll<V, motion, true, true>(quantizer, xyz, ranges, count, writer)
                 : partitionAll<V, motion, true, false>(quantizer, xyz, ranges, count, writer);
    return;
  }
  writer.slots ? partitionAll<V, motion, false, true>(quantizer, xyz, ranges, count, writer)
               : partitionAll<V, motion, false, false>(quantizer, xyz, ranges, count, writer);
}

template <class V, typename Real>
void partition(const PointQuantizer& quantizer, const Real* xyz, const PointRange* ranges, std::int64_t count,
  PointRecordWriter& writer)
{
  switch (quantizer.motion)
  {
    case Motion::Subtract:
      return partitionMoved<V, Motion::Subtract>(quantizer, xyz, ranges, count, writer);
    case Motion::Shift:
      return partitionMoved<V, Motion::Shift>(quantizer, xyz, ranges, count, writer);
    case Motion::Scale:
      return partitionMoved<V, Motion::Scale>(quantizer, xyz, ranges, count, writer);
    case Motion::General:
      return partitionMoved<V, Motion::General>(quantizer, xyz, ranges, count, writer);
    case Motion::Compensated:
      return partitionMoved<V, Motion::Compensated>(quantizer, xyz, ranges, count, writer);
  }
}

}
} // namespace simd
} // namespace pointhaptics
