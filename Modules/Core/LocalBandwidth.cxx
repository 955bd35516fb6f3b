#include "Core/LocalBandwidth.h"

#include "Core/NeighborSweep.h"

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
  NeighborhoodReader(const NeighborQuery& query, const LocalBandwidthSettings& settings)
    : query_(query)
    , settings_(settings)
    , ofDistances_(
        settings.rule == BandwidthRule::SilvermanRobust || settings.rule == BandwidthRule::SheatherJones)
  {
  }

  Neighborhood read(const NeighborList& list)
  {
    // Points at one place stand side by side and have one neighbourhood.
    const Vec3 place = query_.point(list.slot);
    if (!hasLast_ || !(place == lastPlace_))
    {
      last_ = readAnew(list);
      lastPlace_ = place;
      hasLast_ = true;
    }
    return last_;
  }

private:
  /// Sums go from the nearest to the farthest: they do not depend on how the neighbours were found.
  Neighborhood readAnew(const NeighborList& list)
  {
    Neighborhood result;
    if (list.count < 2)
    {
      return result;
    }
    const double count = double(list.count);
    result.spacing = std::sqrt(list.squaredDistances[list.count - 1]) * std::sqrt(kPi / (count - 1.0));
    double b = 0.0;
    const Status status = ofDistances_ ? bandwidthOfDistances(list, b) : bandwidthOfSpread(list, b);
    if (status == Status::Ok || status == Status::EquationUnsolved) // then b is that of SilvermanRobust
    {
      result.bandwidth = b;
    }
    return result;
  }

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

  Status bandwidthOfSpread(const NeighborList& list, double& b)
  {
    if (list.count != countOfFactor_)
    {
      countOfFactor_ = list.count;
      statusOfFactor_ = bandwidth(settings_.rule, 1.0, double(list.count), 2, factor_);
    }
    const double s = surfaceSpread(list);
    b = factor_ * s;
    return b > 0.0 && std::isfinite(b) ? statusOfFactor_ : Status::DegenerateSample;
  }

  Status bandwidthOfDistances(const NeighborList& list, double& b)
  {
    distances_.resize(std::size_t(list.count));
    std::transform(list.squaredDistances, list.squaredDistances + list.count, distances_.begin(),
      [](double d2) { return std::sqrt(d2); });
    return sampleBandwidth(settings_.rule, distances_.data(), std::int64_t(distances_.size()), scratch_, b);
  }

  const NeighborQuery& query_;
  const LocalBandwidthSettings& settings_;
  const bool ofDistances_;
  // The rule for a spread of 1 and the count it was asked for last.
  double factor_ = 0.0;
  int countOfFactor_ = 0;
  Status statusOfFactor_ = Status::DegenerateSample;
  std::vector<double> distances_;
  BandwidthScratch scratch_;
  bool hasLast_ = false;
  Vec3 lastPlace_;
  Neighborhood last_;
};

/// The neighbours in a ball about each point, as NeighborSweep gives the nearest.
class BallSweep
{
public:
  BallSweep(const NeighborQuery& query, double radius)
    : query_(query)
    , radius_(radius)
  {
  }

  template <typename Visitor>
  void run(std::int64_t begin, std::int64_t end, Visitor&& visit)
  {
    const std::int64_t last = std::min(end * kernel::kLeafPoints, query_.size());
    for (std::int64_t slot = begin * kernel::kLeafPoints; slot < last; ++slot)
    {
      visit(alone(slot));
    }
  }
  /// Valid until the next call.
  NeighborList alone(std::int64_t slot)
  {
    if (!found_.empty() && query_.point(slot) == lastPlace_)
    {
      return { slot, int(found_.size()), squaredDistances_.data(), slots_.data() };
    }
    lastPlace_ = query_.point(slot);
    found_.clear();
    query_.visitBallSlots(lastPlace_, radius_,
      [this](double d2, std::int64_t other) {
        found_.push_back({ d2, query_.packed(other) });
      });
    std::sort(found_.begin(), found_.end());
    squaredDistances_.clear();
    slots_.clear();
    for (const Neighbor& neighbor : found_)
    {
      squaredDistances_.push_back(neighbor.squaredDistance);
      slots_.push_back(std::uint32_t(NeighborQuery::slotOf(neighbor)));
    }
    return { slot, int(found_.size()), squaredDistances_.data(), slots_.data() };
  }

private:
  const NeighborQuery& query_;
  const double radius_;
  Vec3 lastPlace_; ///< Whose neighbours are those found.
  std::vector<Neighbor> found_;
  std::vector<double> squaredDistances_;
  std::vector<std::uint32_t> slots_;
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
    const double part = box.empty() ? 0.0 : partOfDiagonal(box, 1e-3);
    radius = std::isfinite(smallest) ? smallest : part > 0.0 ? part : kRadiusWithoutExtent;
  }
  return settings.maximumRadius > 0.0 ? std::min(radius, settings.maximumRadius) : radius;
}

void fillWithout(const PointView& points, const LocalBandwidthSettings& settings,
  std::vector<double>& bandwidths, std::vector<double>& radii)
{
  const double fallback = fallbackRadius(points, radii, settings);
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    if (!(radii[std::size_t(i)] > 0.0) && isFinite(points[i]))
    {
      radii[std::size_t(i)] = fallback;
      bandwidths[std::size_t(i)] = fallback / settings.radiusScale;
    }
  }
}

/// @return whether every point has got a radius.
template <typename MakeSweep>
bool readAll(const NeighborQuery& query, const LocalBandwidthSettings& settings, MakeSweep&& makeSweep,
  std::vector<double>& bandwidths, std::vector<double>& radii, const Executor& executor)
{
  std::atomic<bool> complete{ true };
  forRange(executor, NeighborSweep::leaves(query), NeighborSweep::kSmallestRange,
    [&](std::int64_t begin, std::int64_t end)
    {
      NeighborhoodReader reader(query, settings);
      makeSweep().run(begin, end,
        [&](const NeighborList& list)
        {
          const Neighborhood near = reader.read(list);
          const double radius = radiusOf(near, settings);
          if (!(near.bandwidth > 0.0) || !std::isfinite(radius))
          {
            complete.store(false, std::memory_order_relaxed);
            return;
          }
          const std::size_t index = std::size_t(query.index(list.slot));
          bandwidths[index] = near.bandwidth;
          radii[index] = radius;
        });
    });
  return complete;
}

/// Calls withSweep(makeSweep) for the neighbourhoods that @p settings ask for.
template <typename Function>
bool withNeighborhoods(
  const NeighborQuery& query, const LocalBandwidthSettings& settings, Function&& withSweep)
{
  if (settings.fixedRadius)
  {
    return withSweep([&] { return BallSweep(query, settings.radius); });
  }
  const int wanted = int(std::min<std::int64_t>(settings.numberOfNeighbors, query.size())) + 1;
  return withSweep([&] { return NeighborSweep(query, wanted); });
}

/// @return whether each of @p slots has got a radius.
template <typename MakeSweep>
bool readSome(const NeighborQuery& query, const LocalBandwidthSettings& settings, MakeSweep&& makeSweep,
  const std::vector<std::int64_t>& slots, std::vector<double>& radii, const Executor& executor)
{
  constexpr std::int64_t kSmallestRange = 64;
  std::atomic<bool> complete{ true };
  forRange(executor, std::int64_t(slots.size()), kSmallestRange,
    [&](std::int64_t begin, std::int64_t end)
    {
      NeighborhoodReader reader(query, settings);
      auto&& sweep = makeSweep();
      for (std::int64_t i = begin; i < end; ++i)
      {
        const Neighborhood near = reader.read(sweep.alone(slots[std::size_t(i)]));
        radii[std::size_t(i)] = radiusOf(near, settings);
        if (!(near.bandwidth > 0.0) || !std::isfinite(radii[std::size_t(i)]))
        {
          complete.store(false, std::memory_order_relaxed);
        }
      }
    });
  return complete;
}

Status checked(const PointView& points, const LocalBandwidthSettings& settings)
{
  const Status status = settings.check();
  return status == Status::Ok && points.size() > NeighborQuery::kMostPoints ? Status::InvalidParameter
                                                                            : status;
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

Status localBandwidths(const PointView& points, const NeighborQuery& query,
  const LocalBandwidthSettings& settings, std::vector<double>& bandwidths, std::vector<double>& radii,
  const Executor& executor)
{
  bandwidths.assign(std::size_t(points.size()), 0.0);
  radii.assign(std::size_t(points.size()), 0.0);
  const Status status = checked(points, settings);
  if (status != Status::Ok)
  {
    return status;
  }
  const bool complete = withNeighborhoods(query, settings,
    [&](auto&& makeSweep) { return readAll(query, settings, makeSweep, bandwidths, radii, executor); });
  if (!complete)
  {
    fillWithout(points, settings, bandwidths, radii);
  }
  if (settings.smoothRadius)
  {
    limitSlope(query, kRadiusSlope, radii, executor);
  }
  return Status::Ok;
}

Status localRadiiAt(const PointView& points, const NeighborQuery& query,
  const LocalBandwidthSettings& settings, const std::vector<std::int64_t>& slots, std::vector<double>& radii,
  const Executor& executor)
{
  radii.assign(slots.size(), 0.0);
  const Status status = checked(points, settings);
  if (status != Status::Ok)
  {
    return status;
  }
  const bool complete = !settings.smoothRadius &&
    withNeighborhoods(query, settings,
      [&](auto&& makeSweep) { return readSome(query, settings, makeSweep, slots, radii, executor); });
  if (!complete)
  {
    std::vector<double> bandwidths;
    std::vector<double> all;
    const Status whole = localBandwidths(points, query, settings, bandwidths, all, executor);
    std::transform(slots.begin(), slots.end(), radii.begin(),
      [&](std::int64_t slot) { return all[std::size_t(query.index(slot))]; });
    return whole;
  }
  return Status::Ok;
}

} // namespace pointhaptics
