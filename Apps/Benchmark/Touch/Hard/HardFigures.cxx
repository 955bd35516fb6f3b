#include "Benchmark/Touch/Hard/HardFigures.h"

#include "Benchmark/Harness/Statistics.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics::bench::touch::hard
{
namespace
{

constexpr std::size_t kEndTicks = 50;
constexpr double kLeastLost = 0.2; ///< N of the truth, below which a missing force counts as late, not lost.
/// N; a force of the truth that was cut is not below it.
constexpr double kBelowLimit = kForceLimit - 1e-6;
constexpr int kFallTicks = 20;
/// A hand is let go at three times this depth (F_max / K, but 5 to 15 mm), with no point within
/// kFarFromPoints.
constexpr double kLeastGrip = 5e-3;
constexpr double kMostGrip = 15e-3;
constexpr double kFarFromPoints = 10e-3;
/// Every so many ticks in contact the contact point is looked up.
constexpr std::size_t kContactStride = 5;

double valueAt(std::vector<double> values, double part)
{
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : quantile(values, part);
}

double percent(std::int64_t part, std::int64_t whole)
{
  return whole > 0 ? 100.0 * double(part) / double(whole) : 0.0;
}

TouchTruth openTruth(const TriangleTree& tree, const TouchStroke& stroke, double stiffness)
{
  // A hand exactly on a facet has no side: about 1 nm aside it has one.
  const Vec3 aside{ 0.7e-9, 0.3e-9, 0.5e-9 };
  MeshGodObject hand(tree, MeshGodObject::Facets::OfOpenMesh);
  TouchTruth truth;
  for (const Vec3& onPath : stroke.hip)
  {
    const Vec3 hip = onPath + aside;
    const GodObjectState state = hand.step(hip);
    TouchTruth::Tick tick;
    tick.force = stiffness * (state.point - hip);
    tick.contact = state.contact;
    tick.free = !state.contact;
    tick.holds = norm(tick.force) > kForceFloor;
    truth.ticks.push_back(tick);
  }
  truth.certain = truth.ticks.size();
  return truth;
}

double energyOf(const std::vector<ProxyState>& states)
{
  double energy = 0.0;
  for (std::size_t i = 1; i < states.size(); ++i)
  {
    energy += 0.5 * dot(states[i].force + states[i - 1].force, states[i].hip - states[i - 1].hip);
  }
  return energy;
}

} // namespace

CloudDistance::CloudDistance(const std::vector<Vec3>& points)
  : points_(points)
{
  const PointView view(points.data(), std::int64_t(points.size()));
  query_.build(view);
}

double CloudDistance::operator()(const Vec3& p, double& spacing) const
{
  constexpr int kNeighbors = 9; // with the point itself
  Neighbor nearest;
  Neighbor around[kNeighbors];
  if (query_.nearest(p, 1, &nearest) == 0)
  {
    spacing = 0.0;
    return INFINITY;
  }
  const int found = query_.nearest(points_[std::size_t(nearest.index)], kNeighbors, around);
  const auto distance = [&](int k) { return std::sqrt(around[std::min(k, found - 1)].squaredDistance); };
  spacing = std::max(0.886 * distance(4), 0.627 * distance(8)); // as PointShape::spacing of a point not alone
  return std::sqrt(nearest.squaredDistance);
}

std::vector<TouchTruth> hardTruths(const HardScene& scene, double stiffness)
{
  std::vector<TouchTruth> truths;
  if (scene.mesh.triangles.empty())
  {
    return truths;
  }
  const TriangleTree tree(scene.mesh);
  for (const TouchStroke& stroke : scene.strokes)
  {
    truths.push_back(scene.isSolid ? truthOf(tree, stroke, stiffness, 100 + truths.size())
                                   : openTruth(tree, stroke, stiffness));
    for (TouchTruth::Tick& tick : truths.back().ticks)
    {
      tick.force *= kForceLimit / std::max(norm(tick.force), kForceLimit);
    }
  }
  return truths;
}

HardJudge::HardJudge(const HardScene& scene, const CloudDistance& distance, double stiffness)
  : distance_(distance)
  , stiffness_(stiffness)
  , hasTruth_(!scene.mesh.triangles.empty())
  , hasErrors_(scene.hasErrors)
  , errors_(stiffness)
{
}

bool HardJudge::isFar(const ProxyState& state) const
{
  const double grip = std::clamp(kForceLimit / stiffness_, kLeastGrip, kMostGrip);
  double spacing = 0.0;
  return norm(state.proxy - state.hip) > 3.0 * grip && distance_(state.hip, spacing) > kFarFromPoints;
}

void HardJudge::add(const TouchTrace& trace, const TouchTruth* truth)
{
  ++sum_.strokes;
  addTicks(trace);
  addEnd(trace, truth);
  if (truth)
  {
    addTruth(trace, *truth);
  }
  if (hasErrors_)
  {
    errors_.add(trace, *truth);
  }
}

void HardJudge::addEnd(const TouchTrace& trace, const TouchTruth* truth)
{
  const std::size_t size = trace.states.size();
  const bool isLong = size >= kEndTicks;
  bool isPulled = isLong;
  bool isAway = isLong;
  bool isTruthFree = truth != nullptr && isLong && !truth->leaps();
  bool isTruthHeld = truth != nullptr && isLong;
  for (std::size_t i = size - std::min(size, kEndTicks); i < size; ++i)
  {
    isPulled = isPulled && norm(trace.states[i].force) > kFeltForce;
    isAway = isAway && isPulled && isFar(trace.states[i]);
    isTruthFree = isTruthFree && truth->ticks[i].free;
    isTruthHeld = isTruthHeld && norm(truth->ticks[i].force) > kFeltForce;
  }
  sum_.notLetGo += isAway;
  sum_.held += isPulled && (truth ? isTruthFree : isAway);
  sum_.truthHeld += isTruthHeld;
}

void HardJudge::addTicks(const TouchTrace& trace)
{
  ticks_ += std::int64_t(trace.states.size());
  for (std::size_t i = 0; i < trace.states.size(); ++i)
  {
    const ProxyState& state = trace.states[i];
    sum_.nonFinite += !isFinite(state.force) || !isFinite(state.proxy);
    sum_.largestNewton = std::max(sum_.largestNewton, norm(state.force));
    for (std::size_t bit = 0; bit < kStatusBits; ++bit)
    {
      status_[bit] += (state.status >> bit) & 1u;
    }
    if (state.contact)
    {
      microseconds_.push_back(trace.microseconds[i]);
    }
    if (state.contact && i % kContactStride == 0)
    {
      double spacing = 0.0;
      const double distance = distance_(state.proxy, spacing);
      sum_.contactSpacings = std::max(sum_.contactSpacings, distance / std::max(spacing, 1e-9));
    }
  }
  const double energy = energyOf(trace.states);
  sum_.energyJoule = sum_.strokes == 1 ? energy : std::max(sum_.energyJoule, energy);
}

void HardJudge::addTruth(const TouchTrace& trace, const TouchTruth& truth)
{
  int lost = 0;
  for (std::size_t i = 0; i < truth.certain; ++i)
  {
    const double felt = norm(trace.states[i].force);
    const double right = norm(truth.ticks[i].force);
    if (truth.ticks[i].free)
    {
      ++freeTicks_;
      phantomTicks_ += felt > kFeltForce;
      sum_.phantomNewton = std::fmax(sum_.phantomNewton, felt);
    }
    else if (right >= kLeastLost && right < kBelowLimit)
    {
      ++pressedTicks_;
      lost += felt == 0.0;
    }
  }
  lostTicks_ += lost;
  sum_.fellThrough += lost >= kFallTicks;
}

HardFigures HardJudge::figures() const
{
  HardFigures f = sum_;
  if (hasTruth_)
  {
    f.phantomPercent = percent(phantomTicks_, freeTicks_);
    f.lostPercent = percent(lostTicks_, pressedTicks_);
  }
  if (hasErrors_)
  {
    const TouchFigures errors = errors_.figures();
    f.medianPercent = errors.medianPercent;
    f.p95Percent = errors.p95Percent;
  }
  f.p50 = valueAt(microseconds_, 0.5);
  f.p99 = valueAt(microseconds_, 0.99);
  for (std::size_t bit = 0; bit < kStatusBits; ++bit)
  {
    f.statusPercent[bit] = percent(status_[bit], ticks_);
  }
  return f;
}

} // namespace pointhaptics::bench::touch::hard
