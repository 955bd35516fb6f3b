/// @file
/// Univariate samples of many kinds with fixed seeds, for the tests of kernel sums and bandwidths.
#pragma once

#include "RandomClouds.h"

#include <cmath>
#include <vector>

namespace pointhaptics
{
namespace trial
{

/// Kinds: 0 uniform, 1 normal, 2 two clusters of very different width, 3 few distinct values, 4 heavy tails,
/// 5 all equal. Spread about 1 (4: unbounded), at @p offset and times @p scale.
inline std::vector<double> randomSample(
  std::size_t n, int kind, std::uint64_t seed, double offset = 0.0, double scale = 1.0)
{
  Random random(seed);
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i)
  {
    double v = random.uniform();
    switch (kind)
    {
      case 0:
        break;
      case 1:
        v = random.normal();
        break;
      case 2:
        v = v < 0.6 ? 1e-3 * random.normal() : 1.5 + 0.5 * random.normal();
        break;
      case 3:
        v = std::floor(9.0 * v) / 4.0;
        break;
      case 4:
        v = std::tan(3.1 * (v - 0.5));
        break;
      default:
        v = 0.25;
    }
    values.push_back((v + offset) * scale);
  }
  return values;
}

constexpr int kNumberOfSampleKinds = 6;

/// From @p low to @p high, uniform in the logarithm.
inline double randomMagnitude(Random& random, double low, double high)
{
  return std::exp(random.uniform(std::log(low), std::log(high)));
}

inline std::vector<double> shuffled(const std::vector<double>& values, std::uint64_t seed)
{
  std::vector<double> result;
  for (const std::size_t i : randomOrder(values.size(), seed))
  {
    result.push_back(values[i]);
  }
  return result;
}

} // namespace trial
} // namespace pointhaptics
