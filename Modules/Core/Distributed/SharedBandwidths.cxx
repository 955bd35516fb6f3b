#include "Core/Distributed/SharedBandwidths.h"

#include "Core/Bandwidth/Density.h"
#include "Core/Bandwidth/LocalBandwidth.h"
#include "Core/Distributed/SharedVoxels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace pointhaptics
{
namespace
{

/// A point on its way between ranks.
struct SlabPoint
{
  Vec3 place;
  std::int64_t index = 0; ///< Among the points of all ranks.
  double count = 1.0;
};

/// Coordinates along the axis of the slabs.
struct SlabRange
{
  double low = INFINITY;
  double high = -INFINITY;

  void include(double from, double to)
  {
    low = from < low ? from : low;
    high = to > high ? to : high;
  }
  bool contains(double c) const { return c >= low && c <= high; }
};

bool comesBefore(const SlabPoint& a, const SlabPoint& b)
{
  return a.index < b.index;
}

int longestAxis(const Bounds& box)
{
  // Halves: the extent may be more than the largest number.
  const Vec3 half = box.empty() ? Vec3() : 0.5 * box.maximum - 0.5 * box.minimum;
  return half.x >= half.y && half.x >= half.z ? 0 : half.y >= half.z ? 1 : 2;
}

/// Slabs of about as many points each across the longest axis of the cloud. Points that are not finite are in
/// none.
class SpaceSlabs
{
public:
  /// Collective. @p counts: one for each of @p points, or empty.
  SpaceSlabs(Ranks& ranks, const PointView& points, const std::vector<double>& counts)
    : ranks_(ranks)
  {
    for (std::int64_t i = 0; i < points.size(); ++i)
    {
      if (isFinite(points[i]))
      {
        own_.push_back({ points[i], i, counts.empty() ? 1.0 : counts[std::size_t(i)] });
        box_.include(points[i]);
      }
    }
    box_ = commonBounds(ranks, box_);
    pointsOfAll_ = ranks.sum(std::int64_t(own_.size()));
    firsts_.push_back(0);
    for (const std::int64_t size : ranks.gatherValues(points.size()))
    {
      firsts_.push_back(firsts_.back() + size);
    }
    axis_ = longestAxis(box_);
    std::vector<double> places;
    for (SlabPoint& point : own_)
    {
      point.index += firsts_[std::size_t(ranks.rank())];
      places.push_back(this->coordinate(point));
    }
    const std::vector<double> cuts = cutsOf(ranks, places, 1024);
    std::vector<std::vector<SlabPoint>> ofRanks(std::size_t(ranks.size()));
    for (const SlabPoint& point : own_)
    {
      const auto slab = std::upper_bound(cuts.begin(), cuts.end(), this->coordinate(point)) - cuts.begin();
      ofRanks[std::size_t(slab)].push_back(point);
    }
    // By index: each rank has its points in order, and those of the next rank come after them.
    own_ = ranks.exchangeValues(ofRanks);
  }

  /// Points of this rank's slab, by index.
  const std::vector<SlabPoint>& own() const { return own_; }
  double coordinate(const SlabPoint& point) const { return point.place[axis_]; }
  /// Finite points of all ranks, and the box about them.
  std::int64_t pointsOfAll() const { return pointsOfAll_; }
  const Bounds& box() const { return box_; }

  /// Collective: the own points and those of other slabs in @p range, by index.
  std::vector<SlabPoint> withGhosts(const SlabRange& range)
  {
    const std::vector<SlabRange> ranges = ranks_.gatherValues(range);
    std::vector<std::vector<SlabPoint>> wanted(ranges.size());
    for (std::size_t r = 0; r < ranges.size(); ++r)
    {
      std::copy_if(own_.begin(), own_.end(), std::back_inserter(wanted[r]),
        [&](const SlabPoint& point)
        { return int(r) != ranks_.rank() && ranges[r].contains(this->coordinate(point)); });
    }
    std::vector<SlabPoint> ghosts = ranks_.exchangeValues(wanted);
    std::sort(ghosts.begin(), ghosts.end(), &comesBefore);
    std::vector<SlabPoint> all(ghosts.size() + own_.size());
    std::merge(ghosts.begin(), ghosts.end(), own_.begin(), own_.end(), all.begin(), &comesBefore);
    return all;
  }

  /// Collective: gives values of the own points back to the ranks whose points they are. @return one for each
  /// of these, 0 for points that are not finite.
  std::vector<double> giveBack(const std::vector<double>& values)
  {
    struct Placed
    {
      std::int64_t place;
      double value;
    };
    std::vector<std::vector<Placed>> ofRanks(std::size_t(ranks_.size()));
    for (std::size_t i = 0; i < own_.size(); ++i)
    {
      const auto owner = std::upper_bound(firsts_.begin(), firsts_.end(), own_[i].index) - 1;
      ofRanks[std::size_t(owner - firsts_.begin())].push_back({ own_[i].index - *owner, values[i] });
    }
    const auto rank = std::size_t(ranks_.rank());
    std::vector<double> result(std::size_t(firsts_[rank + 1] - firsts_[rank]), 0.0);
    for (const Placed& placed : ranks_.exchangeValues(ofRanks))
    {
      result[std::size_t(placed.place)] = placed.value;
    }
    return result;
  }

private:
  Ranks& ranks_;
  int axis_ = 0;
  std::int64_t pointsOfAll_ = 0;
  Bounds box_;
  std::vector<std::int64_t> firsts_; ///< Index of the first point of each rank, and the number of all.
  std::vector<SlabPoint> own_;
};

constexpr SlabRange kEverywhere{ -INFINITY, INFINITY };

SlabRange both(const SlabRange& a, const SlabRange& b)
{
  return { std::min(a.low, b.low), std::max(a.high, b.high) };
}

/// The steps on one rank. All are collective.
class SharedEstimate
{
public:
  SharedEstimate(Ranks& ranks, const PointView& points, const std::vector<double>& counts, bool hasCounts,
    const BandwidthSettings& settings, const Executor& executor)
    : ranks_(ranks)
    , settings_(settings)
    , executor_(executor)
    , hasCounts_(hasCounts)
    , slabs_(ranks, points, counts)
  {
  }

  /// Estimates bandwidths of the own points; as if each mean were one point where @p areMeans. A
  /// neighbourhood that reaches beyond the known points gives a range that is certain to hold the neighbours.
  std::vector<double> bandwidths(bool areMeans, std::vector<double>& radii);
  std::vector<double> densities(const std::vector<double>& widths);
  std::vector<double> giveBack(const std::vector<double>& values) { return slabs_.giveBack(values); }
  std::size_t size() { return slabs_.own().size(); }

private:
  PointView view() const { return { places_.data(), std::int64_t(places_.size()) }; }
  std::vector<double> ofOwn(const std::vector<double>& all) const;
  SlabRange reachOf(const std::vector<double>& distances);
  SlabRange guess();
  void take(std::vector<SlabPoint> points);
  bool ensure(const SlabRange& needed);
  double leastOfAll(double own)
  {
    return ranks_.reduce(own, [](double a, double b) { return std::min(a, b); });
  }

  Ranks& ranks_;
  const BandwidthSettings& settings_;
  const Executor& executor_;
  const bool hasCounts_;
  SpaceSlabs slabs_;
  // The own points and ghosts, all that lie in covered_.
  SlabRange covered_;
  bool isCovered_ = false;
  std::vector<Vec3> places_;
  std::vector<double> counts_;
  std::vector<std::size_t> own_; ///< Where the own points are among them.
  NeighborQuery query_;
};

std::vector<double> SharedEstimate::ofOwn(const std::vector<double>& all) const
{
  std::vector<double> values;
  values.reserve(own_.size());
  for (const std::size_t i : own_)
  {
    values.push_back(all[i]);
  }
  return values;
}

/// The range of balls about the own points, with some room for rounding.
SlabRange SharedEstimate::reachOf(const std::vector<double>& distances)
{
  constexpr double kRoom = 0x1p-40;
  SlabRange range;
  for (std::size_t i = 0; i < distances.size(); ++i)
  {
    const double c = slabs_.coordinate(slabs_.own()[i]);
    const double far = distances[i] + kRoom * (distances[i] + std::fabs(c));
    range.include(c - far, c + far);
  }
  return range;
}

/// How far the neighbourhoods reach as a rule, on a surface and in a volume: whether it does is looked at.
SlabRange SharedEstimate::guess()
{
  Bounds box;
  for (const SlabPoint& point : slabs_.own())
  {
    box.include(point.place);
  }
  if (box.empty())
  {
    return {};
  }
  double edges[3] = { box.extent().x, box.extent().y, box.extent().z };
  std::sort(edges, edges + 3);
  const double points = double(this->size());
  const double spacing =
    std::max(std::sqrt(edges[2] * edges[1] / points), std::cbrt(edges[2] * edges[1] * edges[0] / points));
  const double reach =
    settings_.fixedRadius ? settings_.radius : 2.0 * spacing * std::sqrt(double(settings_.numberOfNeighbors));
  return this->reachOf(std::vector<double>(this->size(), reach));
}

void SharedEstimate::take(std::vector<SlabPoint> points)
{
  places_.clear();
  counts_.clear();
  own_.clear();
  const std::vector<SlabPoint>& own = slabs_.own();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (own_.size() < own.size() && own[own_.size()].index == points[i].index)
    {
      own_.push_back(i);
    }
    places_.push_back(points[i].place);
    counts_.push_back(points[i].count);
  }
  counts_.resize(hasCounts_ ? counts_.size() : 0);
  query_.build(this->view(), executor_);
}

/// Gets what lies in @p needed, where it is not here yet. @return whether a rank got something.
bool SharedEstimate::ensure(const SlabRange& needed)
{
  const bool isHere =
    isCovered_ && (this->size() == 0 || (covered_.low <= needed.low && needed.high <= covered_.high));
  if (ranks_.all(isHere))
  {
    return false;
  }
  // Ranks that have all they need take part, and ask for nothing.
  const SlabRange range = isHere ? SlabRange() : both(needed, covered_);
  std::vector<SlabPoint> points = slabs_.withGhosts(range);
  if (!isHere)
  {
    this->take(std::move(points));
    covered_ = range;
    isCovered_ = true;
  }
  return true;
}

std::vector<double> SharedEstimate::bandwidths(bool areMeans, std::vector<double>& radii)
{
  PartialBandwidths part;
  const std::vector<double> none;
  const std::vector<double>& counts = areMeans ? none : counts_;
  const std::int64_t wanted =
    settings_.fixedRadius ? 0 : std::min(slabs_.pointsOfAll(), std::int64_t(settings_.numberOfNeighbors) + 1);
  this->ensure(both(this->guess(), covered_));
  for (bool isNew = true; isNew;)
  {
    static_cast<void>(partialBandwidths(this->view(), counts, query_, settings_, part, executor_));
    isNew = this->ensure(
      query_.size() < wanted ? kEverywhere : both(this->reachOf(this->ofOwn(part.reaches)), covered_));
  }
  double smallest = INFINITY;
  for (const double radius : this->ofOwn(part.radii))
  {
    smallest = radius > 0.0 ? std::min(smallest, radius) : smallest;
  }
  smallest = this->leastOfAll(smallest);
  completeBandwidths(this->view(), settings_, smallest, slabs_.box(), part);
  radii = this->ofOwn(part.radii);
  return this->ofOwn(part.bandwidths);
}

std::vector<double> SharedEstimate::densities(const std::vector<double>& widths)
{
  std::vector<double> distances;
  for (const double width : widths)
  {
    distances.push_back(densityReach(settings_.densityKernel) * width);
  }
  this->ensure(both(this->reachOf(distances), covered_));
  std::vector<double> all(places_.size(), 0.0);
  std::vector<Vec3> ownPlaces;
  for (std::size_t i = 0; i < own_.size(); ++i)
  {
    all[own_[i]] = widths[i];
    ownPlaces.push_back(places_[own_[i]]);
  }
  const double own = totalWeight({ ownPlaces.data(), std::int64_t(ownPlaces.size()) },
    hasCounts_ ? this->ofOwn(counts_) : std::vector<double>());
  const double total = ranks_.reduce(own, std::plus<>());
  std::vector<double> densities;
  surfaceDensities(this->view(), counts_, query_, all, densities, executor_, settings_.densityKernel, total);
  return this->ofOwn(densities);
}

Status checkAll(Ranks& ranks, const PointView& points, const std::vector<double>& counts, bool hasCounts,
  const BandwidthSettings& settings)
{
  const std::int64_t all = ranks.sum(points.size());
  const bool fits =
    all <= NeighborQuery::kMostPoints && (!hasCounts || counts.size() == std::size_t(points.size()));
  const Status own = settings.check() != Status::Ok ? settings.check()
    : fits                                          ? Status::Ok
                                                    : Status::InvalidParameter;
  return ranks.reduce(own, [](Status a, Status b) { return a != Status::Ok ? a : b; });
}

}

Status sharedBandwidths(Ranks& ranks, const PointView& points, const std::vector<double>& counts,
  const BandwidthSettings& settings, BandwidthsOfPoints& result, const Executor& executor)
{
  result = BandwidthsOfPoints();
  const bool hasCounts = !ranks.all(counts.empty());
  const Status status = checkAll(ranks, points, counts, hasCounts, settings);
  if (status != Status::Ok)
  {
    return status;
  }
  SharedEstimate estimate(ranks, points, counts, hasCounts, settings, executor);
  const bool wantsPoints = settings.computeBandwidth || settings.computeProxyRadius;
  const bool wantsMeans = settings.computeDensity || settings.computeMeanBandwidth;
  std::vector<std::vector<double>*> columns; // the same on all ranks
  if (wantsPoints || (wantsMeans && !hasCounts))
  {
    result.bandwidths = estimate.bandwidths(false, result.radii);
    columns.push_back(&result.bandwidths);
    columns.push_back(&result.radii);
  }
  if (wantsMeans)
  {
    std::vector<double> unused;
    result.ofMeans = hasCounts ? estimate.bandwidths(true, unused) : result.bandwidths;
    columns.push_back(&result.ofMeans);
  }
  if (settings.computeDensity)
  {
    result.densities = estimate.densities(result.ofMeans);
    columns.push_back(&result.densities);
  }
  for (std::vector<double>* const column : columns)
  {
    *column = estimate.giveBack(*column);
  }
  return Status::Ok;
}

} // namespace pointhaptics
