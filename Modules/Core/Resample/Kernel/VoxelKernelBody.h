/// @file
/// The loops of VoxelKernel.h, written once over the vectors of Core/Simd. Included by one source file per
/// instruction set, each compiled with its own flags: everything here has internal linkage, and nothing of
/// the standard library is called, so that no function compiled for one set can stand in for another's.
#pragma once

#include "Core/Base/PointBlocks.h"
#include "Core/Resample/Kernel/Loops.h"
#include "Core/Resample/Kernel/QuantizeBody.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Simd/Words.h"

#include <cstdint>
#include <limits>
#include <type_traits>

namespace pointhaptics::simd
{

namespace
{

/// Widens the box by the transformed points that are finite, as AffineTransform::apply() rounds them.
/// @tparam Diagonal: the other products are 0, and change nothing.
template <bool Diagonal, typename Real>
void boundsOfPacked(const double matrix[3][4], const Real* xyz, std::int64_t count, double box[6])
{
  Pack low[3], high[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = all(__builtin_inf());
    high[axis] = all(-__builtin_inf());
  }
  const auto include = [&](const Real* from)
  {
    Pack p[3], moved[3];
    loadPoints(from, p);
    // A coordinate that is not finite makes the sum NaN.
    Pack check = (p[0] - p[0]) + (p[1] - p[1]) + (p[2] - p[2]);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* row = matrix[axis];
      moved[axis] =
        (Diagonal ? row[axis] * p[axis] : (row[0] * p[0] + row[1] * p[1]) + row[2] * p[2]) + row[3];
      check += moved[axis] - moved[axis];
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      // Not a number: neither is chosen.
      low[axis] = smaller(moved[axis] + check, low[axis]);
      high[axis] = larger(moved[axis] + check, high[axis]);
    }
  };
  for (; count >= kWidth; count -= kWidth, xyz += 3 * kWidth)
  {
    include(xyz);
  }
  for (; count > 0; --count, xyz += 3)
  {
    Real one[3 * kWidth];
    for (int j = 0; j < 3 * kWidth; ++j)
    {
      one[j] = xyz[j % 3];
    }
    include(one);
  }
  for (int j = 0; j < 3 * kWidth; ++j)
  {
    double* const ends = box + 2 * (j % 3);
    ends[0] = low[j % 3][j / 3] < ends[0] ? low[j % 3][j / 3] : ends[0];
    ends[1] = high[j % 3][j / 3] > ends[1] ? high[j % 3][j / 3] : ends[1];
  }
}

template <typename Real>
void bounds(
  const double matrix[3][4], const Real* xyz, std::int64_t count, std::int64_t stride, double box[6])
{
  const auto ofPacked = isDiagonal(matrix) ? &boundsOfPacked<true, Real> : &boundsOfPacked<false, Real>;
  forPointBlocks(xyz, PointView(xyz, count, stride), 0, count,
    [&](const Real* some, std::int64_t size) { ofPacked(matrix, some, size, box); });
}

inline void fetchRecords(const PointRecord* records, int count)
{
  for (int i = 0; i < count; i += kLineRecords)
  {
    fetchToWrite(records + i);
  }
}

void cellsOf(
  const CellMap& given, const PointRecord* records, int count, const PointRecord* next, std::uint32_t* cells)
{
  const CellMap map = given; // A copy, which no store can change.
  const int toIndex = kLowBits + map.fractionBits;
  const int toLayer = map.fractionBits - kLowBits;
  constexpr int kStep = 64;
  for (int first = 0; first < count; first += kStep)
  {
    const int last = count - first < kStep ? count : first + kStep;
    fetchRecords(next + first, last - first);
    for (int i = first; i < last; ++i)
    {
      const auto x = std::uint32_t(records[i].first >> toIndex);
      const auto y = std::uint32_t(records[i].second >> toIndex);
      const auto z = std::uint32_t((records[i].second & kLowMask) >> toLayer);
      cells[i] = x + map.columns * (y + map.rowsPerLayer * z - map.firstRecordRow);
    }
  }
}

std::uint32_t rankCells(
  const CellTables& given, std::uint32_t* cells, std::size_t count, std::uint32_t* occupied)
{
  const CellTables tables = given; // A copy, which no store can change.
  const auto occupy = [=](std::size_t i)
  { tables.occupancy[cells[i] / 64] |= std::uint64_t(1) << (cells[i] % 64); };
  // Neighbours in a scan are in one word, and an update would wait for the one before: updates elsewhere hide
  // this latency.
  const std::size_t part = count / 4;
  for (std::size_t i = 0; i < part; ++i)
  {
    occupy(i);
    occupy(i + part);
    occupy(i + 2 * part);
    occupy(i + 3 * part);
  }
  for (std::size_t i = 4 * part; i < count; ++i)
  {
    occupy(i);
  }
  std::uint32_t sum = 0;
  for (std::size_t word = 0; word < tables.words; ++word)
  {
    tables.rankTable[word] = sum;
    sum += onesOf(tables.occupancy[word]);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t cell = cells[i];
    const std::uint64_t below = (std::uint64_t(1) << (cell % 64)) - 1;
    const std::uint32_t rank = tables.rankTable[cell / 64] + onesOf(tables.occupancy[cell / 64] & below);
    occupied[rank] = cell;
    cells[i] = rank;
  }
  for (std::size_t word = 0; word < tables.words; ++word)
  {
    tables.occupancy[word] = 0;
  }
  return sum;
}

/// Adds the offsets of a record to the four lanes of its cell's sums.
struct RecordAdder
{
  typedef std::uint64_t Two __attribute__((vector_size(16), may_alias));
  typedef std::uint64_t Four __attribute__((vector_size(32), may_alias));
  Four masks;

  explicit RecordAdder(int fractionBits)
  {
    const std::uint64_t fraction = (std::uint64_t(1) << fractionBits) - 1;
    masks = Four{ fraction, fraction, kLowMask, fraction >> kLowBits };
  }
  void add(PackedSums& sums, const PointRecord& r) const
  {
    const Two words = reinterpret_cast<const Two&>(r);
    const Four parts = __builtin_shufflevector(words >> kLowBits, words, 0, 1, 2, 3) & masks;
    reinterpret_cast<Four&>(sums.lanes) += parts + Four{ 0, 0, 0, std::uint64_t(1) << kCountShift };
  }
};

/// A function of its own: its vectors would take registers from the loop over the sums.
__attribute__((noinline)) void accumulateProducts(
  int fractionBits, const PointRecord* records, const std::uint32_t* ranks, int count, SecondMoments* to)
{
  const std::uint64_t mask = (std::uint64_t(1) << fractionBits) - 1;
  for (int i = 0; i < count; ++i)
  {
    const PointRecord& r = records[i];
    addProducts(to[ranks[i]], xFraction(r, mask), yFraction(r, mask), zFraction(r, mask));
  }
}

void accumulate(int fractionBits, const PointRecord* records, const std::uint32_t* ranks, int count,
  const PointRecord* next, PackedSums* sums, SecondMoments* secondMoments)
{
  const RecordAdder adder(fractionBits);
  constexpr int kStep = 64;
  for (int first = 0; first < count; first += kStep)
  {
    const int last = count - first < kStep ? count : first + kStep;
    fetchRecords(next + first, last - first);
    for (int i = first; i < last; ++i)
    {
      adder.add(sums[ranks[i]], records[i]);
    }
  }
  if (secondMoments)
  {
    accumulateProducts(fractionBits, records, ranks, count, secondMoments);
  }
}

/// The packed sums of kWidth voxels.
struct PackedVectors
{
  Words count;
  Words sums[3];

  explicit PackedVectors(const PackedSums* from)
  {
    Words lanes[4];
    turnWords(from->lanes, sizeof *from / sizeof from->lanes[0], lanes);
    count = lanes[3] >> kCountShift;
    sums[0] = lanes[0];
    sums[1] = lanes[1];
    sums[2] = lanes[2] + ((lanes[3] & ((std::uint64_t(1) << kCountShift) - 1)) << kLowBits);
  }
};

/// Coordinates of means, from sums and voxels' indices. Bit i of the result: that of voxel i is clear of the
/// faces.
inline unsigned meansOf(const MeanMap& map, const PackedVectors& packed, const Pack indices[3], Pack xyz[3])
{
  const Pack count = smallToNumbers(packed.count);
  const Pack reciprocal = 1.0 / count;
  Words clear = allWords(~std::uint64_t(0));
  for (int axis = 0; axis < 3; ++axis)
  {
    // Correctly rounded, for counts below 2^48. The product is within 2^-52 of the quotient, relatively, and
    // what is corrected within 2^-103: no quotient by such a count is that near to the midpoint of two
    // doubles.
    const Pack sum = toNumbers(packed.sums[axis]);
    const Pack fraction = kFuses ? corrected(sum * reciprocal, sum, count, reciprocal) : sum / count;
    xyz[axis] = map.origin[axis] + multiplyAdd(fraction, all(map.quantum), indices[axis]) * map.spacing[axis];
    const Pack above = fraction - map.margin[axis];
    clear &= ~bitsOf(above) & reinterpret_cast<Words>(above < map.clearance[axis]);
  }
  return highestBits(clear);
}

template <typename Real>
int packedMeans(const MeanMap& given, const CellMap& cellMap, const std::uint32_t* cells,
  const PackedSums* packed, int size, Real* xyz, std::int64_t* counts, int* nearFace)
{
  const MeanMap map = given; // A copy, which no store can change.
  const double columns = cellMap.columns;
  const double rows = cellMap.rowsPerLayer;
  // The integer below a quotient a / b of integers, from 1 / b: the one nearest to (a + 1/2) / b - 1/2, which
  // rounding does not carry over a midpoint.
  const Pack perColumn = all(1.0 / columns);
  const Pack perLayer = all(1.0 / rows);
  const Pack toColumn = all(0.5 / columns - 0.5);
  const Pack toLayer = all(0.5 / rows - 0.5);
  constexpr int kAhead = 64; // The result is memory of another update, far away.
  int found = 0;
  for (int i = 0; i < size; i += kWidth)
  {
    fetchToWrite(xyz + 3 * (i + kAhead), 3 * kWidth * sizeof(Real));
    fetchToWrite(counts + i + kAhead, kWidth * sizeof(std::int64_t));
    const PackedVectors voxels(packed + i);
    const Pack cell = numbersAt(cells + i);
    const Pack localRow = nearest(multiplyAdd(cell, perColumn, toColumn));
    const Pack row = localRow + double(cellMap.firstRow);
    const Pack layer = nearest(multiplyAdd(row, perLayer, toLayer));
    const Pack indices[3] = { cell - localRow * columns, row - layer * rows, layer };
    Pack means[3];
    unsigned nearFaces = ((1u << kWidth) - 1) & ~meansOf(map, voxels, indices, means);
    const int last = size - i < kWidth ? size - i : kWidth;
    if (last == kWidth)
    {
      storePoints(xyz + 3 * i, means);
      *reinterpret_cast<WordsAt*>(counts + i) = voxels.count;
    }
    for (int v = 0; last < kWidth && v < last; ++v)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        xyz[3 * (i + v) + axis] = Real(means[axis][v]);
      }
      counts[i + v] = std::int64_t(voxels.count[v]);
    }
    for (; nearFaces != 0; nearFaces &= nearFaces - 1)
    {
      const int v = __builtin_ctz(nearFaces);
      nearFace[found] = i + v;
      found += v < last;
    }
  }
  return found;
}

/// Each key is compared with each, without branches, which would be unpredictable. The mode is the one that
/// is there most often, the smallest of several; the median the lower middle one: of those that are greater
/// more are below.
template <bool Median, typename Key>
void select(const void* list, int count, void* to)
{
  using Number = std::make_signed_t<Key>;
  const Key* const keys = static_cast<const Key*>(list);
  typedef Key Keys __attribute__((vector_size(kListVector)));
  typedef Key KeysAt __attribute__((vector_size(kListVector), aligned(sizeof(Key)), may_alias));
  typedef Number Numbers __attribute__((vector_size(kListVector)));
  constexpr int kInVector = kListVector / int(sizeof(Key));
  constexpr Key kLargest = std::numeric_limits<Key>::max();
  Numbers lanes;
  for (int i = 0; i < kInVector; ++i)
  {
    lanes[i] = Number(i);
  }
  const auto isBetter = [=](const auto& key, const auto& number, const auto& best, const auto& most)
  {
    return Median ? (number <= Number((count - 1) / 2)) & (key > best)
                  : (number > most) | ((number == most) & (key < best));
  };
  Keys best = Keys{} + (Median ? std::numeric_limits<Key>::lowest() : kLargest);
  Numbers most{};
  for (int first = 0; first < count; first += kInVector)
  {
    const Keys those = *reinterpret_cast<const KeysAt*>(keys + first);
    Numbers numbers{};
    for (int j = 0; j < count; ++j)
    {
      numbers -= Median ? Numbers(keys[j] < those) : Numbers(keys[j] == those);
    }
    const int left = count - first < kInVector ? count - first : kInVector;
    const auto better = Numbers(isBetter(those, numbers, best, most)) & Numbers(lanes < Number(left));
    best = Keys((Numbers(those) & better) | (Numbers(best) & ~better));
    most = (numbers & better) | (most & ~better);
  }
  Key result = best[0];
  Number number = most[0];
  for (int i = 1; i < kInVector && i < count; ++i)
  {
    const bool better = Median ? best[i] > result : isBetter(Key(best[i]), Number(most[i]), result, number);
    result = better ? best[i] : result;
    number = better ? most[i] : number;
  }
  *static_cast<Key*>(to) = result;
}

template <bool Median>
constexpr SelectKernel kSelect[] = { &select<Median, std::int8_t>, &select<Median, std::uint8_t>,
  &select<Median, std::int16_t>, &select<Median, std::uint16_t>, &select<Median, std::int32_t>,
  &select<Median, std::uint32_t>, &select<Median, std::int64_t>, &select<Median, std::int64_t>,
  &select<Median, std::int32_t>, &select<Median, std::int64_t> };

template <typename Real>
constexpr PointKernels<Real> kPointKernels = { &partition<Real>, &packedMeans<Real>, &bounds<Real> };

constexpr Kernels kKernels = { { kPointKernels<float>, kPointKernels<double> }, &cellsOf, &rankCells,
  &accumulate, &fineOffsets, kSelect<false>, kSelect<true> };

}

} // namespace pointhaptics::simd
