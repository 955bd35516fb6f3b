#include "Benchmark/Proxy/Trial.h"

#include "Benchmark/Harness/Statistics.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace pointhaptics::bench::proxy
{
namespace
{

constexpr double kDegrees = 360.0 / kTwoPi;
constexpr double kClear = 20e-6;

/// Walks the course; the update time of each tick in microseconds, the least over all walks so far.
std::vector<ProxyState> walk(const HapticScene& scene, const HapticParameters& parameters,
  const Course& course, std::vector<double>& microseconds)
{
  Proxy proxy(parameters);
  proxy.setScene(&scene);
  std::vector<ProxyState> states;
  states.reserve(course.hip.size());
  for (std::size_t i = 0; i < course.hip.size(); ++i)
  {
    const auto before = std::chrono::steady_clock::now();
    const ProxyState state = proxy.step(course.hip[i], kTickSeconds);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - before;
    states.push_back(state);
    microseconds[i] = std::min(microseconds[i], took.count());
  }
  return states;
}

void judgeForces(const std::vector<ProxyState>& states, const std::vector<ExactContact>& exact,
  double stiffness, TrialFigures& figures)
{
  double errors = 0.0;
  double scale = 0.0;
  double worst = 0.0;
  double angles = 0.0;
  for (std::size_t i = 0; i < states.size(); ++i)
  {
    const double depth = exact[i].depth;
    figures.falseTicks += depth < -kClear && norm(states[i].force) > 0.0;
    if (i > 0)
    {
      const double moved = norm(states[i].hip - states[i - 1].hip);
      if (moved > kSmallestMove)
      {
        const double unit = stiffness * moved;
        figures.largestStep =
          std::max(figures.largestStep, norm(states[i].force - states[i - 1].force) / unit);
      }
    }
    if (depth <= kClear)
    {
      continue;
    }
    ++figures.contactTicks;
    figures.popThroughs += !states[i].contact;
    const double error = norm(states[i].force - exact[i].force);
    errors += error * error;
    scale += norm2(exact[i].force);
    worst = std::max(worst, error);
    const double sine = norm(cross(normalized(states[i].force, Vec3()), normalized(exact[i].force)));
    const double angle = kDegrees * std::asin(std::min(1.0, sine));
    angles += angle * angle;
    figures.directionMaximumDegrees = std::max(figures.directionMaximumDegrees, angle);
  }
  if (figures.contactTicks > 0)
  {
    const double rms = std::sqrt(scale / figures.contactTicks);
    figures.rmsPercent = 100.0 * std::sqrt(errors / figures.contactTicks) / rms;
    figures.maximumPercent = 100.0 * worst / rms;
    figures.directionRmsDegrees = std::sqrt(angles / figures.contactTicks);
  }
}

void judgeTurn(const std::vector<ProxyState>& states, const std::vector<ExactContact>& exact,
  const Course& course, TrialFigures& figures)
{
  if (course.loopTicks == 0)
  {
    return;
  }
  for (std::size_t i = course.loopBegin; i < course.loopBegin + course.loopTicks; ++i)
  {
    // The exact force returns nothing, but its sum over ticks does: only the difference tells.
    const Vec3 mean = 0.5 * (states[i].force - exact[i].force + states[i + 1].force - exact[i + 1].force);
    figures.energyJoule += dot(mean, states[i + 1].hip - states[i].hip);
  }
}

void judgeTimes(
  const std::vector<ProxyState>& states, const std::vector<double>& microseconds, TrialFigures& figures)
{
  std::vector<double> touching;
  for (std::size_t i = 0; i < states.size(); ++i)
  {
    if (!states[i].contact || i == 0 || !states[i - 1].contact)
    {
      figures.firstContact = std::max(figures.firstContact, microseconds[i]);
    }
    touching.insert(touching.end(), states[i].contact ? 1 : 0, microseconds[i]);
  }
  std::sort(touching.begin(), touching.end());
  if (!touching.empty())
  {
    figures.p50 = quantile(touching, 0.5);
    figures.p99 = quantile(touching, 0.99);
    figures.p999 = quantile(touching, 0.999);
    figures.maximum = touching.back();
  }
}

} // namespace

TrialFigures runTrial(const HapticScene& scene, const HapticParameters& parameters, const Course& course,
  const ExactAnswer& exact, int repetitions)
{
  std::vector<ProxyState> states;
  std::vector<double> microseconds(course.hip.size(), INFINITY);
  for (int i = 0; i < std::max(1, repetitions); ++i)
  {
    states = walk(scene, parameters, course, microseconds);
  }
  std::vector<ExactContact> answers;
  answers.reserve(course.hip.size());
  for (const Vec3& hip : course.hip)
  {
    answers.push_back(exact(hip));
  }
  TrialFigures figures;
  judgeForces(states, answers, parameters.contact.stiffness, figures);
  judgeTurn(states, answers, course, figures);
  judgeTimes(states, microseconds, figures);
  return figures;
}

} // namespace pointhaptics::bench::proxy
