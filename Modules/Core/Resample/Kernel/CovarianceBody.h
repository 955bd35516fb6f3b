/// @file
/// Part of VoxelKernelBody.h: sums of products, and covariances from them. Internal linkage, like all that
/// sources of several instruction sets share.
#pragma once

#include "Core/Resample/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Which axes the six products are of.
constexpr int kFirstAxis[6] = { 0, 1, 2, 0, 1, 0 };
constexpr int kSecondAxis[6] = { 0, 1, 2, 1, 2, 2 };

/// Adds the products of one record's offsets.
struct ScalarProductAdder
{
  std::uint64_t fractionMask;
  int toTop; ///< Brings an offset to the top of a word, and its product with another, split, to the middle of
             ///< two.

  explicit ScalarProductAdder(int fractionBits)
    : fractionMask((std::uint64_t(1) << fractionBits) - 1)
    , toTop(64 - fractionBits)
  {
  }
  void add(SplitSecondMoments& sums, const PointRecord& r) const
  {
    const std::uint64_t fractions[3] = { xFraction(r, fractionMask), yFraction(r, fractionMask),
      zFraction(r, fractionMask) };
    for (int m = 0; m < 6; ++m)
    {
      const UInt128 product = UInt128(fractions[kFirstAxis[m]] << toTop) * fractions[kSecondAxis[m]];
      sums.high[m] += std::uint64_t(product >> 64);
      sums.low[m] += std::uint64_t(product) >> toTop;
    }
  }
};

/// A voxel with more points than this may have a central sum of products, which is below n 2^(2
/// fractionBits), that 53 bits and another 32 do not hold.
inline std::int64_t mostCovariancePoints(int fractionBits)
{
  const int bits = 85 - 2 * fractionBits;
  return std::int64_t(1) << (bits < kCountShift ? bits : kCountShift);
}

/// What covarianceOf() returns, in 64-bit arithmetic. About an integer m near the mean, with
/// sum = n m + rest, the central sum of a product is
///   S_ab - m_a sum_b - m_b rest_a.
/// Modulo 2^64 integers give it exactly; doubles are nearer to it than 2^63 and show which multiple of 2^64
/// that leaves out. Both together make 53 bits and the last 32, whose sum is rounded once.
inline void covariance(const CovarianceMap& map, const PackedSums& packed,
  const SplitSecondMoments& secondMoments, double* covariance)
{
  // Adding and subtracting it rounds to an integer.
  constexpr double kRounder = 0x1.8p52;
  const auto count = packedCount(packed);
  const double perPoint = 1.0 / double(count);
  const double highUnit = double(std::int64_t(1) << map.fractionBits);
  const std::int64_t sums[3] = { std::int64_t(packed.lanes[0]), std::int64_t(packed.lanes[1]),
    packedZ(packed) };
  std::uint64_t m[3];
  std::int64_t rest[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    m[axis] = std::uint64_t(std::int64_t(double(sums[axis]) * perPoint));
    rest[axis] = sums[axis] - std::int64_t(m[axis]) * count;
  }
  for (int i = 0; i < 6; ++i)
  {
    const int a = kFirstAxis[i];
    const int b = kSecondAxis[i];
    const std::uint64_t sum = (secondMoments.high[i] << map.fractionBits) + secondMoments.low[i];
    const std::uint64_t bits = sum - m[a] * std::uint64_t(sums[b]) - m[b] * std::uint64_t(rest[a]);
    const double near =
      double(std::int64_t(secondMoments.high[i])) * highUnit - double(std::int64_t(m[a])) * double(sums[b]);
    const double turns = (near - double(std::int64_t(bits))) * 0x1p-64 + kRounder - kRounder;
    const double high = turns * 0x1p32 + double(std::int32_t(bits >> 32));
    const double central = high * 0x1p32 + double(std::uint32_t(bits));
    const double value = (central - double(rest[a]) * double(rest[b]) * perPoint) * perPoint;
    covariance[i] = (a == b && value < 0.0 ? 0.0 : value) * map.unit[a] * map.unit[b];
  }
}

/// Lists the voxels with more points than that. @return how many there are.
inline int listFull(const CovarianceMap& map, const PackedSums* sums, int count, int* full)
{
  const std::int64_t most = mostCovariancePoints(map.fractionBits);
  int found = 0;
  for (int i = 0; i < count; ++i)
  {
    if (packedCount(sums[i]) > most)
    {
      full[found++] = i;
    }
  }
  return found;
}

/// Operation by operation those of covariance(), for V::width voxels.
template <class V>
inline void covariancesTogether(const CovarianceMap& map, const PackedSums* packed,
  const SplitSecondMoments* secondMoments, double* covariances)
{
  using Bits = typename V::Bits;
  using Doubles = typename V::Doubles;
  Bits lanes[4], split[12];
  V::loadPacked(packed, lanes);
  for (std::size_t word = 0; word < 12; word += 4)
  {
    V::loadWords(secondMoments, sizeof(std::uint64_t) * word, split + word);
  }
  const Bits count = V::template rightBy<kCountShift>(lanes[3]);
  const Bits z = V::addBits(lanes[2], V::template left<kLowBits>(V::onlyPosition(lanes[3])));
  const Bits sums[3] = { lanes[0], lanes[1], z };
  const Doubles perPoint = V::quotient(V::all(1.0), V::toDoubles(count));
  const Doubles highUnit = V::all(double(std::int64_t(1) << map.fractionBits));
  const typename V::Shift shift = V::shift(map.fractionBits);
  Bits m[3], rest[3];
  Doubles mReal[3], sumReal[3], restReal[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    sumReal[axis] = V::toDoubles(sums[axis]);
    m[axis] = V::truncated(V::multiply(sumReal[axis], perPoint), mReal[axis]);
    rest[axis] = V::subtractBits(sums[axis], V::product(m[axis], count));
    restReal[axis] = V::toDoubles(rest[axis]);
  }
  const Doubles wordUnit = V::all(0x1p32);
  Doubles result[6];
  for (int i = 0; i < 6; ++i)
  {
    const int a = kFirstAxis[i];
    const int b = kSecondAxis[i];
    const Bits sum = V::addBits(V::leftBy(split[i], shift), split[6 + i]);
    const Bits bits =
      V::subtractBits(V::subtractBits(sum, V::product(m[a], sums[b])), V::product(m[b], rest[a]));
    const Doubles near =
      V::subtract(V::multiply(V::toDoubles(split[i]), highUnit), V::multiply(mReal[a], sumReal[b]));
    const Doubles turns = V::nearest(V::multiply(V::subtract(near, V::toDoubles(bits)), V::all(0x1p-64)));
    const Doubles high = V::add(V::multiply(turns, wordUnit), V::upperWord(bits));
    const Doubles central = V::add(V::multiply(high, wordUnit), V::lowerWord(bits));
    const Doubles restProduct = V::multiply(V::multiply(restReal[a], restReal[b]), perPoint);
    Doubles value = V::multiply(V::subtract(central, restProduct), perPoint);
    if (a == b)
    {
      value = V::most(value, V::all(0.0));
    }
    result[i] = V::multiply(V::multiply(value, V::all(map.unit[a])), V::all(map.unit[b]));
  }
  for (int i = 0; i < 6; i += 2)
  {
    V::storePairs(covariances + i, result[i], result[i + 1]);
  }
}

/// V::width at a time.
template <class V>
inline int covariancesInVectors(const CovarianceMap& map, const PackedSums* sums,
  const SplitSecondMoments* secondMoments, int count, double* covariances, int* full)
{
  const int whole = count / V::width * V::width;
  for (int i = 0; i < whole; i += V::width)
  {
    covariancesTogether<V>(map, sums + i, secondMoments + i, covariances + 6 * i);
  }
  for (int i = whole; i < count; ++i)
  {
    covariance(map, sums[i], secondMoments[i], covariances + 6 * i);
  }
  return listFull(map, sums, count, full);
}

}
} // namespace simd
} // namespace pointhaptics
