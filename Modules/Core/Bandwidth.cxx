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

double quantile(const std::vector<double>& sorted, double p)
{
  const double position = p * double(sorted.size() - 1);
  const std::size_t low = std::size_t(position);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (position - double(low)) * (sorted[high] - sorted[low]);
}

/// Neighbourhood of one point: its size with the point itself, spread along the surface, and local spacing.
struct Neighborhood
{
  double count = 0.0;
  double spread = 0.0;
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
    result.count = double(found_.size());
    if (found_.size() < 2)
    {
      return result;
    }
    const double reach = std::sqrt(found_.back().squaredDistance);
    result.spacing = reach * std::sqrt(kPi / (result.count - 1.0));
    result.spread =
      settings_.rule == BandwidthRule::SilvermanRobust ? distanceSpread() : surfaceSpread(center);
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

  double distanceSpread()
  {
    distances_.clear();
    for (const Neighbor& neighbor : found_)
    {
      distances_.push_back(std::sqrt(neighbor.squaredDistance));
    }
    const SampleSpread spread = sampleSpread(distances_);
    const double robust = spread.interquartileRange / 1.34;
    return robust > 0.0 ? std::min(spread.standardDeviation, robust) : spread.standardDeviation;
  }

  const PointView& points_;
  const NeighborQuery& query_;
  const LocalBandwidthSettings& settings_;
  std::vector<Neighbor> found_;
  std::vector<double> distances_;
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

SampleSpread sampleSpread(std::vector<double>& values)
{
  SampleSpread result;
  result.count = std::int64_t(values.size());
  if (values.empty())
  {
    return result;
  }
  std::sort(values.begin(), values.end());
  double sum = 0.0;
  for (const double v : values)
  {
    sum += v - values.front();
  }
  const double n = double(values.size());
  result.mean = values.front() + sum / n;
  double squares = 0.0;
  for (const double v : values)
  {
    squares += (v - result.mean) * (v - result.mean);
  }
  result.standardDeviation = values.size() > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0;
  result.interquartileRange = quantile(values, 0.75) - quantile(values, 0.25);
  return result;
}

Status bandwidth(BandwidthRule rule, double s, double n, int dimensions, double& result) noexcept
{
  result = 0.0;
  if (!(n >= 2.0) || !(s > 0.0) || !std::isfinite(s))
  {
    return Status::DegenerateSample;
  }
  const double d = double(dimensions);
  switch (rule)
  {
    case BandwidthRule::NormalReference:
      result = 1.06 * s * std::pow(n, -0.2);
      break;
    case BandwidthRule::SilvermanRobust:
      result = 0.9 * s * std::pow(n, -0.2);
      break;
    case BandwidthRule::ScottMultivariate:
      result = s * std::pow(n, -1.0 / (d + 4.0));
      break;
    case BandwidthRule::SilvermanMultivariate:
      result = s * std::pow(n * (d + 2.0) / 4.0, -1.0 / (d + 4.0));
      break;
  }
  return Status::Ok;
}

Status univariateBandwidth(BandwidthRule rule, const SampleSpread& spread, double& result) noexcept
{
  double s = spread.standardDeviation;
  if (rule == BandwidthRule::SilvermanRobust && spread.interquartileRange > 0.0)
  {
    s = std::min(s, spread.interquartileRange / 1.34);
  }
  return bandwidth(rule, s, double(spread.count), 1, result);
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
        double b = 0.0;
        if (bandwidth(settings.rule, near.spread, near.count, 2, b) == Status::Ok)
        {
          bandwidths[std::size_t(i)] = b;
          radii[std::size_t(i)] = clampedRadius(settings.radiusScale * b, near.spacing, settings);
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
