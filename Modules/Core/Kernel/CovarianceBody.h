/// @file
/// Part of VoxelKernelBody.h: sums of products, and covariances from them. Internal linkage, like all that
/// sources of several instruction sets share.
#pragma once

#include "Core/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace kernel
{
namespace
{

/// Which axes the six products are of.
constexpr int kFirstAxis[6] = { 0, 1, 2, 0, 1, 0 };
constexpr int kSecondAxis[6] = { 0, 1, 2, 1, 2, 2 };

/// Adds the products of one record's places.
struct ScalarProductAdder
{
  std::uint64_t fractionMask;
  int toTop; ///< Brings a place to the top of a word, and its product with another, split, to the middle of
             ///< two.

  explicit ScalarProductAdder(int fractionBits)
    : fractionMask((std::uint64_t(1) << fractionBits) - 1)
    , toTop(64 - fractionBits)
  {
  }
  void add(SplitSeconds& sums, const Record& r) const
  {
    const std::uint64_t places[3] = { xPlace(r, fractionMask), yPlace(r, fractionMask),
      zPlace(r, fractionMask) };
    for (int m = 0; m < 6; ++m)
    {
      const UInt128 product = UInt128(places[kFirstAxis[m]] << toTop) * places[kSecondAxis[m]];
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
/// Modulo 2^64 integers give it exactly; doubles are nearer to it than 2^63 and tell which multiple of 2^64
/// that leaves out. Both together make 53 bits and the last 32, whose sum is rounded once.
inline void covariance(
  const CovarianceMap& map, const PackedSums& packed, const SplitSeconds& seconds, double* covariance)
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
    const std::uint64_t sum = (seconds.high[i] << map.fractionBits) + seconds.low[i];
    const std::uint64_t bits = sum - m[a] * std::uint64_t(sums[b]) - m[b] * std::uint64_t(rest[a]);
    const double near =
      double(std::int64_t(seconds.high[i])) * highUnit - double(std::int64_t(m[a])) * double(sums[b]);
    const double turns = (near - double(std::int64_t(bits))) * 0x1p-64 + kRounder - kRounder;
    const double high = turns * 0x1p32 + double(std::int32_t(bits >> 32));
    const double central = high * 0x1p32 + double(std::uint32_t(bits));
    const double value = (central - double(rest[a]) * double(rest[b]) * perPoint) * perPoint;
    covariance[i] = (a == b && value < 0.0 ? 0.0 : value) * map.unit[a] * map.unit[b];
  }
}

/// Those from @p first on.
inline int covariancesOneByOne(const CovarianceMap& map, const PackedSums* sums, const SplitSeconds* seconds,
  int first, int count, double* covariances, int* full)
{
  const std::int64_t most = mostCovariancePoints(map.fractionBits);
  int found = 0;
  for (int i = first; i < count; ++i)
  {
    covariance(map, sums[i], seconds[i], covariances + 6 * i);
    if (packedCount(sums[i]) > most)
    {
      full[found++] = i;
    }
  }
  return found;
}

}
} // namespace kernel
} // namespace pointhaptics
