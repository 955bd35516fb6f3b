#include "Core/Bandwidth.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
/// Radius of a cloud without any extent, in its own unit.
constexpr double kRadiusWithoutExtent = 1e-3;

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

double usableFallback(double fallback)
{
  return fallback > 0.0 && std::isfinite(fallback) ? fallback : kBandwidthWithoutSpread;
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

/// What the neighbourhood of one point says; bandwidth is 0 where it has no spread.
struct Neighborhood
{
  double bandwidth = 0.0;
  double spacing = 0.0;
};

/// One worker's memory, reused from point to point.
class NeighborhoodReader
{
public:
  NeighborhoodReader(
    const PointView& points, const NeighborQuery& query, const LocalBandwidthSettings& settings)
    : points_(points)
    , query_(query)
    , settings_(settings)
  {
  }

  Neighborhood read(const Vec3& center)
  {
    find(center);
    Neighborhood result;
    if (found_.size() < 2)
    {
      return result;
    }
    const double count = double(found_.size());
    const double reach = std::sqrt(found_.back().squaredDistance);
    result.spacing = reach * std::sqrt(kPi / (count - 1.0));
    double b = 0.0;
    if (ruleOfNeighborhood(center, count, b) == Status::Ok)
    {
      result.bandwidth = b;
    }
    return result;
  }

private:
  void find(const Vec3& center)
  {
    if (!settings_.fixedRadius)
    {
      const std::int64_t wanted = std::min<std::int64_t>(settings_.numberOfNeighbors, query_.size() - 1) + 1;
      found_.resize(std::size_t(wanted));
      found_.resize(std::size_t(query_.nearest(center, int(wanted), found_.data())));
      return;
    }
    found_.clear();
    query_.visitBall(center, settings_.radius,
      [this](const Vec3&, double d2, std::int64_t index) {
        found_.push_back({ d2, index });
      });
    std::sort(found_.begin(), found_.end());
  }

  /// sqrt(trace(C) / 2) about the neighbourhood's own mean.
  double surfaceSpread(const Vec3& center) const
  {
    Vec3 sum;
    double squares = 0.0;
    for (const Neighbor& neighbor : found_)
    {
      const Vec3 offset = points_[neighbor.index] - center;
      sum += offset;
      squares += norm2(offset);
    }
    const double n = double(found_.size());
    const double scatter = std::max(0.0, squares - norm2(sum) / n);
    return std::sqrt(scatter / (n - 1.0) / 2.0);
  }

  Status ruleOfNeighborhood(const Vec3& center, double count, double& b)
  {
    const bool univariate =
      settings_.rule == BandwidthRule::SilvermanRobust || settings_.rule == BandwidthRule::SheatherJones;
    if (!univariate)
    {
      return bandwidth(settings_.rule, surfaceSpread(center), count, 2, b);
    }
    distances_.clear();
    for (const Neighbor& neighbor : found_)
    {
      distances_.push_back(std::sqrt(neighbor.squaredDistance));
    }
    return sampleBandwidth(settings_.rule, distances_.data(), std::int64_t(distances_.size()), scratch_, b);
  }

  const PointView& points_;
  const NeighborQuery& query_;
  const LocalBandwidthSettings& settings_;
  std::vector<Neighbor> found_;
  std::vector<double> distances_;
  BandwidthScratch scratch_;
};

double clampedRadius(double radius, double spacing, const LocalBandwidthSettings& settings)
{
  const double low = settings.minimumRadius > 0.0 ? settings.minimumRadius : kNoSinkSpacings * spacing;
  const double raised = std::max(radius, low);
  return settings.maximumRadius > 0.0 ? std::min(raised, settings.maximumRadius) : raised;
}

/// The radius of a point whose neighbours all coincide with it.
double fallbackRadius(
  const PointView& points, const std::vector<double>& radii, const LocalBandwidthSettings& settings)
{
  double radius = settings.minimumRadius;
  if (!(radius > 0.0))
  {
    double smallest = INFINITY;
    Bounds box;
    for (std::int64_t i = 0; i < points.size(); ++i)
    {
      const double r = radii[std::size_t(i)];
      smallest = r > 0.0 ? std::min(smallest, r) : smallest;
      if (isFinite(points[i]))
      {
        box.include(points[i]);
      }
    }
    const double extent = box.empty() ? 0.0 : norm(box.extent());
    radius = std::isfinite(smallest) ? smallest : extent > 0.0 ? 1e-3 * extent : kRadiusWithoutExtent;
  }
  return settings.maximumRadius > 0.0 ? std::min(radius, settings.maximumRadius) : radius;
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
  result.mean = front + center * unit;
  result.standardDeviation = result.count > 1 ? std::sqrt(scatter / (n - 1.0)) * unit : 0.0;
  result.interquartileRange = quantile(values, result.count, 0.75) - quantile(values, result.count, 0.25);
  return result;
}

Status bandwidth(
  BandwidthRule rule, double s, double n, int dimensions, double& result, double fallback) noexcept
{
  result = usableFallback(fallback);
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

Status univariateBandwidth(
  BandwidthRule rule, const SampleSpread& spread, double& result, double fallback) noexcept
{
  const bool robust = rule == BandwidthRule::SilvermanRobust;
  const double s = robust ? spread.robustDeviation(kSilvermanQuartiles) : spread.standardDeviation;
  return bandwidth(rule, s, double(spread.count), 1, result, fallback);
}

Status sampleBandwidth(BandwidthRule rule, const double* sample, std::int64_t count,
  BandwidthScratch& scratch, double& result, double fallback)
{
  scratch.values.assign(sample, sample + std::max<std::int64_t>(count, 0));
  const SampleSpread spread = sampleSpread(scratch.values);
  if (spread.count != std::int64_t(scratch.values.size()))
  {
    result = usableFallback(fallback);
    return Status::InvalidParameter;
  }
  if (rule != BandwidthRule::SheatherJones)
  {
    return univariateBandwidth(rule, spread, result, fallback);
  }
  const Status status = univariateBandwidth(BandwidthRule::SilvermanRobust, spread, result, fallback);
  return status != Status::Ok ? status
                              : scratch.sheatherJones.solveTheEquation(scratch.values.data(), spread.count,
                                  spread.robustDeviation(kSheatherJonesQuartiles), result);
}

Status LocalBandwidthSettings::check() const noexcept
{
  if (fixedRadius ? !(radius > 0.0) || !std::isfinite(radius) : numberOfNeighbors < 1)
  {
    return Status::InvalidNeighborhood;
  }
  if (!(minimumRadius >= 0.0) || !(maximumRadius >= 0.0) || !std::isfinite(minimumRadius + maximumRadius) ||
    (maximumRadius > 0.0 && minimumRadius > maximumRadius))
  {
    return Status::InvalidRadiusBounds;
  }
  return radiusScale > 0.0 && std::isfinite(radiusScale) ? Status::Ok : Status::InvalidParameter;
}

Status localBandwidths(const PointView& points, const NeighborQuery& query,
  const LocalBandwidthSettings& settings, std::vector<double>& bandwidths, std::vector<double>& radii,
  const Executor& executor)
{
  bandwidths.assign(std::size_t(points.size()), 0.0);
  radii.assign(std::size_t(points.size()), 0.0);
  const Status status = settings.check();
  if (status != Status::Ok)
  {
    return status;
  }
  forRange(executor, points.size(),
    [&](std::int64_t begin, std::int64_t end)
    {
      NeighborhoodReader reader(points, query, settings);
      for (std::int64_t i = begin; i < end; ++i)
      {
        const Vec3 center = points[i];
        if (!isFinite(center))
        {
          continue;
        }
        const Neighborhood near = reader.read(center);
        if (near.bandwidth > 0.0)
        {
          bandwidths[std::size_t(i)] = near.bandwidth;
          radii[std::size_t(i)] =
            clampedRadius(settings.radiusScale * near.bandwidth, near.spacing, settings);
        }
      }
    });
  const double fallback = fallbackRadius(points, radii, settings);
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    if (!(radii[std::size_t(i)] > 0.0) && isFinite(points[i]))
    {
      radii[std::size_t(i)] = fallback;
      bandwidths[std::size_t(i)] = fallback / settings.radiusScale;
    }
  }
  return Status::Ok;
}

} // namespace pointhaptics
