#include "Core/Bandwidth/Bandwidth.h"

#include "Core/Bandwidth/SheatherJones.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// IQR / sd of the normal distribution, as rounded by Silverman 1986 and by Sheather and Jones 1991.
constexpr double kSilvermanQuartiles = 1.34;
constexpr double kSheatherJonesQuartiles = 1.349;

double quantile(const std::vector<double>& sorted, std::int64_t count, double p)
{
  const double position = p * double(count - 1);
  const std::size_t low = std::size_t(position);
  const std::size_t high = std::min(low + 1, std::size_t(count - 1));
  return sorted[low] + (position - double(low)) * (sorted[high] - sorted[low]);
}

double powerOfTwoNear(double range)
{
  int exponent = 0;
  if (range > 0.0 && std::isfinite(range))
  {
    std::frexp(range, &exponent);
  }
  // The square of the smallest range over its unit must not underflow, nor the unit itself.
  return std::ldexp(1.0, std::min(std::max(exponent, -1000), 1000));
}

/// b / s.
double ruleFactor(BandwidthRule rule, double n, double d)
{
  switch (rule)
  {
    case BandwidthRule::NormalReference:
      return 1.06 * std::pow(n, -0.2);
    case BandwidthRule::SilvermanRobust:
      return 0.9 * std::pow(n, -0.2);
    case BandwidthRule::ScottMultivariate:
      return std::pow(n, -1.0 / (d + 4.0));
    case BandwidthRule::SilvermanMultivariate:
      return std::pow(n * (d + 2.0) / 4.0, -1.0 / (d + 4.0));
    case BandwidthRule::SheatherJones:
      break;
  }
  return 0.0;
}

}

double SampleSpread::robustDeviation(double quartilesOfNormal) const noexcept
{
  return interquartileRange > 0.0 ? std::min(standardDeviation, interquartileRange / quartilesOfNormal)
                                  : standardDeviation;
}

SampleSpread sampleSpread(std::vector<double>& values)
{
  const auto finite = std::partition(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  std::sort(values.begin(), finite);
  SampleSpread result;
  result.count = finite - values.begin();
  if (result.count < 1)
  {
    return result;
  }
  // About the smallest value and in units of the range, by a power of two: nothing overflows, and nothing is
  // lost to a large offset.
  const double front = values.front();
  const double unit = powerOfTwoNear(values[std::size_t(result.count - 1)] - front);
  const double n = double(result.count);
  double sum = 0.0;
  std::for_each(values.begin(), finite, [&](double v) { sum += (v - front) / unit; });
  const double center = sum / n;
  double squares = 0.0;
  double rest = 0.0;
  for (auto v = values.begin(); v != finite; ++v)
  {
    const double deviation = (*v - front) / unit - center;
    squares += deviation * deviation;
    rest += deviation;
  }
  const double scatter = std::max(0.0, squares - rest * rest / n);
  result.standardDeviation = result.count > 1 ? std::sqrt(scatter / (n - 1.0)) * unit : 0.0;
  result.interquartileRange = quantile(values, result.count, 0.75) - quantile(values, result.count, 0.25);
  return result;
}

Status bandwidth(BandwidthRule rule, double s, double n, int dimensions, double& result) noexcept
{
  if (dimensions < 1 || dimensions > 3 || rule == BandwidthRule::SheatherJones)
  {
    return Status::InvalidParameter;
  }
  if (!(n >= 2.0) || !std::isfinite(n) || !(s > 0.0) || !std::isfinite(s))
  {
    return Status::DegenerateSample;
  }
  const double b = ruleFactor(rule, n, double(dimensions)) * s;
  if (!(b > 0.0))
  {
    return Status::DegenerateSample;
  }
  result = b;
  return Status::Ok;
}

Status sampleBandwidth(
  BandwidthRule rule, const double* sample, std::int64_t count, std::vector<double>& scratch, double& result)
{
  scratch.assign(sample, sample + std::max<std::int64_t>(count, 0));
  const SampleSpread spread = sampleSpread(scratch);
  if (spread.count != std::int64_t(scratch.size()))
  {
    return Status::InvalidParameter;
  }
  const bool solves = rule == BandwidthRule::SheatherJones;
  const bool robust = solves || rule == BandwidthRule::SilvermanRobust;
  const double s = robust ? spread.robustDeviation(kSilvermanQuartiles) : spread.standardDeviation;
  const Status status =
    bandwidth(solves ? BandwidthRule::SilvermanRobust : rule, s, double(spread.count), 1, result);
  return status == Status::Ok && solves
    ? sheatherJones(scratch.data(), spread.count, spread.robustDeviation(kSheatherJonesQuartiles), result)
    : status;
}

} // namespace pointhaptics
