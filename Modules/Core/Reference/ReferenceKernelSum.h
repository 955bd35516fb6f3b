/// @file
/// Kernel sums and the Sheather-Jones bandwidths in long double, every pair summed, straight from the
/// definitions. The oracle of tests and benchmarks; not installed.
#pragma once

#include "Core/Reference/ReferenceBandwidth.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace reference
{

/// He_r(t) exp(-t^2 / 2) for r = 4, 6.
inline long double gaussianDerivative(long double t, int order)
{
  const long double q = t * t;
  const long double height = std::exp(-q / 2);
  return order == 4 ? (q * q - 6 * q + 3) * height : (q * q * q - 15 * q * q + 45 * q - 15) * height;
}

/// Over all pairs, each value with itself among them.
inline long double pairSum(const std::vector<double>& sample, long double h, int order)
{
  long double sum = 0;
  for (std::size_t i = 0; i < sample.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      sum += 2 * gaussianDerivative(((long double)(sample[i]) - sample[j]) / h, order);
    }
    sum += gaussianDerivative(0, order);
  }
  return sum;
}

/// Sheather and Jones 1991, in their steps; s = min(sd, IQR / 1.349).
class SheatherJonesOracle
{
public:
  explicit SheatherJonesOracle(const std::vector<double>& sample)
    : sample_(sample)
    , n_((long double)(sample.size()))
  {
    const Spread of = spread(sample);
    scale_ = of.interquartileRange > 0 ? std::min(of.standardDeviation, of.interquartileRange / 1.349L)
                                       : of.standardDeviation;
    third_ = -functional(1.23L * scale_ * std::pow(n_, -1.0L / 9), 6);
    const long double second = functional(1.24L * scale_ * std::pow(n_, -1.0L / 7), 4);
    factor_ = 1.357L * std::pow(second / third_, 1.0L / 7);
  }

  /// The sign changes of the equation are looked for downwards, then upwards, from 1.144 s n^(-1/5) in steps
  /// of a fifth; then it is halved.
  long double solveTheEquation() const
  {
    long double high = 1.144L * scale_ * std::pow(n_, -0.2L);
    long double low = high;
    while (excess(low) < 0)
    {
      high = low;
      low /= 1.2L;
    }
    while (excess(high) > 0)
    {
      low = high;
      high *= 1.2L;
    }
    for (int i = 0; i < 50; ++i)
    {
      const long double middle = (low + high) / 2;
      (excess(middle) > 0 ? low : high) = middle;
    }
    return (low + high) / 2;
  }

private:
  /// Estimate of the integral of f times its derivative of the given order.
  long double functional(long double g, int order) const
  {
    return pairSum(sample_, g, order) /
      (n_ * (n_ - 1) * std::sqrt(2 * 3.14159265358979323846264338327950288L) * std::pow(g, 1.0L + order));
  }
  long double optimal(long double g) const
  {
    return std::pow(2 * std::sqrt(3.14159265358979323846264338327950288L) * n_ * functional(g, 4), -0.2L);
  }
  long double excess(long double h) const { return optimal(factor_ * std::pow(h, 5.0L / 7)) - h; }

  const std::vector<double>& sample_;
  long double n_ = 0;
  long double scale_ = 0;
  long double third_ = 0;
  long double factor_ = 0;
};

} // namespace reference
} // namespace pointhaptics
