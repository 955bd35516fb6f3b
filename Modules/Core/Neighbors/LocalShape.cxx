#include "Core/Neighbors/LocalShape.h"

#include "Core/Base/Vector3.h"
#include "Core/Neighbors/NeighborSweep.h"
#include "Core/Neighbors/PrincipalPlane.h"
#include "Core/Neighbors/TangentCell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>

namespace pointhaptics
{
namespace
{

constexpr int kNear = 8; ///< Neighbours that flatness and normal are averaged over.
constexpr std::int64_t kSample = 512;
constexpr double kDiscRadius = 5.0; ///< Pixels.
constexpr double kCrowdedDisc = 24.0;
/// Neighbours that tell the spacing of the surroundings, and how much larger a point's own may be.
constexpr int kSurroundings[] = { 10, 12, 14, 16 };
constexpr double kLoneRatio = 2.5;
constexpr double kPi = 3.14159265358979323846;
/// Reach over the spacing that discs have anyway: what is farther away is looked for.
constexpr double kUsualReach = 1.1;
constexpr int kMostAcross = 12;
constexpr double kNearer = 1.0 - 1e-6;
constexpr double kFlatEnough = 0.5; ///< Neighbourhoods whose thickness is noise.

double ramp(double x, double from, double to)
{
  return std::clamp((x - from) / (to - from), 0.0, 1.0);
}

double spacingOf(const double* squared, int others)
{
  if (others < 1)
  {
    return 0.0;
  }
  // A disc that holds k other points of one a unit square has the radius sqrt(k / pi).
  const int first = std::min(4, others);
  const int second = std::min(8, others);
  return std::max(std::sqrt(squared[first] * kPi / first), std::sqrt(squared[second] * kPi / second));
}

/// A query of some of the points of another one; of all of them it is that one.
class ThinnedQuery
{
public:
  /// Points that are farther than @p apart from the ones chosen just before, which in the order of
  /// SpatialOrder.h are near ones mostly.
  ThinnedQuery(const NeighborQuery& all, double apart, const Executor& executor)
    : all_(all)
  {
    constexpr std::int64_t kLookedAt = simd::kLeafPoints;
    std::vector<Vec3> points;
    for (std::int64_t slot = 0; apart > 0.0 && slot < all.size(); ++slot)
    {
      const Vec3 here = all.point(slot);
      const auto end = std::int64_t(points.size());
      const std::int64_t first = std::max<std::int64_t>(0, end - kLookedAt);
      std::int64_t before = end - 1;
      while (before >= first && !(norm2(points[std::size_t(before)] - here) <= apart * apart))
      {
        --before;
      }
      if (before < first)
      {
        before = end;
        points.push_back(here);
      }
      slots_.push_back(std::uint32_t(before));
    }
    if (points.size() == slots_.size())
    {
      slots_.clear();
      return;
    }
    query_.build({ points.data(), std::int64_t(points.size()) }, executor);
    std::vector<std::uint32_t> slotOf(points.size());
    for (std::size_t slot = 0; slot < slotOf.size(); ++slot)
    {
      slotOf[std::size_t(query_.index(std::int64_t(slot)))] = std::uint32_t(slot);
    }
    std::transform(
      slots_.begin(), slots_.end(), slots_.begin(), [&slotOf](std::uint32_t point) { return slotOf[point]; });
  }
  bool holdsAll() const { return slots_.empty(); }
  const NeighborQuery& all() const { return all_; }
  const NeighborQuery& query() const { return this->holdsAll() ? all_ : query_; }
  /// In query(): of the point that stands for @p slot of all.
  std::int64_t slotFor(std::int64_t slot) const
  {
    return this->holdsAll() ? slot : std::int64_t(slots_[std::size_t(slot)]);
  }

private:
  const NeighborQuery& all_;
  NeighborQuery query_;
  std::vector<std::uint32_t> slots_;
};

/// The value in the middle; 0 where there are none.
double medianOf(std::vector<float>& values)
{
  if (values.empty())
  {
    return 0.0;
  }
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return double(*middle);
}

int chosenNeighbors(const NeighborQuery& query, const LocalShapeSettings& settings)
{
  // A few neighbours that are apart reach as far as many that are close.
  const bool isAsked = settings.pixel > 0.0 && !(settings.apart > 0.0);
  std::vector<float> spacings;
  const std::int64_t step = 1 + query.size() / kSample;
  for (std::int64_t slot = 0; isAsked && slot < query.size(); slot += step)
  {
    Neighbor neighbors[9];
    const int count = query.nearest(query.point(slot), 9, neighbors);
    double squared[9];
    std::transform(
      neighbors, neighbors + count, squared, [](const Neighbor& each) { return each.squaredDistance; });
    spacings.push_back(float(spacingOf(squared, count - 1)));
  }
  const double spacing = medianOf(spacings);
  const double held = spacing > 0.0 ? kPi * std::pow(kDiscRadius * settings.pixel / spacing, 2.0) : 0.0;
  return held > kCrowdedDisc ? int(std::min(held, double(LocalShapeSettings::kMost)))
                             : LocalShapeSettings::kFewest;
}

/// The passes over the places, by slot of their query.
class Measurement
{
public:
  Measurement(const ThinnedQuery& places, int neighbors)
    : places_(places)
    , query_(places.query())
    , neighbors_(neighbors)
    , size_(std::size_t(query_.size()))
    , near_(new Near[size_])
    , around_(new Around[size_])
    , thickness_(size_)
    , agreed_(size_)
    , raw_(size_)
    , smooth_(size_)
  {
  }

  /// In parts, between which @p goesOn hears how much is done, 0..1. False: it said no.
  template <typename GoesOn>
  bool fit(const Executor& executor, const GoesOn& goesOn)
  {
    return sweep(
      query_, neighbors_ + 1, executor, goesOn, [this](const NeighborList& list) { this->fitOne(list); },
      [](std::int64_t) { return true; });
  }
  /// Fits spacing and reach among all places, where not all were fitted.
  template <typename GoesOn>
  bool space(const Executor& executor, const GoesOn& goesOn)
  {
    return places_.holdsAll() ||
      sweep(
        places_.all(), LocalShapeSettings::kFewest + 1, executor, goesOn,
        [this](const NeighborList& list) { this->spaceOne(list); },
        [this](std::int64_t slot)
        { return query_.point(places_.slotFor(slot)) == places_.all().point(slot); });
  }
  void compareNormals(const Executor& executor)
  {
    forEachIndex(executor, query_.size(), [this](std::int64_t slot) { this->compareOne(std::size_t(slot)); });
  }
  void average(const Executor& executor)
  {
    forEachIndex(executor, query_.size(), [this](std::int64_t slot) { this->averageOne(std::size_t(slot)); });
  }

  const PointShape& result(std::int64_t slot) const { return smooth_[std::size_t(slot)]; }
  double noise() const
  {
    std::vector<float> ratios;
    for (std::size_t slot = 0; slot < size_; slot += 1 + size_ / 20000)
    {
      if (double(smooth_[slot].flatness) > kFlatEnough && smooth_[slot].spacing > 0.0F)
      {
        ratios.push_back(thickness_[slot] / smooth_[slot].spacing);
      }
    }
    return medianOf(ratios);
  }

private:
  using Near = std::array<std::uint32_t, kNear>;
  using Around = std::array<std::uint32_t, std::size(kSurroundings)>;

  template <typename GoesOn, typename Visit, typename Wants>
  static bool sweep(const NeighborQuery& query, int count, const Executor& executor, const GoesOn& goesOn,
    const Visit& visit, const Wants& wants)
  {
    constexpr std::int64_t kLeavesAtOnce = 1024;
    const std::int64_t leaves = NeighborSweep::leaves(query);
    for (std::int64_t first = 0; first < leaves; first += kLeavesAtOnce)
    {
      if (!goesOn(double(first) / double(leaves)))
      {
        return false;
      }
      forRange(executor, std::min(kLeavesAtOnce, leaves - first), NeighborSweep::kSmallestRange,
        [&query, &visit, &wants, count, first](std::int64_t begin, std::int64_t end)
        { NeighborSweep(query, count).run(first + begin, first + end, visit, wants); });
    }
    return true;
  }

  void fitOne(const NeighborList& list)
  {
    const auto slot = std::size_t(list.slot);
    const int others = list.count - 1;
    PointShape& shape = raw_[slot];
    shape.spacing = float(spacingOf(list.squaredDistances, others));
    Near& near = near_[slot];
    near.fill(std::uint32_t(slot));
    std::copy_n(list.slots + (others > 0 ? 1 : 0), std::min(kNear, others), near.begin());
    std::transform(std::begin(kSurroundings), std::end(kSurroundings), around_[slot].begin(),
      [&](int rank) { return list.slots[std::min(rank, others)]; });
    if (others < 3)
    {
      return;
    }
    const Vec3 here = query_.point(list.slot);
    Vec3 sum;
    SymMat3 moments;
    for (int i = 0; i < list.count; ++i)
    {
      const Vec3 d = query_.point(std::int64_t(list.slots[i])) - here;
      sum += d;
      moments += outerProduct(d);
    }
    SymMat3 mean = outerProduct(sum);
    mean *= -1.0 / list.count;
    moments += mean;
    const PrincipalPlane spread = principalPlane(moments);
    const double* l = spread.values;
    shape.normal[0] = float(spread.normal.x);
    shape.normal[1] = float(spread.normal.y);
    shape.normal[2] = float(spread.normal.z);
    shape.flatness =
      l[1] > 0.0 ? float((1.0 - ramp(l[0] / l[1], 0.08, 0.35)) * ramp(l[1] / l[2], 0.03, 0.12)) : 0.0F;
    thickness_[slot] = float(std::sqrt(l[0] / list.count));
    if (places_.holdsAll())
    {
      shape.reach = reachOf(list, query_, shape, spread.normal);
    }
  }

  /// @param list of slots of all places, of one that stands for itself.
  void spaceOne(const NeighborList& list)
  {
    const std::int64_t slot = places_.slotFor(list.slot);
    PointShape& shape = raw_[std::size_t(slot)];
    shape.spacing = float(spacingOf(list.squaredDistances, list.count - 1));
    shape.reach = reachOf(list, places_.all(), shape,
      { double(shape.normal[0]), double(shape.normal[1]), double(shape.normal[2]) });
  }

  static float reachOf(
    const NeighborList& list, const NeighborQuery& query, const PointShape& shape, const Vec3& normal)
  {
    if (!(shape.flatness > 0.0F))
    {
      return 0.0F;
    }
    const Vec3 here = query.point(list.slot);
    TangentCell cell(normal, PointShape::kLargestReach * double(shape.spacing));
    bool goesOn = true;
    for (int i = 1; goesOn && i < list.count; ++i)
    {
      goesOn = cell.add(query.point(std::int64_t(list.slots[i])) - here);
    }
    // Points on the other side of a gap are farther away than those of the list: no corner has one nearer to
    // it.
    const double listed = list.squaredDistances[list.count - 1];
    Vec3 corner;
    for (int i = 0;
         goesOn && i < kMostAcross && cell.farthestCorner(corner) > kUsualReach * double(shape.spacing); ++i)
    {
      if (4.0 * norm2(corner) <= listed) // all points so near to the corner are in the list
      {
        break;
      }
      Neighbor across;
      query.nearestSlots(here + corner, 1, &across);
      goesOn = across.squaredDistance < kNearer * norm2(corner) &&
        cell.add(query.point(NeighborQuery::slotOf(across)) - here);
    }
    return float(cell.reach());
  }

  float agreement(std::size_t a, std::size_t b) const
  {
    const float* p = raw_[a].normal;
    const float* q = raw_[b].normal;
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  }
  /// Part of its spacing that a point keeps, up to 1: a lone one, or one of a few, belongs to no surface.
  float keptPart(std::size_t slot) const
  {
    std::array<float, std::size(kSurroundings)> spacings;
    std::transform(around_[slot].begin(), around_[slot].end(), spacings.begin(),
      [this](std::uint32_t other) { return raw_[other].spacing; });
    std::sort(spacings.begin(), spacings.end());
    const float most = float(kLoneRatio) * spacings[spacings.size() / 2];
    const float part = raw_[slot].spacing > most ? most / raw_[slot].spacing : 1.0F;
    return part * part;
  }
  void compareOne(std::size_t slot)
  {
    float sum = 0.0F;
    for (const std::uint32_t other : near_[slot])
    {
      sum += std::abs(this->agreement(slot, other));
    }
    agreed_[slot] = raw_[slot].flatness * float(ramp(double(sum / kNear), 0.55, 0.85));
  }
  void averageOne(std::size_t slot)
  {
    float flatness = agreed_[slot];
    float n[3];
    std::transform(raw_[slot].normal, raw_[slot].normal + 3, n, [flatness](float c) { return flatness * c; });
    for (const std::uint32_t other : near_[slot])
    {
      const float weight = std::copysign(agreed_[other], this->agreement(slot, other));
      flatness += agreed_[other];
      for (int axis = 0; axis < 3; ++axis)
      {
        n[axis] += weight * raw_[other].normal[axis];
      }
    }
    const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const float kept = this->keptPart(slot);
    PointShape& shape = smooth_[slot];
    shape.spacing = kept * raw_[slot].spacing;
    shape.reach = kept * raw_[slot].reach;
    shape.flatness = kept * flatness / float(1 + kNear);
    for (int axis = 0; axis < 3 && length > 0.0F; ++axis)
    {
      shape.normal[axis] = n[axis] / length;
    }
  }

  const ThinnedQuery& places_;
  const NeighborQuery& query_;
  const int neighbors_;
  const std::size_t size_;
  // Filled in by fit() before anything reads them.
  std::unique_ptr<Near[]> near_;
  std::unique_ptr<Around[]> around_;
  std::vector<float> thickness_; ///< Root mean square distance from the plane.
  std::vector<float> agreed_;    ///< Flatness before it is averaged.
  std::vector<PointShape> raw_;
  std::vector<PointShape> smooth_;
};

/// From what was measured back to the points of the cloud, with the sums over them.
LocalShape collect(const PointView& cloud, const NeighborQuery& query, const ThinnedQuery& measured,
  const Measurement& measurement, const Executor& executor)
{
  LocalShape shape;
  shape.points.resize(std::size_t(cloud.size()));
  forEachIndex(executor, query.size(),
    [&](std::int64_t slot)
    { shape.points[std::size_t(query.index(slot))] = measurement.result(measured.slotFor(slot)); });
  double flatness = 0.0;
  std::vector<float> spacings;
  for (std::int64_t slot = 0; slot < query.size(); ++slot)
  {
    const PointShape& each = measurement.result(measured.slotFor(slot));
    flatness += double(each.flatness);
    if (slot % (1 + query.size() / 20000) == 0)
    {
      spacings.push_back(each.spacing);
    }
  }
  query.copyToRepeats(shape.points);
  shape.meanFlatness = flatness / double(query.size());
  shape.medianSpacing = medianOf(spacings);
  shape.noise = measurement.noise();
  return shape;
}

} // namespace

Status measureLocalShape(const PointView& cloud, const NeighborQuery& query,
  const LocalShapeSettings& settings, LocalShape& shape, const Executor& executor, ProgressObserver* observer)
{
  if (!(settings.apart >= 0.0) || !std::isfinite(settings.apart))
  {
    return Status::InvalidParameter;
  }
  if (query.size() == 0)
  {
    return Status::Empty;
  }
  const auto goesOn = [observer](double part) { return !observer || observer->report(part); };
  const ThinnedQuery measured(query, settings.apart, executor);
  const int neighbors = chosenNeighbors(measured.query(), settings);
  Measurement measurement(measured, neighbors);
  const double fitted = measured.holdsAll() ? 0.8 : 0.3;
  const auto fits = [&](double part) { return goesOn(0.1 + (fitted - 0.1) * part); };
  const auto spaces = [&](double part) { return goesOn(fitted + (0.8 - fitted) * part); };
  if (!measurement.fit(executor, fits) || !measurement.space(executor, spaces) || !goesOn(0.8))
  {
    return Status::Aborted;
  }
  measurement.compareNormals(executor);
  measurement.average(executor);
  shape = collect(cloud, query, measured, measurement, executor);
  shape.numberOfNeighbors = neighbors;
  return goesOn(1.0) ? Status::Ok : Status::Aborted;
}

} // namespace pointhaptics
