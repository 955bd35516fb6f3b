#include "Benchmark/Proxy/Trial.h"

#include "Benchmark/Harness/Statistics.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace proxy
{
namespace
{

constexpr double kDegrees = 360.0 / kTwoPi;
constexpr double kClear = 20e-6;

/// Walks the course; the update time of each tick in microseconds, the least over all walks so far.
std::vector<ProxyState> walk(const HapticScene& scene, const HapticParameters& parameters,
  const Course& course, InstructionSet wanted, std::vector<double>& microseconds)
{
  Proxy proxy(parameters, wanted);
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

/// RMS over a period of the components above 100 Hz.
double highFrequencies(const std::vector<Vec3>& signal)
{
  const std::size_t n = signal.size();
  const double cut = 100.0 * kTickSeconds * double(n);
  // What lies above is the whole less what lies at and below.
  Vec3 mean;
  double power = 0.0;
  for (const Vec3& v : signal)
  {
    mean += v / double(n);
    power += norm2(v) / double(n);
  }
  power -= norm2(mean);
  for (std::size_t k = 1; double(k) <= cut && 2 * k <= n; ++k)
  {
    Vec3 re;
    Vec3 im;
    for (std::size_t i = 0; i < n; ++i)
    {
      const double phase = kTwoPi * double((k * i) % n) / double(n);
      re += std::cos(phase) * signal[i];
      im += std::sin(phase) * signal[i];
    }
    power -= (2 * k == n ? 1.0 : 2.0) * (norm2(re) + norm2(im)) / (double(n) * double(n));
  }
  return std::sqrt(std::max(0.0, power));
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
    figures.status |= states[i].status;
    figures.cappedTicks += (states[i].status & kProxyRoundLimit) != 0;
    if (i > 0)
    {
      const double moved = norm(states[i].hip - states[i - 1].hip);
      if (moved > kSmallestMove)
      {
        const double unit = stiffness * moved;
        figures.largestStep =
          std::max(figures.largestStep, norm(states[i].force - states[i - 1].force) / unit);
        figures.exactStep = std::max(figures.exactStep, norm(exact[i].force - exact[i - 1].force) / unit);
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
  std::vector<Vec3> error;
  for (std::size_t i = course.loopBegin; i < course.loopBegin + course.loopTicks; ++i)
  {
    error.push_back(states[i].force - exact[i].force);
    // The exact force returns nothing, but its sum over ticks does: only the difference tells.
    const Vec3 mean = 0.5 * (states[i].force - exact[i].force + states[i + 1].force - exact[i + 1].force);
    figures.energyJoule += dot(mean, states[i + 1].hip - states[i].hip);
  }
  figures.above100Hz = highFrequencies(error);
}

/// @return the times in contact, sorted.
std::vector<double> judgeTimes(
  const std::vector<ProxyState>& states, const std::vector<double>& microseconds, TrialFigures& figures)
{
  std::vector<double> touching;
  std::vector<double> free;
  for (std::size_t i = 0; i < states.size(); ++i)
  {
    const bool first = states[i].contact && (i == 0 || !states[i - 1].contact);
    if (first || !states[i].contact)
    {
      figures.firstContact = std::max(figures.firstContact, microseconds[i]);
    }
    (states[i].contact ? touching : free).push_back(microseconds[i]);
  }
  std::sort(touching.begin(), touching.end());
  std::sort(free.begin(), free.end());
  if (!touching.empty())
  {
    figures.p50 = quantile(touching, 0.5);
    figures.p99 = quantile(touching, 0.99);
    figures.p999 = quantile(touching, 0.999);
    figures.maximum = touching.back();
  }
  figures.freeP50 = free.empty() ? 0.0 : quantile(free, 0.5);
  return touching;
}

} // namespace

Trial runTrial(const HapticScene& scene, const HapticParameters& parameters, const Course& course,
  const ExactAnswer& exact, int repetitions, InstructionSet wanted)
{
  Trial trial;
  std::vector<double> microseconds(course.hip.size(), INFINITY);
  for (int i = 0; i < std::max(1, repetitions); ++i)
  {
    trial.states = walk(scene, parameters, course, wanted, microseconds);
  }
  std::vector<ExactContact> answers;
  answers.reserve(course.hip.size());
  for (const Vec3& hip : course.hip)
  {
    answers.push_back(exact(hip));
  }
  judgeForces(trial.states, answers, parameters.contact.stiffness, trial.figures);
  judgeTurn(trial.states, answers, course, trial.figures);
  trial.microseconds = judgeTimes(trial.states, microseconds, trial.figures);
  return trial;
}

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
