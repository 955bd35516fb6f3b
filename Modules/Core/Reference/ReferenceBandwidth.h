/// @file
/// Spread, bandwidth and density in long double, straight from the definitions. The oracle of tests and
/// benchmarks; not installed.
#pragma once

#include "Core/Bandwidth/Bandwidth.h"
#include "Core/Base/PointView.h"
#include "Core/Reference/ReferenceNeighbors.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pointhaptics
{
namespace reference
{

struct Spread
{
  long double mean = 0;
  long double standardDeviation = 0;  ///< n - 1 in the denominator.
  long double interquartileRange = 0; ///< Quartiles of type 7: at 1 + (n - 1) p in the sorted sample.
};

inline Spread spread(std::vector<double> values)
{
  Spread result;
  const std::size_t n = values.size();
  if (n < 2)
  {
    return result;
  }
  std::sort(values.begin(), values.end());
  for (const double v : values)
  {
    result.mean += v;
  }
  result.mean /= n;
  long double squares = 0;
  for (const double v : values)
  {
    squares += (v - result.mean) * (v - result.mean);
  }
  result.standardDeviation = std::sqrt(squares / (n - 1));
  const auto quartile = [&](long double p)
  {
    const long double at = (n - 1) * p;
    const std::size_t low = std::size_t(at);
    const std::size_t high = std::min(low + 1, n - 1);
    return values[low] + (at - low) * ((long double)(values[high]) - values[low]);
  };
  result.interquartileRange = quartile(0.75L) - quartile(0.25L);
  return result;
}

/// The factor of s in each rule.
inline long double bandwidthFactor(BandwidthRule rule, long double n, int d)
{
  switch (rule)
  {
    case BandwidthRule::NormalReference:
      return 1.06L * std::pow(n, -0.2L);
    case BandwidthRule::SilvermanRobust:
      return 0.9L * std::pow(n, -0.2L);
    case BandwidthRule::ScottMultivariate:
      return std::pow(n, -1.0L / (d + 4));
    default:
      return std::pow(n * (d + 2) / 4, -1.0L / (d + 4));
  }
}

/// s = sqrt(trace(C) / 2) of the points with the given indices.
inline long double surfaceSpread(const PointView& points, const std::vector<std::int64_t>& indices)
{
  long double trace = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    long double mean = 0;
    for (const std::int64_t i : indices)
    {
      mean += points[i][axis];
    }
    mean /= indices.size();
    for (const std::int64_t i : indices)
    {
      const long double d = points[i][axis] - mean;
      trace += d * d;
    }
  }
  return std::sqrt(trace / (2 * ((long double)(indices.size()) - 1)));
}

/// Gaussian estimate on a surface at @p x, every point summed.
inline long double surfaceDensity(const PointView& points, const Vec3& x, long double b)
{
  long double sum = 0;
  std::int64_t n = 0;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p = points[i];
    if (!isFinite(p))
    {
      continue;
    }
    ++n;
    long double d2 = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const long double d = (long double)(p[axis]) - x[axis];
      d2 += d * d;
    }
    sum += std::exp(-d2 / (2 * b * b));
  }
  return sum / (n * 2 * 3.14159265358979323846264338327950288L * b * b);
}

} // namespace reference
} // namespace pointhaptics
