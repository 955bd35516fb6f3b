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

/// Points placed before their records are dealt out: two loops over what stays in the first-level cache take
/// less time than one that does both.
constexpr int kPlacedAtOnce = 256;

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
    if (motion == Motion::Shift)
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
    v[axis] = V::add(v[axis], c.offset[axis]);
    const typename V::Doubles u = Pair ? V::multiplyByPair(v[axis], c.reciprocal[axis], c.remainder[axis])
                                       : V::divide(v[axis], c.spacing[axis], c.reciprocal[axis]);
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

/// Moves the records of a group that are inside together. @p group is where the first of it is.
template <bool Indexed>
inline void keepInside(PlacedPoints& placed, int group, unsigned inside, std::uint32_t index)
{
  for (; inside != 0; inside &= inside - 1)
  {
    const int i = __builtin_ctz(inside);
    placed.records[placed.size] = placed.records[group + i];
    placed.partitions[placed.size] = placed.partitions[group + i];
    if (Indexed)
    {
      placed.indices[placed.size] = index + std::uint32_t(i);
    }
    ++placed.size;
  }
}

template <bool Indexed>
inline void dealOne(const PlacedPoints& placed, int i, RecordWriter& writer)
{
  const std::uint32_t partition = placed.partitions[i];
  Record* cursor = writer.cursors[partition];
  if ((reinterpret_cast<std::uintptr_t>(cursor) & (kBlockBytes - 1)) == 0)
  {
    cursor = writer.refill(writer, partition);
  }
  *cursor = placed.records[i];
  if (Indexed)
  {
    writer.indices[cursor - writer.records] = placed.indices[i];
  }
  ++cursor;
  __builtin_prefetch(cursor + 64 / sizeof(Record), 1);
  writer.cursors[partition] = cursor;
}

/// Appends records that nearly all go to one partition. A cursor that is moved waits for the move before:
/// where four go to one they move it together. @return how many were appended: all but the last few.
inline int dealRun(const PlacedPoints& placed, RecordWriter& writer)
{
  constexpr int kTogether = 4;
  int i = 0;
  for (; i + kTogether <= placed.size; i += kTogether)
  {
    const std::uint32_t* partitions = placed.partitions + i;
    Record* cursor = writer.cursors[partitions[0]];
    const auto inBlock = reinterpret_cast<std::uintptr_t>(cursor) & (kBlockBytes - 1);
    const bool areOne = ((partitions[0] ^ partitions[1]) | (partitions[2] ^ partitions[3]) |
                          (partitions[0] ^ partitions[2])) == 0;
    if (areOne && inBlock != 0 && inBlock <= kBlockBytes - kTogether * sizeof(Record))
    {
      for (int j = 0; j < kTogether; ++j)
      {
        cursor[j] = placed.records[i + j];
      }
      cursor += kTogether;
      __builtin_prefetch(cursor + 64 / sizeof(Record), 1);
      writer.cursors[partitions[0]] = cursor;
      continue;
    }
    for (int j = 0; j < kTogether; ++j)
    {
      dealOne<false>(placed, i + j, writer);
    }
  }
  return i;
}

/// Appends the records to their partitions. Whether they are a run, as in a scan, is asked once for all: a
/// branch on each few guesses wrong where the runs are short.
template <bool Indexed>
inline void deal(const PlacedPoints& placed, RecordWriter& writer)
{
  int i = 0;
  if (!Indexed && placed.size > 0)
  {
    const std::uint32_t first = placed.partitions[0];
    const bool isRun =
      first == placed.partitions[placed.size / 2] && first == placed.partitions[placed.size - 1];
    i = isRun ? dealRun(placed, writer) : 0;
  }
  for (; i < placed.size; ++i)
  {
    dealOne<Indexed>(placed, i, writer);
  }
}

template <class V, Motion motion, bool Pair, bool Indexed, typename Real>
void partitionAll(
  const Placement& placement, const Real* xyz, std::int64_t count, std::uint32_t index, RecordWriter& writer)
{
  constexpr int kAhead = 4096 / int(sizeof(Real));
  const PlacementVectors<V> constants(placement);
  PlacedPoints placed;
  std::int64_t inside = 0;
  std::int64_t invalid = 0;
  const auto place = [&](const Real* from, unsigned present, std::uint32_t first)
  {
    const int group = placed.size;
    unsigned finite = 0;
    const unsigned bits = placeGroup<V, motion, Pair>(constants, from, placed, group, finite);
    if (bits == V::full && present == V::full)
    {
      for (int j = 0; Indexed && j < V::width; ++j)
      {
        placed.indices[group + j] = first + std::uint32_t(j);
      }
      placed.size += V::width;
      return;
    }
    // Where the padding alone is outside, finite was told too: some lane was outside.
    const unsigned kept = bits & present;
    invalid += kept == present ? 0 : __builtin_popcount(present & ~bits & ~finite);
    keepInside<Indexed>(placed, group, kept, first);
  };
  for (std::int64_t i = 0; i < count; inside += placed.size)
  {
    placed.size = 0;
    for (int room = kPlacedAtOnce / V::width; room > 0 && i < count; --room, i += V::width)
    {
      const Real* p = xyz + 3 * i;
      if (i + V::width <= count)
      {
        __builtin_prefetch(p + kAhead);
        if (V::width * 3 * sizeof(Real) > 64)
        {
          __builtin_prefetch(p + kAhead + 64 / sizeof(Real));
        }
        place(p, V::full, index + std::uint32_t(i));
        continue;
      }
      Real last[3 * kWidest] = {};
      for (std::int64_t j = 0; j < 3 * (count - i); ++j)
      {
        last[j] = p[j];
      }
      place(last, (1u << unsigned(count - i)) - 1, index + std::uint32_t(i));
    }
    deal<Indexed>(placed, writer);
  }
  writer.inside += inside;
  writer.invalid += invalid;
}

template <class V, Motion motion, typename Real>
void partitionMoved(
  const Placement& placement, const Real* xyz, std::int64_t count, std::uint32_t index, RecordWriter& writer)
{
  if (V::hasFusedMultiply && placement.pairDivides)
  {
    writer.indices ? partitionAll<V, motion, true, true>(placement, xyz, count, index, writer)
                   : partitionAll<V, motion, true, false>(placement, xyz, count, index, writer);
    return;
  }
  writer.indices ? partitionAll<V, motion, false, true>(placement, xyz, count, index, writer)
                 : partitionAll<V, motion, false, false>(placement, xyz, count, index, writer);
}

template <class V, typename Real>
void partition(
  const Placement& placement, const Real* xyz, std::int64_t count, std::uint32_t index, RecordWriter& writer)
{
  switch (placement.motion)
  {
    case Motion::Shift:
      return partitionMoved<V, Motion::Shift>(placement, xyz, count, index, writer);
    case Motion::Scale:
      return partitionMoved<V, Motion::Scale>(placement, xyz, count, index, writer);
    case Motion::General:
      return partitionMoved<V, Motion::General>(placement, xyz, count, index, writer);
  }
}

/// Makes the number of a byte in memory from that of a byte of a word.
constexpr std::uint32_t kByteOrder = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__ ? 7 : 0;

inline std::uint32_t cellOf(const CellMap& map, const Record& r)
{
  const auto x = std::uint32_t((r.first & kPositionMask) >> map.fractionBits);
  const auto y = std::uint32_t((r.second & kPositionMask) >> map.fractionBits);
  const auto z = std::uint32_t(r.second >> (kPositionBits - kLowBits + map.fractionBits));
  const std::uint32_t row = y + map.rowsPerLayer * z;
  return x + map.columns * ((row < map.firstRow ? row + map.upperRows : row) - map.firstRow);
}

/// Calls visit(i) for all i below @p count. Neighbours in a scan are in one voxel, and what is done to it
/// waits for what was done before: takes them from four places in turn.
template <typename Visit>
inline void fromFourPlaces(int count, Visit&& visit)
{
  const int quarter = count / 4;
  for (int i = 0; i < quarter; ++i)
  {
    visit(i);
    visit(i + quarter);
    visit(i + 2 * quarter);
    visit(i + 3 * quarter);
  }
  for (int i = 4 * quarter; i < count; ++i)
  {
    visit(i);
  }
}

/// By bytes, which neighbours in a scan have in common less often than words.
inline void markCells(const std::uint32_t* cells, int count, std::uint64_t* marks)
{
  auto* bytes = reinterpret_cast<unsigned char*>(marks);
  fromFourPlaces(count,
    [=](int i)
    {
      unsigned char& byte = bytes[(cells[i] / 8) ^ kByteOrder];
      byte = static_cast<unsigned char>(byte | 1u << (cells[i] % 8));
    });
}

template <class V>
void mark(const CellMap& map, const Record* records, int count, const Record* next, std::uint64_t* marks,
  std::uint32_t* cells)
{
  constexpr int kLine = 64 / sizeof(Record);
  constexpr int kStep = 64;
  for (int first = 0; first < count; first += kStep)
  {
    for (int i = first; i < first + kStep; i += kLine)
    {
      __builtin_prefetch(next + i);
    }
    V::cells(map, records + first, count - first < kStep ? count - first : kStep, cells + first);
  }
  markCells(cells, count, marks);
}

/// Counts word by word. @tparam Skips: counting takes so long that groups of words without marks are left
/// out; else it is less than the branches that guess wrong.
template <class V, bool Skips>
inline std::uint32_t numberWords(const CellRanks& ranks)
{
  std::uint32_t sum = 0;
  for (std::size_t group = 0; group < ranks.words; group += kMarkGroup)
  {
    std::uint64_t all = 0;
    for (std::size_t w = group; Skips && w < group + kMarkGroup; ++w)
    {
      all |= ranks.marks[w];
    }
    if (Skips && all == 0)
    {
      continue;
    }
    for (std::size_t w = group; w < group + kMarkGroup; ++w)
    {
      ranks.before[w] = sum;
      sum += V::ones(ranks.marks[w]);
    }
  }
  return sum;
}

template <class V>
inline std::uint32_t rankOf(const CellRanks& ranks, std::uint32_t cell)
{
  const std::uint64_t below = (std::uint64_t(1) << (cell % 64)) - 1;
  return ranks.before[cell / 64] + V::ones(ranks.marks[cell / 64] & below);
}

template <class V>
void rank(const CellRanks& ranks, std::uint32_t* cells, int count)
{
  for (int i = 0; i < count; ++i)
  {
    cells[i] = rankOf<V>(ranks, cells[i]);
  }
}

template <class V>
void accumulate(const CellMap& map, const CellRanks& givenRanks, const Record* records,
  const std::uint32_t* cells, int count, const CellSums& given)
{
  // Copies, which no store can change.
  const CellRanks ranks = givenRanks;
  const CellSums to = given;
  const typename V::Adder adder(map.fractionBits);
  fromFourPlaces(count,
    [=](int i)
    {
      const std::uint32_t rank = rankOf<V>(ranks, cells[i]);
      to.cells[rank] = cells[i];
      adder.add(to.sums[rank], records[i]);
    });
  if (to.seconds)
  {
    const std::uint64_t fractionMask = (std::uint64_t(1) << map.fractionBits) - 1;
    fromFourPlaces(count,
      [=](int i)
      {
        const Record& r = records[i];
        addProducts(to.seconds[rankOf<V>(ranks, cells[i])], xPlace(r, fractionMask), yPlace(r, fractionMask),
          zPlace(r, fractionMask));
      });
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

/// Stores the first of a vector's points, at most @p room.
template <class V, typename Real>
inline void storePoints(Real* to, int room, const typename V::Doubles xyz[3])
{
  if (room >= V::width)
  {
    V::storeInterleaved(to, xyz);
    return;
  }
  Real all[3 * kWidest];
  V::storeInterleaved(all, xyz);
  for (int i = 0; i < 3 * room; ++i)
  {
    to[i] = all[i];
  }
}

/// The constants of MeanMap, in vectors.
template <class V>
struct MeanVectors
{
  using Doubles = typename V::Doubles;
  Doubles origin[3], spacing[3], margin[3], quantum, one;

  explicit MeanVectors(const MeanMap& map)
    : quantum(V::all(map.quantum))
    , one(V::all(1.0))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      origin[axis] = V::all(map.origin[axis]);
      spacing[axis] = V::all(map.spacing[axis]);
      margin[axis] = V::all(map.faceMargin[axis]);
    }
  }
  /// Coordinates of a vector's means. Bit i of the result: that of voxel i is clear of the faces.
  unsigned mean(Doubles count, const Doubles sums[3], const Doubles indices[3], Doubles xyz[3]) const
  {
    const Doubles reciprocal = V::quotient(one, count);
    typename V::Mask clear = V::allTrue();
    for (int axis = 0; axis < 3; ++axis)
    {
      const Doubles place = V::multiply(V::divide(sums[axis], count, reciprocal), quantum);
      const Doubles u = V::add(indices[axis], place);
      xyz[axis] = V::add(origin[axis], V::multiply(u, spacing[axis]));
      clear =
        V::both(clear, V::both(V::less(margin[axis], place), V::less(margin[axis], V::subtract(one, place))));
    }
    return V::toUnsigned(clear);
  }
};

template <class V, typename Real>
int means(const MeanMap& map, const MomentBatch<std::int64_t>& batch, Real* xyz, int* nearFace)
{
  const MeanVectors<V> constants(map);
  int found = 0;
  // Whole vectors: past the batch's end they work on what an earlier one left there.
  for (int i = 0; i < batch.size; i += V::width)
  {
    typename V::Doubles sums[3], indices[3], means[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      sums[axis] = V::fromInts(batch.sums[axis] + i);
      indices[axis] = V::fromInts(batch.indices[axis] + i);
    }
    const unsigned clear = constants.mean(V::fromInts(batch.counts + i), sums, indices, means);
    storePoints<V>(xyz + 3 * i, batch.size - i, means);
    if (clear != V::full)
    {
      found = listLanes(V::full & ~clear, i, batch.size, nearFace, found);
    }
  }
  return found;
}

template <class V, typename Real>
int packedMeans(const MeanMap& map, const CellMap& cellMap, const std::uint32_t* cells,
  const PackedSums* packed, int size, Real* xyz, std::int64_t* counts, int* nearFace)
{
  using Doubles = typename V::Doubles;
  const MeanVectors<V> constants(map);
  const Doubles columns = V::all(double(cellMap.columns));
  const Doubles perColumn = V::all(1.0 / double(cellMap.columns));
  const Doubles rows = V::all(double(cellMap.rowsPerLayer));
  const Doubles perLayer = V::all(1.0 / double(cellMap.rowsPerLayer));
  const Doubles firstRow = V::all(double(cellMap.firstRow));
  const Doubles half = V::all(0.5);
  // The integer below a quotient a / b of integers, from 1 / b: halves keep it clear of the integers.
  const auto below = [&](Doubles a, Doubles perB)
  { return V::nearest(V::subtract(V::multiply(V::add(a, half), perB), half)); };
  int found = 0;
  for (int i = 0; i < size; i += V::width)
  {
    typename V::Bits lanes[4];
    V::loadPacked(packed + i, lanes);
    const typename V::Bits count = V::template rightBy<kCountShift>(lanes[3]);
    const typename V::Bits z = V::addBits(lanes[2], V::template left<kLowBits>(V::onlyPosition(lanes[3])));
    const Doubles sums[3] = { V::toDoubles(lanes[0]), V::toDoubles(lanes[1]), V::toDoubles(z) };
    const Doubles cell = V::fromInts(reinterpret_cast<const std::int32_t*>(cells + i));
    const Doubles localRow = below(cell, perColumn);
    const Doubles row = V::add(localRow, firstRow);
    const Doubles layer = below(row, perLayer);
    const Doubles indices[3] = { V::subtract(cell, V::multiply(localRow, columns)),
      V::subtract(row, V::multiply(layer, rows)), layer };
    Doubles means[3];
    const unsigned clear = constants.mean(V::toDoubles(count), sums, indices, means);
    storePoints<V>(xyz + 3 * i, size - i, means);
    V::storeCounts(counts + i, size - i, count);
    if (clear != V::full)
    {
      found = listLanes(V::full & ~clear, i, size, nearFace, found);
    }
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
  return { &partition<V, float>, &partition<V, double>, &V::cells, &mark<V>, &markCells, &V::number, &rank<V>,
    &accumulate<V>, &packedMeans<V, float>, &packedMeans<V, double>, &means<V, float>, &means<V, double>,
    &bounds<V, float>, &bounds<V, double> };
}

}
} // namespace kernel
} // namespace pointhaptics
