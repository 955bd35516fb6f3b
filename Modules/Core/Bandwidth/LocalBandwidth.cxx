#include "Core/Bandwidth/LocalBandwidth.h"

#include "Core/Neighbors/NeighborCounts.h"
#include "Core/Neighbors/NeighborSweep.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace pointhaptics
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
/// Radius of a cloud without any extent, in its own unit.
constexpr double kRadiusWithoutExtent = 1e-3;
const std::vector<double> kNone;

/// The results of the neighbourhood of one point; bandwidth is 0 where it has no spread.
struct Neighborhood
{
  double bandwidth = 0.0;
  double spacing = 0.0;
};

/// Input of the radii.
struct Sample
{
  const NeighborQuery& query;
  const NeighborCounts counts;
  const LocalBandwidthSettings& settings;
};

/// One worker's memory, reused from point to point.
class NeighborhoodReader
{
public:
  explicit NeighborhoodReader(const Sample& sample)
    : query_(sample.query)
    , counts_(sample.counts)
    , settings_(sample.settings)
    , ofDistances_(
        settings_.rule == BandwidthRule::SilvermanRobust || settings_.rule == BandwidthRule::SheatherJones)
  {
  }

  /// Sums go from the nearest to the farthest: they do not depend on how the neighbours were found.
  Neighborhood read(const NeighborList& list)
  {
    Neighborhood result;
    if (list.count < 2)
    {
      return result;
    }
    const bool ofMeans = !counts_.empty();
    const double count = ofMeans && settings_.fixedRadius ? counts_.sum(list) : double(list.count);
    result.spacing = std::sqrt(list.squaredDistances[list.count - 1]) * std::sqrt(kPi / (count - 1.0));
    double b = 0.0;
    const Status status =
      ofDistances_ ? bandwidthOfDistances(list, count, b) : bandwidthOfSpread(list, count, b);
    if (status == Status::Ok || status == Status::EquationUnsolved) // then b is that of SilvermanRobust
    {
      const double finer = ofMeans && !settings_.fixedRadius ? std::sqrt(counts_.mean(list)) : 1.0;
      result.bandwidth = b / finer;
      result.spacing /= finer;
    }
    return result;
  }

private:
  /// sqrt(trace(C) / 2) about the neighbourhood's own mean.
  double surfaceSpread(const NeighborList& list) const
  {
    const Vec3 center = query_.point(list.slot);
    Vec3 sum;
    double squares = 0.0;
    for (int i = 0; i < list.count; ++i)
    {
      sum += query_.point(list.slots[i]) - center;
      squares += list.squaredDistances[i];
    }
    const double n = double(list.count);
    const double scatter = std::max(0.0, squares - norm2(sum) / n);
    return std::sqrt(scatter / (n - 1.0) / 2.0);
  }

  Status bandwidthOfSpread(const NeighborList& list, double count, double& b)
  {
    if (count != countOfFactor_)
    {
      countOfFactor_ = count;
      statusOfFactor_ = bandwidth(settings_.rule, 1.0, count, 2, factor_);
    }
    const double s = surfaceSpread(list);
    b = factor_ * s;
    return b > 0.0 && std::isfinite(b) ? statusOfFactor_ : Status::DegenerateSample;
  }

  /// Distances are univariate: bandwidths fall as n^(-1/5).
  Status bandwidthOfDistances(const NeighborList& list, double count, double& b)
  {
    distances_.resize(std::size_t(list.count));
    std::transform(list.squaredDistances, list.squaredDistances + list.count, distances_.begin(),
      [](double d2) { return std::sqrt(d2); });
    const Status status =
      sampleBandwidth(settings_.rule, distances_.data(), std::int64_t(distances_.size()), scratch_, b);
    b *= count == double(list.count) ? 1.0 : std::pow(count / double(list.count), -0.2);
    return status;
  }

  const NeighborQuery& query_;
  const NeighborCounts& counts_;
  const LocalBandwidthSettings& settings_;
  const bool ofDistances_;
  // Cache: the rule for a spread of 1, and the count it was computed for.
  double factor_ = 0.0;
  double countOfFactor_ = 0.0;
  Status statusOfFactor_ = Status::DegenerateSample;
  std::vector<double> distances_;
  std::vector<double> scratch_;
};

double radiusOf(const Neighborhood& near, const LocalBandwidthSettings& settings)
{
  const double low = settings.minimumRadius > 0.0 ? settings.minimumRadius : kNoSinkSpacings * near.spacing;
  const double raised = std::max(settings.radiusScale * near.bandwidth, low);
  return settings.maximumRadius > 0.0 ? std::min(raised, settings.maximumRadius) : raised;
}

/// @p part of the length of a box's diagonal, whose square, or which itself, may be out of range.
double partOfDiagonal(const Bounds& box, double part)
{
  const Vec3 half = 0.5 * box.maximum - 0.5 * box.minimum;
  const double largest = std::max({ half.x, half.y, half.z });
  if (!(largest > 0.0))
  {
    return 0.0;
  }
  const Vec3 shape(half.x / largest, half.y / largest, half.z / largest);
  return std::max(2.0 * part * norm(shape) * largest, std::numeric_limits<double>::denorm_min());
}

/// The radius of a point whose neighbours all coincide with it, or are so near or so far that their squared
/// distances are out of range.
double fallbackRadius(double smallest, const Bounds& box, const LocalBandwidthSettings& settings)
{
  double radius = settings.minimumRadius;
  if (!(radius > 0.0))
  {
    const double part = box.empty() ? 0.0 : partOfDiagonal(box, 1e-3);
    radius = std::isfinite(smallest) ? smallest : part > 0.0 ? part : kRadiusWithoutExtent;
  }
  return settings.maximumRadius > 0.0 ? std::min(radius, settings.maximumRadius) : radius;
}

NeighborSweep sweepOf(const Sample& sample)
{
  const LocalBandwidthSettings& settings = sample.settings;
  const int nearest = int(std::min<std::int64_t>(settings.numberOfNeighbors, sample.query.size())) + 1;
  return settings.fixedRadius ? NeighborSweep::ofBalls(sample.query, settings.radius)
                              : NeighborSweep(sample.query, nearest);
}

void readAll(const Sample& sample, PartialBandwidths& result, const Executor& executor)
{
  const LocalBandwidthSettings& settings = sample.settings;
  std::atomic<bool> isComplete{ true };
  forRange(executor, NeighborSweep::leaves(sample.query), NeighborSweep::kSmallestRange,
    [&](std::int64_t begin, std::int64_t end)
    {
      NeighborhoodReader reader(sample);
      sweepOf(sample).run(begin, end,
        [&](const NeighborList& list)
        {
          const Neighborhood near = reader.read(list);
          const double radius = radiusOf(near, settings);
          const std::size_t index = std::size_t(sample.query.index(list.slot));
          result.reaches[index] =
            settings.fixedRadius ? settings.radius : std::sqrt(list.squaredDistances[list.count - 1]);
          if (!(near.bandwidth > 0.0) || !std::isfinite(radius))
          {
            isComplete.store(false, std::memory_order_relaxed);
            return;
          }
          result.bandwidths[index] = near.bandwidth;
          result.radii[index] = radius;
        });
    });
  result.isComplete = isComplete;
}

/// @return whether each of @p slots has got a radius.
bool readSome(const Sample& sample, const std::vector<std::int64_t>& slots, std::vector<double>& radii,
  const Executor& executor)
{
  constexpr std::int64_t kSmallestRange = 64;
  std::atomic<bool> isComplete{ true };
  forRange(executor, std::int64_t(slots.size()), kSmallestRange,
    [&](std::int64_t begin, std::int64_t end)
    {
      NeighborhoodReader reader(sample);
      NeighborSweep sweep = sweepOf(sample);
      for (std::int64_t i = begin; i < end; ++i)
      {
        const Neighborhood near = reader.read(sweep.alone(slots[std::size_t(i)]));
        radii[std::size_t(i)] = radiusOf(near, sample.settings);
        if (!(near.bandwidth > 0.0) || !std::isfinite(radii[std::size_t(i)]))
        {
          isComplete.store(false, std::memory_order_relaxed);
        }
      }
    });
  return isComplete;
}

Status checked(
  const PointView& points, const std::vector<double>& counts, const LocalBandwidthSettings& settings)
{
  const Status status = settings.check();
  const bool countsFit = counts.empty() || counts.size() == std::size_t(points.size());
  return status == Status::Ok && (points.size() > NeighborQuery::kMostPoints || !countsFit)
    ? Status::InvalidParameter
    : status;
}

Sample sampleOf(
  const NeighborQuery& query, const std::vector<double>& counts, const LocalBandwidthSettings& settings)
{
  return { query, NeighborCounts(query, settings.usePointCounts ? counts : kNone), settings };
}

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

Status localBandwidths(const PointView& points, const std::vector<double>& counts, const NeighborQuery& query,
  const LocalBandwidthSettings& settings, std::vector<double>& bandwidths, std::vector<double>& radii,
  const Executor& executor)
{
  PartialBandwidths all;
  const Status status = partialBandwidths(points, counts, query, settings, all, executor);
  if (status == Status::Ok && !all.isComplete)
  {
    double smallest = INFINITY;
    Bounds box;
    for (std::int64_t i = 0; i < points.size(); ++i)
    {
      const double r = all.radii[std::size_t(i)];
      smallest = r > 0.0 ? std::min(smallest, r) : smallest;
      if (isFinite(points[i]))
      {
        box.include(points[i]);
      }
    }
    completeBandwidths(points, settings, smallest, box, all);
  }
  bandwidths = std::move(all.bandwidths);
  radii = std::move(all.radii);
  return status;
}

Status partialBandwidths(const PointView& points, const std::vector<double>& counts,
  const NeighborQuery& query, const LocalBandwidthSettings& settings, PartialBandwidths& result,
  const Executor& executor)
{
  for (std::vector<double>* values : { &result.bandwidths, &result.radii, &result.reaches })
  {
    values->assign(std::size_t(points.size()), 0.0);
  }
  const Status status = checked(points, counts, settings);
  if (status == Status::Ok)
  {
    readAll(sampleOf(query, counts, settings), result, executor);
    query.copyToRepeats(result.bandwidths);
    query.copyToRepeats(result.radii);
    query.copyToRepeats(result.reaches);
  }
  return status;
}

void completeBandwidths(const PointView& points, const LocalBandwidthSettings& settings,
  double smallestRadius, const Bounds& box, PartialBandwidths& part)
{
  const double fallback = fallbackRadius(smallestRadius, box, settings);
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    if (!(part.radii[std::size_t(i)] > 0.0) && isFinite(points[i]))
    {
      part.radii[std::size_t(i)] = fallback;
      part.bandwidths[std::size_t(i)] = fallback / settings.radiusScale;
    }
  }
}

Status localRadiiAt(const PointView& points, const std::vector<double>& counts, const NeighborQuery& query,
  const LocalBandwidthSettings& settings, const std::vector<std::int64_t>& slots, std::vector<double>& radii,
  const Executor& executor)
{
  radii.assign(slots.size(), 0.0);
  Status status = checked(points, counts, settings);
  if (status == Status::Ok && !readSome(sampleOf(query, counts, settings), slots, radii, executor))
  {
    std::vector<double> bandwidths;
    std::vector<double> all;
    status = localBandwidths(points, counts, query, settings, bandwidths, all, executor);
    std::transform(slots.begin(), slots.end(), radii.begin(),
      [&](std::int64_t slot) { return all[std::size_t(query.index(slot))]; });
  }
  return status;
}

} // namespace pointhaptics
