/// @file
/// Part of VoxelKernelBody.h: quantizes points and bins their records into the partitions.
#pragma once

#include "Core/Resample/Kernel/Loops.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Simd/Words.h"

namespace pointhaptics::simd
{
namespace
{

/// Points that are quantized together before their records are binned.
constexpr int kBatchPoints = 256;

/// Quantized points: their records and partitions, not yet binned. Whole vectors are stored: the last one may
/// reach beyond the batch.
struct QuantizedPoints
{
  int size = 0;
  alignas(64) PointRecord records[kBatchPoints + kWidest];
  alignas(64) std::uint64_t partitions[kBatchPoints + kWidest];
  alignas(64) std::uint32_t indices[kBatchPoints + kWidest];
};

/// v / quantum, correctly rounded.
inline Pack quotient(const PointQuantizer& c, const Pack& v, int axis)
{
  if constexpr (kFuses)
  {
    const Pack reciprocal = all(c.reciprocal[axis]);
    const Pack u = multiplyAdd(v, reciprocal, v * c.remainder[axis]);
    return corrected(u, v, all(c.quantum[axis]), reciprocal);
  }
  return v / c.quantum[axis];
}

/// A row of the matrix times a point, and the offset: the sum of all terms rounded, and what that took from
/// it (T. Ogita, S. M. Rump, S. Oishi, "Accurate sum and dot product", 2005).
inline Pack compensatedDot(const PointQuantizer& c, const Pack p[3], int axis)
{
  Pack sum = all(c.offset[axis]);
  Pack rest = all(c.offsetRest[axis]);
  for (int column = 0; column < 3; ++column)
  {
    const Pack factor = all(c.matrix[axis][column]);
    const Pack term = p[column] * factor;
    rest += productRest(p[column], factor, term);
    const Pack total = sum + term;
    const Pack added = total - sum;
    rest += (sum - (total - added)) + (term - added);
    sum = total;
  }
  return sum + rest;
}

/// @p v: kWidth points in the lattice's frame. Part of the loop whatever the compiler thinks: a call would
/// take the constants out of the registers.
template <Motion motion, typename Real>
__attribute__((always_inline)) inline void move(const PointQuantizer& c, const Real* xyz, Pack v[3])
{
  Pack p[3];
  loadPoints(xyz, p);
  constexpr bool kCompensates = motion == Motion::Compensated || motion == Motion::Fine;
  for (int axis = 0; !kCompensates && axis < 3; ++axis)
  {
    p[axis] -= c.pivot[axis];
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    v[axis] = kCompensates ? compensatedDot(c, p, axis)
      : motion == Motion::Scale
      ? p[axis] * c.matrix[axis][axis] + c.offset[axis]
      : (p[0] * c.matrix[axis][0] + p[1] * c.matrix[axis][1]) + p[2] * c.matrix[axis][2] + c.offset[axis];
  }
}

/// Quantizes kWidth points, which are at @p v in the lattice's frame, into @p quantized, from @p to on. Bit i
/// of the result: point i is inside.
template <bool Fine>
__attribute__((always_inline)) inline unsigned quantizeGroup(
  const PointQuantizer& c, const Pack v[3], QuantizedPoints& quantized, std::int64_t to)
{
  Words inside = allWords(~std::uint64_t(0));
  Words position[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const Pack u = quotient(c, v[axis], axis);
    // 0 <= u < limit; u is not -0.
    inside &= ~bitsOf(u) & reinterpret_cast<Words>(u < c.limit[axis]);
    position[axis] = floorBits(u);
  }
  Words partition = (position[2] & kPositionMask) >> (c.fractionBits + c.layerShift);
  if (c.blocksPerLayer > 1)
  {
    partition = partition * std::uint64_t(c.blocksPerLayer) +
      ((position[1] & kPositionMask) >> (c.fractionBits + c.rowShift));
  }
  *reinterpret_cast<WordsAt*>(quantized.partitions + to) = partition;
  const auto index = [&](int axis) { return (position[axis] & kPositionMask) >> c.fractionBits; };
  Fine ? storePairs(&quantized.records[to].first,
           index(2) << 2 * kFineBits | index(1) << kFineBits | index(0), Words{})
       : storePairs(&quantized.records[to].first, position[0] << kLowBits | (position[2] & kLowMask),
           position[1] << kLowBits | (position[2] >> kLowBits & kLowMask));
  return highestBits(inside);
}

/// Moves the records of the group at @p group that are inside together. @return where the next group goes.
inline std::int64_t keepInside(
  QuantizedPoints& quantized, std::int64_t group, unsigned inside, std::uint32_t index)
{
  std::int64_t to = group;
  for (; inside != 0; inside &= inside - 1, ++to)
  {
    const int i = __builtin_ctz(inside);
    quantized.records[to] = quantized.records[group + i];
    quantized.partitions[to] = quantized.partitions[group + i];
    quantized.indices[to] = index + std::uint32_t(i);
  }
  return to;
}

/// Quantizes groups of kWidth points, no more than fill the batch. Bit i of @p present: a group has a point
/// i. @return how many are not finite. A function of its own, without calls: the constants stay in registers.
template <Motion motion, typename Real>
__attribute__((noinline)) int quantizeGroups(const PointQuantizer& given, const Real* xyz, int groups,
  unsigned present, std::uint32_t index, QuantizedPoints& quantized)
{
  constexpr unsigned kFull = (1u << kWidth) - 1;
  constexpr int kAhead = 2048 / int(sizeof(Real));
  const PointQuantizer constants = given; // A copy, which no store can change.
  std::int64_t size = quantized.size;     // A copy, which no store can change.
  int invalid = 0;
  IntsAt lanes;
  for (int i = 0; i < kWidth; ++i)
  {
    lanes[i] = i;
  }
  for (int g = 0; g < groups; ++g, xyz += 3 * kWidth, index += kWidth)
  {
    __builtin_prefetch(xyz + kAhead);
    if (kWidth * 3 * sizeof(Real) > 64)
    {
      __builtin_prefetch(xyz + kAhead + 64 / sizeof(Real));
    }
    Pack v[3];
    move<motion>(constants, xyz, v);
    const unsigned kept = present & quantizeGroup<motion == Motion::Fine>(constants, v, quantized, size);
    if (__builtin_expect(kept == kFull, true))
    {
      *reinterpret_cast<IntsAt*>(quantized.indices + size) = lanes + std::int32_t(index);
      size += kWidth;
      continue;
    }
    if (kept != present)
    {
      // A coordinate that is not finite makes the difference NaN.
      const Pack zero = (v[0] - v[0]) + (v[1] - v[1]) + (v[2] - v[2]);
      const unsigned finite = highestBits(reinterpret_cast<Words>(zero == 0.0));
      invalid += __builtin_popcount(present & ~finite);
    }
    size = keepInside(quantized, size, kept, index);
  }
  quantized.size = int(size);
  return invalid;
}

/// Copies the tuples of @p size points of an array into payloads.
template <int Bytes>
inline void copyTuples(const PayloadArray& given, const std::uint32_t* numbers, int words, int size, char* to)
{
  constexpr int kAhead = 2048;
  const PayloadArray array = given; // A copy, which no store can change.
  const std::size_t bytes = Bytes > 0 ? std::size_t(Bytes) : std::size_t(array.bytes);
  for (int i = 0; i < size; ++i)
  {
    const char* const tuple = array.values + array.step * numbers[i];
    __builtin_prefetch(tuple + kAhead);
    __builtin_memcpy(to + std::size_t(4 * words * i + array.offset), tuple, bytes);
  }
}

/// The payloads of quantized points.
inline void makePayloads(
  const QuantizedPoints& quantized, const PointRecordWriter& writer, std::uint32_t* payloads)
{
  const int words = writer.layout.words;
  std::uint32_t numbers[kBatchPoints + kWidest];
  for (int i = 0; i < quantized.size; ++i)
  {
    const std::uint32_t index = quantized.indices[i];
    numbers[i] = writer.originals ? writer.originals[index] : writer.firstNumber + index;
  }
  for (int i = 0; writer.layout.numbered && i < quantized.size; ++i)
  {
    payloads[words * i] = writer.firstNumber + quantized.indices[i];
  }
  for (int a = 0; a < writer.layout.count; ++a)
  {
    const PayloadArray& array = writer.layout.arrays[a];
    const auto copy = array.bytes == 1 ? &copyTuples<1>
      : array.bytes == 3               ? &copyTuples<3>
      : array.bytes == 4               ? &copyTuples<4>
      : array.bytes == 12              ? &copyTuples<12>
                                       : &copyTuples<0>;
    copy(array, numbers, words, quantized.size, reinterpret_cast<char*>(payloads));
  }
}

/// Bins quantized points: appends their records to the partitions.
/// @tparam PayloadWords: of a record.
template <int PayloadWords>
inline void binPoints(QuantizedPoints& quantized, PointRecordWriter& writer)
{
  alignas(64) std::uint32_t batchPayloads[PayloadWords > 0 ? PayloadWords * (kBatchPoints + kWidest) : 1];
  if constexpr (PayloadWords > 0)
  {
    makePayloads(quantized, writer, batchPayloads);
  }
  // Copies, which no store can change.
  PointRecord** const cursors = writer.cursors;
  const std::uintptr_t blockMask = writer.blockMask;
  std::uint32_t* const payloads = writer.payloads;
  const auto bin = [&](int i) __attribute__((always_inline))
  {
    const std::uint64_t partition = quantized.partitions[i];
    PointRecord* const cursor = cursorOf(writer, cursors, blockMask, partition);
    cursors[partition] = cursor + 1;
    // In time for the next points, although the lines of hundreds of cursors do not fit the first-level
    // cache.
    fetchToWrite(cursor + 2 * kLineRecords);
    *cursor = quantized.records[i];
    if constexpr (PayloadWords > 0)
    {
      std::uint32_t* const payload = payloads + PayloadWords * (cursor - writer.records);
      fetchToWrite(payload + (PayloadWords > 1 ? 2 : 1) * kLineNumbers);
      __builtin_memcpy(payload, batchPayloads + PayloadWords * i, sizeof(std::uint32_t) * PayloadWords);
    }
  };
  const bool isFull = quantized.size >= kBatchPoints;
  for (int i = 0; i < (isFull ? kBatchPoints : quantized.size); ++i)
  {
    bin(i);
  }
  // Points beyond a full batch become the first of the next one.
  const int left = isFull ? quantized.size - kBatchPoints : 0;
  for (int i = 0; i < left; ++i)
  {
    quantized.records[i] = quantized.records[kBatchPoints + i];
    quantized.partitions[i] = quantized.partitions[kBatchPoints + i];
    quantized.indices[i] = quantized.indices[kBatchPoints + i];
  }
  quantized.size = left;
}

template <Motion motion, typename Real>
void partitionAll(const PointQuantizer& quantizer, const Real* xyz, const PointRange* ranges,
  std::int64_t count, PointRecordWriter& writer)
{
  constexpr decltype(&binPoints<0>) kBins[] = { &binPoints<0>, &binPoints<1>, &binPoints<2>, &binPoints<3>,
    &binPoints<4>, &binPoints<5>, &binPoints<6>, &binPoints<7>, &binPoints<8>, &binPoints<9> };
  static_assert(sizeof kBins / sizeof kBins[0] == PayloadLayout::kMostWords + 1, "one for each width");
  const auto bin = kBins[writer.layout.words];
  QuantizedPoints batch;
  const auto quantize = [&](const Real* from, std::int64_t first, int groups, unsigned present)
  {
    const int before = batch.size;
    writer.invalid +=
      quantizeGroups<motion>(quantizer, from, groups, present, std::uint32_t(first - ranges[0].begin), batch);
    writer.inside += batch.size - before;
    if (batch.size >= kBatchPoints)
    {
      bin(batch, writer);
    }
  };
  for (std::int64_t r = 0; r < count; ++r)
  {
    std::int64_t i = ranges[r].begin;
    for (std::int64_t left = (ranges[r].end - i) / kWidth; left > 0;)
    {
      const int most = (kBatchPoints - batch.size + kWidth - 1) / kWidth;
      const int groups = left < most ? int(left) : most;
      quantize(xyz + 3 * i, i, groups, (1u << kWidth) - 1);
      i += groups * kWidth;
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
  bin(batch, writer);
}

template <typename Real>
void partition(const PointQuantizer& quantizer, const Real* xyz, const PointRange* ranges, std::int64_t count,
  PointRecordWriter& writer)
{
  constexpr decltype(&partition<Real>) kPartitions[] = { &partitionAll<Motion::Scale, Real>,
    &partitionAll<Motion::General, Real>, &partitionAll<Motion::Compensated, Real>,
    &partitionAll<Motion::Fine, Real> };
  kPartitions[int(quantizer.motion)](quantizer, xyz, ranges, count, writer);
}

void fineOffsets(const PointQuantizer& c, const double* xyz, int count, std::uint64_t* offsets)
{
  for (int i = 0; i < count; i += kWidth, xyz += 3 * kWidth, offsets += 3 * kWidth)
  {
    Pack v[3];
    move<Motion::Fine>(c, xyz, v);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Words offset = floorBits(quotient(c, v[axis], axis)) & ((std::uint64_t(1) << c.fractionBits) - 1);
      for (int j = 0; j < kWidth; ++j)
      {
        offsets[3 * j + axis] = offset[j];
      }
    }
  }
}

}
} // namespace pointhaptics::simd
