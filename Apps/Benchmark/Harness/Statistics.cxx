#include "Benchmark/Harness/Statistics.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics::bench
{

double quantile(const std::vector<double>& sorted, double p)
{
  const double position = p * double(sorted.size() - 1);
  const std::size_t below = std::min(std::size_t(position), sorted.size() - 1);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - double(below)) * (sorted[above] - sorted[below]);
}

Quartiles quartiles(std::vector<double> values)
{
  Quartiles result;
  if (values.empty())
  {
    return result;
  }
  std::sort(values.begin(), values.end());
  result.count = values.size();
  result.minimum = values.front();
  result.lower = quantile(values, 0.25);
  result.median = quantile(values, 0.5);
  result.upper = quantile(values, 0.75);
  result.maximum = values.back();
  return result;
}

Quartiles pairedRatios(const std::vector<double>& a, const std::vector<double>& b)
{
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    if (b[i] > 0.0)
    {
      ratios.push_back(a[i] / b[i]);
    }
  }
  return quartiles(std::move(ratios));
}

} // namespace pointhaptics::bench
