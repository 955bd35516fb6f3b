#include "Benchmark/Touch/TouchJudge.h"

#include "Benchmark/Harness/Statistics.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace pointhaptics::bench::touch
{
namespace
{

constexpr double kDegrees = 57.29577951308232;
constexpr double kSmallestMove = 1e-6;
constexpr double kLostDepth = 5e-5;
constexpr double kHeldForce = 0.05;
constexpr std::size_t kEndTicks = 50;

double at(std::vector<double> values, double part)
{
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : quantile(values, part);
}

double percent(std::int64_t part, std::int64_t whole)
{
  return whole > 0 ? 100.0 * double(part) / double(whole) : 0.0;
}

double angleBetween(const Vec3& a, const Vec3& b)
{
  return kDegrees * std::atan2(norm(cross(a, b)), dot(a, b));
}

} // namespace

TouchTrace walk(
  TouchMethod& method, const TouchScene& scene, const TouchStroke& stroke, std::size_t ticks, int repetitions)
{
  TouchTrace trace;
  trace.microseconds.assign(ticks, INFINITY);
  for (int repetition = 0; repetition < std::max(1, repetitions); ++repetition)
  {
    trace.states.clear();
    method.reset(scene);
    for (std::size_t i = 0; i < ticks; ++i)
    {
      method.prepare(stroke.hip[i]);
      const auto before = std::chrono::steady_clock::now();
      const ProxyState state = method.step(stroke.hip[i], kTickSeconds);
      const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - before;
      trace.states.push_back(state);
      trace.microseconds[i] = std::min(trace.microseconds[i], took.count());
    }
  }
  return trace;
}

void TouchJudge::add(const TouchTrace& trace, const TouchTruth& truth)
{
  ++figures_.strokes;
  figures_.leaps += truth.leaps();
  figures_.ticks += std::int64_t(truth.certain);
  for (std::size_t i = 0; i < trace.states.size(); ++i)
  {
    const ProxyState& state = trace.states[i];
    figures_.nonFinite += !isFinite(state.force) || !isFinite(state.proxy) || !isFinite(state.normal);
    if (!state.contact || i == 0 || !trace.states[i - 1].contact)
    {
      figures_.firstContact = std::max(figures_.firstContact, trace.microseconds[i]);
    }
    longest_ = std::max(longest_, trace.microseconds[i]);
    if (state.contact)
    {
      microseconds_.push_back(trace.microseconds[i]);
    }
    figures_.releases += i > 0 && i < truth.certain && trace.states[i - 1].contact && !state.contact;
    for (std::size_t bit = 0; i < truth.certain && bit < kStatusBits; ++bit)
    {
      status_[bit] += (state.status >> bit) & 1u;
    }
  }
  addForces(trace, truth);
  addSteps(trace, truth);
  addEnd(trace, truth);
}

void TouchJudge::addForces(const TouchTrace& trace, const TouchTruth& truth)
{
  bool pops = false;
  for (std::size_t i = 0; i < trace.states.size(); ++i)
  {
    const TouchTruth::Tick& tick = truth.ticks[i];
    const Vec3& force = trace.states[i].force;
    const bool isCertain = i < truth.certain;
    if (tick.free)
    {
      double& phantom = isCertain ? figures_.phantomNewton : figures_.laterPhantomNewton;
      phantom = std::max(phantom, norm(force));
    }
    figures_.contacts += isCertain && tick.contact;
    if (!tick.holds || !isCertain)
    {
      continue;
    }
    ++figures_.judged;
    pops = pops || dot(force, tick.force) <= 0.0;
    const double error = norm(force - tick.force);
    const double size = norm(tick.force);
    errors_.push_back(100.0 * error / size);
    squares_ += error * error;
    scale_ += size * size;
    if (norm(force) > 0.0)
    {
      angles_.push_back(angleBetween(force, tick.force));
    }
    else
    {
      lost_ += size > kLostDepth * stiffness_;
    }
  }
  figures_.pops += pops;
}

void TouchJudge::addSteps(const TouchTrace& trace, const TouchTruth& truth)
{
  double energy = 0.0;
  for (std::size_t i = 1; i < truth.certain; ++i)
  {
    const ProxyState& state = trace.states[i];
    const ProxyState& last = trace.states[i - 1];
    const Vec3 moved = state.hip - last.hip;
    const Vec3 surplus = 0.5 * (state.force - truth.ticks[i].force + last.force - truth.ticks[i - 1].force);
    energy += dot(surplus, moved);
    if (norm(moved) > kSmallestMove && (norm(state.force) > 0.0 || norm(last.force) > 0.0))
    {
      steps_.push_back(norm(state.force - last.force) / (stiffness_ * norm(moved)));
    }
  }
  energies_.push_back(energy);
}

void TouchJudge::addEnd(const TouchTrace& trace, const TouchTruth& truth)
{
  const std::size_t size = trace.states.size();
  bool held = size >= kEndTicks;
  for (std::size_t i = size - std::min(size, kEndTicks); i < size; ++i)
  {
    held = held && truth.ticks[i].free && norm(trace.states[i].force) > kHeldForce;
  }
  (truth.leaps() ? figures_.laterHeld : figures_.held) += held;
}

TouchFigures TouchJudge::figures() const
{
  TouchFigures f = figures_;
  f.judgedPercent = percent(f.judged, f.contacts);
  f.medianPercent = at(errors_, 0.5);
  f.p95Percent = at(errors_, 0.95);
  f.rmsPercent = scale_ > 0.0 ? 100.0 * std::sqrt(squares_ / scale_) : 0.0;
  f.directionP95Degrees = at(angles_, 0.95);
  f.lostPercent = percent(lost_, f.judged);
  f.largestStep = at(steps_, 1.0);
  f.stepP99 = at(steps_, 0.99);
  f.energyJoule = at(energies_, 0.5);
  f.p50 = at(microseconds_, 0.5);
  f.p99 = at(microseconds_, 0.99);
  f.maximum = longest_;
  for (std::size_t bit = 0; bit < kStatusBits; ++bit)
  {
    f.statusPercent[bit] = percent(status_[bit], f.ticks);
  }
  return f;
}

} // namespace pointhaptics::bench::touch
