/// @file
/// The loops of VoxelKernel.h, written once over a class of vector operations. Included by one source file
/// per instruction set, each compiled with its own flags: everything here has internal linkage, and nothing
/// of the standard library is called, so that no function compiled for one set can stand in for another's.
#pragma once

#include "Core/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace kernel
{
namespace
{

constexpr int kWidest = 8;

/// The positions of a group of points, ready to be stored.
struct PlacedGroup
{
  alignas(64) Record records[kWidest];
  alignas(64) std::uint64_t partitions[kWidest];
};

inline void appendRecord(RecordWriter& writer, std::uint64_t partition, const Record& record)
{
  Record*& cursor = writer.cursors[partition];
  if ((reinterpret_cast<std::uintptr_t>(cursor) & (kBlockBytes - 1)) == 0)
  {
    cursor = writer.refill(writer, std::uint32_t(partition));
  }
  *cursor++ = record;
}

inline void appendIndexed(
  RecordWriter& writer, std::uint64_t partition, const Record& record, std::uint32_t index)
{
  appendRecord(writer, partition, record);
  writer.indices[writer.cursors[partition] - 1 - writer.records] = index;
}

/// The vectors that stay the same over all points.
template <class V>
struct PlacementVectors
{
  typename V::Doubles pivot[3], matrix[3][3], offset[3], spacing[3], reciprocal[3], limit[3], magic;
  typename V::Bits blocksPerLayer;
  typename V::Shift toRowBlock, toLayerBlock;

  explicit PlacementVectors(const Placement& p)
    : magic(V::all(p.magic))
    , blocksPerLayer(V::allBits(p.blocksPerLayer))
    , toRowBlock(V::shift(p.fractionBits + p.rowShift))
    , toLayerBlock(V::shift(p.fractionBits + p.layerShift))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      pivot[axis] = V::all(p.pivot[axis]);
      offset[axis] = V::all(p.offset[axis]);
      spacing[axis] = V::all(p.spacing[axis]);
      reciprocal[axis] = V::all(p.reciprocal[axis]);
      limit[axis] = V::all(p.limit[axis]);
      for (int column = 0; column < 3; ++column)
      {
        matrix[axis][column] = V::all(p.matrix[axis][column]);
      }
    }
  }
};

/// Places V::width points. Bit i of the result: point i is inside; of @p finite: it has finite coordinates,
/// told only where one is outside.
template <class V, bool Diagonal, typename Real>
inline unsigned placeGroup(
  const PlacementVectors<V>& c, const Real* xyz, PlacedGroup& group, unsigned& finite)
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
    if (Diagonal)
    {
      v[axis] = V::multiply(p[axis], c.matrix[axis][axis]);
    }
    else
    {
      v[axis] = V::add(V::add(V::multiply(p[0], c.matrix[axis][0]), V::multiply(p[1], c.matrix[axis][1])),
        V::multiply(p[2], c.matrix[axis][2]));
    }
    v[axis] = V::add(v[axis], c.offset[axis]);
    const typename V::Doubles u = V::divide(v[axis], c.spacing[axis], c.reciprocal[axis]);
    inside = V::both(inside, V::both(V::notNegative(v[axis]), V::less(u, c.limit[axis])));
    position[axis] = V::floorBits(u, c.magic);
  }
  V::storeBits(group.partitions,
    V::addBits(V::right(position[1], c.toRowBlock),
      V::multiply32(V::right(position[2], c.toLayerBlock), c.blocksPerLayer)));
  const typename V::Bits first = V::either(position[0], V::template left<kPositionBits>(position[2]));
  const typename V::Bits second =
    V::either(position[1], V::template left<kPositionBits>(V::template rightBy<kLowBits>(position[2])));
  V::storeRecords(group.records, first, second);
  const unsigned bits = V::toUnsigned(inside);
  if (bits != V::full)
  {
    finite = V::toUnsigned(V::both(V::finite(v[0]), V::both(V::finite(v[1]), V::finite(v[2]))));
  }
  return bits;
}

template <class V, bool Indexed>
inline void appendGroup(RecordWriter& writer, const PlacedGroup& group, unsigned inside, std::uint32_t index)
{
  if (inside == V::full)
  {
#pragma GCC unroll 8
    for (int i = 0; i < V::width; ++i)
    {
      if (Indexed)
      {
        appendIndexed(writer, group.partitions[i], group.records[V::slot(i)], index + std::uint32_t(i));
      }
      else
      {
        appendRecord(writer, group.partitions[i], group.records[V::slot(i)]);
      }
    }
    return;
  }
  for (; inside != 0; inside &= inside - 1)
  {
    const int i = __builtin_ctz(inside);
    if (Indexed)
    {
      appendIndexed(writer, group.partitions[i], group.records[V::slot(i)], index + std::uint32_t(i));
    }
    else
    {
      appendRecord(writer, group.partitions[i], group.records[V::slot(i)]);
    }
  }
}

template <class V, bool Diagonal, bool Indexed, typename Real>
void partitionAll(
  const Placement& placement, const Real* xyz, std::int64_t count, std::uint32_t index, RecordWriter& writer)
{
  constexpr int kAhead = 4096 / int(sizeof(Real));
  const PlacementVectors<V> constants(placement);
  PlacedGroup group;
  const unsigned full = V::full;
  std::int64_t inside = 0;
  std::int64_t invalid = 0;
  unsigned finite = 0;
  std::int64_t i = 0;
  for (; i + V::width <= count; i += V::width)
  {
    const Real* p = xyz + 3 * i;
    __builtin_prefetch(p + kAhead);
    if (V::width * 3 * sizeof(Real) > 64)
    {
      __builtin_prefetch(p + kAhead + 64 / sizeof(Real));
    }
    const unsigned bits = placeGroup<V, Diagonal>(constants, p, group, finite);
    inside += __builtin_popcount(bits);
    if (bits != full)
    {
      invalid += __builtin_popcount(full & ~bits & ~finite);
    }
    appendGroup<V, Indexed>(writer, group, bits, index + std::uint32_t(i));
  }
  if (i < count)
  {
    Real last[3 * kWidest] = {};
    for (std::int64_t j = 0; j < 3 * (count - i); ++j)
    {
      last[j] = xyz[3 * i + j];
    }
    const unsigned present = (1u << unsigned(count - i)) - 1;
    const unsigned bits = placeGroup<V, Diagonal>(constants, last, group, finite) & present;
    inside += __builtin_popcount(bits);
    if (bits != present)
    {
      // Where the padding alone is outside, finite was told too: some lane was outside.
      invalid += __builtin_popcount(present & ~bits & ~finite);
    }
    appendGroup<V, Indexed>(writer, group, bits == full ? full : bits, index + std::uint32_t(i));
  }
  writer.inside += inside;
  writer.invalid += invalid;
}

template <class V, typename Real>
void partition(
  const Placement& placement, const Real* xyz, std::int64_t count, std::uint32_t index, RecordWriter& writer)
{
  const bool indexed = writer.indices != nullptr;
  if (placement.diagonal)
  {
    indexed ? partitionAll<V, true, true>(placement, xyz, count, index, writer)
            : partitionAll<V, true, false>(placement, xyz, count, index, writer);
  }
  else
  {
    indexed ? partitionAll<V, false, true>(placement, xyz, count, index, writer)
            : partitionAll<V, false, false>(placement, xyz, count, index, writer);
  }
}

inline std::uint32_t cellOf(const CellMap& map, const Record& r)
{
  const auto x = std::uint32_t((r.first & kPositionMask) >> map.fractionBits);
  const auto y = std::uint32_t((r.second & kPositionMask) >> map.fractionBits);
  const auto z = std::uint32_t(r.second >> (kPositionBits - kLowBits + map.fractionBits));
  const std::uint32_t row = y + map.rowsPerLayer * z;
  return x + map.columns * ((row < map.firstRow ? row + map.upperRows : row) - map.firstRow);
}

template <class V>
void accumulate(const CellMap& map, const Record* records, int count, CellSums& to)
{
  alignas(64) std::uint32_t cells[kBlockRecords + kWidest];
  V::cells(map, records, count, cells);
  const typename V::Adder adder(map.fractionBits);
  std::uint32_t* slots = to.slots;
  std::uint32_t* met = to.cells;
  PackedSums* sums = to.sums;
  std::uint32_t size = to.size;
  const auto addOne = [&](int i)
  {
    const std::uint32_t cell = cells[i];
    // No branch: whether a cell is new is anybody's guess.
    const std::uint32_t known = slots[cell];
    met[size] = cell;
    size += known == 0;
    const std::uint32_t slot = known == 0 ? size : known;
    slots[cell] = slot;
    cells[i] = slot - 1;
    adder.add(sums[slot - 1], records[i]);
  };
  // Neighbours in a scan are in one cell, and each sum would wait for the one before: take them from four
  // places in turn.
  const int quarter = count / 4;
  for (int i = 0; i < quarter; ++i)
  {
    addOne(i);
    addOne(i + quarter);
    addOne(i + 2 * quarter);
    addOne(i + 3 * quarter);
  }
  for (int i = 4 * quarter; i < count; ++i)
  {
    addOne(i);
  }
  to.size = size;
  if (to.seconds)
  {
    const std::uint64_t fractionMask = (std::uint64_t(1) << map.fractionBits) - 1;
    for (int i = 0; i < count; ++i)
    {
      const Record& r = records[i];
      addProducts(
        to.seconds[cells[i]], xPlace(r, fractionMask), yPlace(r, fractionMask), zPlace(r, fractionMask));
    }
  }
}

/// Four bits at a time, whether there are as many or not: a branch on each would be a coin toss.
inline std::size_t listBits(std::uint64_t bits, std::uint32_t first, std::uint32_t* cells)
{
  const int count = __builtin_popcountll(bits);
  for (int i = 0; i < count; i += 4)
  {
    for (int j = 0; j < 4; ++j)
    {
      cells[i + j] = first + std::uint32_t(__builtin_ctzll(bits | std::uint64_t(1) << 63));
      bits &= bits - 1;
    }
  }
  return std::size_t(count);
}

template <class V>
std::size_t drain(
  std::uint64_t* marks, std::uint64_t* summary, std::size_t summaryWords, std::uint32_t* cells)
{
  std::size_t found = 0;
  for (std::size_t s = 0; s < summaryWords; ++s)
  {
    for (std::uint64_t bits = summary[s]; bits != 0; bits &= bits - 1)
    {
      const std::size_t word = 64 * s + std::size_t(__builtin_ctzll(bits));
      found += V::listBits(marks[word], std::uint32_t(64 * word), cells + found);
      marks[word] = 0;
    }
    summary[s] = 0;
  }
  return found;
}

void collect(
  const CellMap& map, const std::uint32_t* cells, int count, CellSums& from, MomentBatch<std::int64_t>& batch)
{
  // The half keeps the quotients clear of the integers: they come out right by truncation.
  const double perColumn = 1.0 / double(map.columns);
  const double perLayer = 1.0 / double(map.rowsPerLayer);
  batch.size = count;
  for (int i = 0; i < count; ++i)
  {
    const auto cell = std::int32_t(cells[i]);
    const auto local = std::int32_t((double(cell) + 0.5) * perColumn);
    const std::int32_t row = local + std::int32_t(map.firstRow);
    const auto layer = std::int32_t((double(row) + 0.5) * perLayer);
    batch.indices[0][i] = cell - local * std::int32_t(map.columns);
    batch.indices[1][i] = row - layer * std::int32_t(map.rowsPerLayer);
    batch.indices[2][i] = layer;
  }
  for (int i = 0; i < count; ++i)
  {
    PackedSums& s = from.sums[from.slots[cells[i]] - 1];
    batch.sums[0][i] = std::int64_t(s.lanes[0]);
    batch.sums[1][i] = std::int64_t(s.lanes[1]);
    batch.sums[2][i] = packedZ(s);
    batch.counts[i] = packedCount(s);
    s = PackedSums{ { 0, 0, 0, 0 } };
  }
  for (int i = 0; from.seconds && i < count; ++i)
  {
    SecondSums& s = from.seconds[from.slots[cells[i]] - 1];
    batch.seconds[i] = s;
    s = SecondSums{ { 0, 0, 0, 0, 0, 0 } };
  }
  for (int i = 0; i < count; ++i)
  {
    from.slots[cells[i]] = 0;
  }
}

/// Lists the lanes of a group that are not clear of the faces.
inline int listLanes(unsigned lanes, int first, int last, int* list, int found)
{
  for (; lanes != 0; lanes &= lanes - 1)
  {
    const int i = first + __builtin_ctz(lanes);
    if (i < last)
    {
      list[found++] = i;
    }
  }
  return found;
}

template <class V, typename Real>
int means(const MeanMap& map, const MomentBatch<std::int64_t>& batch, Real* xyz, int* nearFace)
{
  const typename V::Doubles one = V::all(1.0);
  const typename V::Doubles quantum = V::all(map.quantum);
  alignas(64) Real coordinates[3][kBatch];
  int found = 0;
  // Whole vectors: past the batch's end they work on what an earlier one left there.
  for (int i = 0; i < batch.size; i += V::width)
  {
    const typename V::Doubles count = V::fromInts(batch.counts + i);
    typename V::Mask clear = V::allTrue();
    for (int axis = 0; axis < 3; ++axis)
    {
      const typename V::Doubles place =
        V::multiply(V::quotient(V::fromInts(batch.sums[axis] + i), count), quantum);
      const typename V::Doubles u = V::add(V::fromInts(batch.indices[axis] + i), place);
      V::store(
        coordinates[axis] + i, V::add(V::all(map.origin[axis]), V::multiply(u, V::all(map.spacing[axis]))));
      const typename V::Doubles margin = V::all(map.faceMargin[axis]);
      clear = V::both(clear, V::both(V::less(margin, place), V::less(margin, V::subtract(one, place))));
    }
    const unsigned bits = V::toUnsigned(clear);
    if (bits != V::full)
    {
      found = listLanes(V::full & ~bits, i, batch.size, nearFace, found);
    }
  }
  for (int i = 0; i < batch.size; ++i)
  {
    xyz[3 * i] = coordinates[0][i];
    xyz[3 * i + 1] = coordinates[1][i];
    xyz[3 * i + 2] = coordinates[2][i];
  }
  return found;
}

/// Widens the box by the transformed points that are finite, as AffineTransform::apply() rounds them.
template <class V, typename Real>
void bounds(const double matrix[3][4], const Real* xyz, std::int64_t count, double box[6])
{
  const double infinity = __builtin_inf();
  typename V::Doubles low[3], high[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = V::all(infinity);
    high[axis] = V::all(-infinity);
  }
  const auto include = [&](const Real* from)
  {
    typename V::Doubles p[3], moved[3];
    V::load(from, p[0], p[1], p[2]);
    // What is not finite makes the sum not a number.
    typename V::Doubles check =
      V::add(V::add(V::subtract(p[0], p[0]), V::subtract(p[1], p[1])), V::subtract(p[2], p[2]));
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* row = matrix[axis];
      moved[axis] =
        V::add(V::add(V::add(V::multiply(V::all(row[0]), p[0]), V::multiply(V::all(row[1]), p[1])),
                 V::multiply(V::all(row[2]), p[2])),
          V::all(row[3]));
      check = V::add(check, V::subtract(moved[axis], moved[axis]));
    }
    const typename V::Mask valid = V::finite(check);
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = V::least(low[axis], V::choose(valid, moved[axis], low[axis]));
      high[axis] = V::most(high[axis], V::choose(valid, moved[axis], high[axis]));
    }
  };
  std::int64_t i = 0;
  for (; i + V::width <= count; i += V::width)
  {
    include(xyz + 3 * i);
  }
  if (i < count)
  {
    Real last[3 * kWidest];
    for (int j = 0; j < 3 * kWidest; ++j)
    {
      last[j] = Real(__builtin_nan(""));
    }
    for (std::int64_t j = 0; j < 3 * (count - i); ++j)
    {
      last[j] = xyz[3 * i + j];
    }
    include(last);
  }
  alignas(64) double lanes[kWidest];
  for (int axis = 0; axis < 3; ++axis)
  {
    V::store(lanes, low[axis]);
    for (int j = 0; j < V::width; ++j)
    {
      box[2 * axis] = lanes[j] < box[2 * axis] ? lanes[j] : box[2 * axis];
    }
    V::store(lanes, high[axis]);
    for (int j = 0; j < V::width; ++j)
    {
      box[2 * axis + 1] = lanes[j] > box[2 * axis + 1] ? lanes[j] : box[2 * axis + 1];
    }
  }
}

template <class V>
Kernels makeKernels()
{
  return { &partition<V, float>, &partition<V, double>, &V::cells, &accumulate<V>, &drain<V>, &collect,
    &means<V, float>, &means<V, double>, &bounds<V, float>, &bounds<V, double> };
}

}
} // namespace kernel
} // namespace pointhaptics
