/// @file
/// Part of VoxelKernelBody.h: from sums to means and covariances.
#pragma once

#include "Core/Resample/Kernel/CellSumBody.h"

namespace pointhaptics::simd
{
namespace
{

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

/// A voxel with more points than this may have a central sum of products, which is below n 2^(2
/// fractionBits), that 53 bits and another 32 do not hold.
inline std::int64_t mostCovariancePoints(int fractionBits)
{
  const int bits = 85 - 2 * fractionBits;
  return std::int64_t(1) << (bits < kCountShift ? bits : kCountShift);
}

/// The integers below numbers from 0 to below 2^52, and the same as numbers.
inline Words truncated(const Pack& v, Pack& real)
{
  const Words bits = floorBits(v);
  real = fromBits(bits) - kToBits;
  return bits ^ bitsOf(all(kToBits));
}

typedef std::uint64_t WordAt __attribute__((may_alias));

/// Computes covarianceOf() in 64-bit arithmetic. About an integer m near the mean, with sum = n m + rest, the
/// central sum of a product is S_ab - m_a sum_b - m_b rest_a. Modulo 2^64 integers give it exactly; doubles
/// are nearer to it than 2^63 and show which multiple of 2^64 that leaves out. Both together make 53 bits and
/// the last 32, whose sum is rounded once.
inline void covariancesTogether(
  const CovarianceMap& map, const PackedSums* packed, const SecondMoments* secondMoments, Pack result[6])
{
  const PackedVectors voxels(packed);
  Words parts[3][4]; // low, high, low, high words of two sums
  for (std::size_t part = 0; part < 3; ++part)
  {
    turnWords(reinterpret_cast<const WordAt*>(secondMoments->lanes + 2 * part),
      sizeof *secondMoments / sizeof(WordAt), parts[part]);
  }
  const Pack perPoint = 1.0 / toNumbers(voxels.count);
  Words m[3], rest[3];
  Pack mReal[3], sumReal[3], restReal[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    sumReal[axis] = toNumbers(voxels.sums[axis]);
    m[axis] = truncated(sumReal[axis] * perPoint, mReal[axis]);
    rest[axis] = voxels.sums[axis] - m[axis] * voxels.count;
    restReal[axis] = toNumbers(rest[axis]);
  }
  for (int i = 0; i < 6; ++i)
  {
    const int a = kFirstAxis[i];
    const int b = kSecondAxis[i];
    const Words& low = parts[i / 2][i % 2 * 2];
    const Words& high = parts[i / 2][i % 2 * 2 + 1];
    const Words bits = low - m[a] * voxels.sums[b] - m[b] * rest[a];
    const Pack sum = (smallToNumbers(high) * 0x1p32 + smallToNumbers(low >> 32)) * 0x1p32;
    const Pack near = sum - mReal[a] * sumReal[b];
    const Pack turns = nearest((near - toNumbers(bits)) * 0x1p-64);
    const Pack upper = smallToNumbers((bits >> 32) ^ 0x80000000u) - 0x1p31; // signed
    const Pack central = (turns * 0x1p32 + upper) * 0x1p32 + smallToNumbers(bits & 0xffffffffu);
    const Pack value = (central - restReal[a] * restReal[b] * perPoint) * perPoint;
    result[i] = (a == b ? larger(value, Pack{}) : value) * map.unit[a] * map.unit[b];
  }
}

int covariances(const CovarianceMap& map, const PackedSums* sums, const SecondMoments* secondMoments,
  int count, double* covariances, int* full)
{
  const std::int64_t most = mostCovariancePoints(map.fractionBits);
  int found = 0;
  for (int i = 0; i < count; i += kWidth)
  {
    Pack result[6];
    covariancesTogether(map, sums + i, secondMoments + i, result);
    for (int v = 0; v < kWidth && i + v < count; ++v)
    {
      for (int m = 0; m < 6; ++m)
      {
        covariances[6 * (i + v) + m] = result[m][v];
      }
      full[found] = i + v;
      found += packedCount(sums[i + v]) > most;
    }
  }
  return found;
}

}
} // namespace pointhaptics::simd
