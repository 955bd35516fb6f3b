#include "Haptics/ServoLoop.h"

#include "Haptics/LatestValue.h"
#include "Haptics/SceneExchange.h"
#include "Haptics/ServoThread.h"
#include "Haptics/TraceRing.h"

#include <atomic>
#include <thread>

namespace pointhaptics
{
namespace
{
/// A device silent for longer than this may have moved anywhere: its hand is taken as new.
constexpr double kForgetAfterSeconds = 0.1;
constexpr int kLargestTrace = 1 << 22;

bool valid(const ServoSettings& settings)
{
  return settings.rateHz >= 1.0 && settings.rateHz <= 10000.0 && settings.traceCapacity >= 1 &&
    settings.traceCapacity <= kLargestTrace && settings.limits.check() == Status::Ok;
}

/// One writer; read by any thread.
void increase(std::atomic<std::uint64_t>& counter, std::uint64_t amount) noexcept
{
  counter.store(counter.load(std::memory_order_relaxed) + amount, std::memory_order_relaxed);
}
}

struct ServoLoop::Implementation
{
  // Shared between the threads, each by a hand-over that makes nobody wait.
  SceneExchange scenes;
  LatestValue<HapticParameters> parameters;
  LatestValue<ServoSample> newest;
  TraceRing<ServoSample> trace;
  LatencyHistogram lateness;
  LatencyHistogram update;
  std::atomic<std::uint64_t> ticks{ 0 };
  std::atomic<std::uint64_t> missedTicks{ 0 };
  std::atomic<std::uint64_t> deviceFaults{ 0 };
  std::atomic<std::int64_t> firstWake{ 0 };
  std::atomic<std::int64_t> newestWake{ 0 };
  std::atomic<bool> realtime{ false };
  std::atomic<bool> running{ false };
  std::atomic<bool> stopRequested{ false };

  // The servo thread's from start() to the join in stop().
  std::thread thread;
  ServoSettings settings;
  HandPort* port = nullptr;
  Proxy proxy;
  ForceGuard guard;
  const HapticScene* scene = nullptr;
  std::uint64_t parametersVersion = 0;
  std::uint64_t lastSteppedTick = 0;
  ServoSample sample;

  void prepare(HandPort& newPort, const HapticParameters& newParameters, const ServoSettings& newSettings);
  void run() noexcept;
  Status tick(std::uint64_t number, std::int64_t wake) noexcept;
  Vec3 answer(const HandState& hand, std::uint64_t number) noexcept;
  void takeNews() noexcept;
};

void ServoLoop::Implementation::prepare(
  HandPort& newPort, const HapticParameters& newParameters, const ServoSettings& newSettings)
{
  port = &newPort;
  settings = newSettings;
  proxy = Proxy(newParameters);
  guard = ForceGuard(settings.limits);
  scene = nullptr;
  lastSteppedTick = 0;
  sample = ServoSample();
  parameters.write(newParameters);
  parametersVersion = parameters.version();
  newest.write(sample);
  trace.resize(std::size_t(settings.traceCapacity));
  lateness.clear();
  update.clear();
  for (auto* counter : { &ticks, &missedTicks, &deviceFaults })
  {
    counter->store(0, std::memory_order_relaxed);
  }
  firstWake.store(0, std::memory_order_relaxed);
  newestWake.store(0, std::memory_order_relaxed);
  realtime.store(false, std::memory_order_relaxed);
  stopRequested.store(false, std::memory_order_relaxed);
  running.store(true, std::memory_order_release);
}

void ServoLoop::Implementation::run() noexcept
{
  flushDenormalsToZero();
  setFinestTimerSlack();
  realtime.store(settings.realtimePriority && requestRealtimePriority(), std::memory_order_relaxed);

  const double period = 1e9 / settings.rateHz;
  const std::int64_t start = steadyNanoseconds();
  const auto deadline = [&](std::uint64_t number)
  { return start + std::int64_t(double(number - 1) * period); };
  std::uint64_t number = 1;
  while (!stopRequested.load(std::memory_order_acquire))
  {
    sleepUntil(deadline(number));
    const std::int64_t wake = steadyNanoseconds();
    lateness.record(1e-9 * double(wake - deadline(number)));
    std::uint64_t missed = 0;
    if (wake >= deadline(number + 1))
    {
      // Catching up would run ticks back to back with a hand that has not moved: answer the newest deadline
      // only.
      missed = std::uint64_t(double(wake - deadline(number)) / period);
    }
    increase(missedTicks, missed);
    number += missed;
    if (tick(number, wake) == Status::EndOfPath)
    {
      break;
    }
    ++number;
  }
  static_cast<void>(port->write(double(number - 1) / settings.rateHz, Vec3()));
  running.store(false, std::memory_order_release);
}

Status ServoLoop::Implementation::tick(std::uint64_t number, std::int64_t wake) noexcept
{
  const double time = double(number - 1) / settings.rateHz;
  HandState hand;
  const Status reading = port->read(time, hand);
  if (reading == Status::EndOfPath)
  {
    return reading;
  }
  takeNews();
  sample.tick = number;
  sample.timeSeconds = time;
  bool healthy = reading == Status::Ok;
  if (healthy)
  {
    sample.buttons = hand.buttons;
    sample.state.force = answer(hand, number);
  }
  healthy = port->write(time, healthy ? sample.state.force : Vec3()) == Status::Ok && healthy;
  if (!healthy)
  {
    sample.state.force = {};
    guard.reset();
    increase(deviceFaults, 1);
  }
  sample.updateSeconds = 1e-9 * double(steadyNanoseconds() - wake);
  update.record(sample.updateSeconds);
  trace.push(sample);
  newest.write(sample);
  if (firstWake.load(std::memory_order_relaxed) == 0)
  {
    firstWake.store(wake, std::memory_order_relaxed);
  }
  newestWake.store(wake, std::memory_order_relaxed);
  increase(ticks, 1);
  return Status::Ok;
}

/// Steps the proxy; fills the sample's state. @return the guarded force.
Vec3 ServoLoop::Implementation::answer(const HandState& hand, std::uint64_t number) noexcept
{
  const double elapsed = double(number - lastSteppedTick) / settings.rateHz;
  if (lastSteppedTick != 0 && elapsed > kForgetAfterSeconds && number - lastSteppedTick > 1)
  {
    proxy.reset();
  }
  lastSteppedTick = number;
  sample.state = proxy.step(hand.position, elapsed);
  // One period even after missed ticks: a force that the hand did not feel grow must not arrive all at once.
  return guard.limit(sample.state.force, 1.0 / settings.rateHz);
}

void ServoLoop::Implementation::takeNews() noexcept
{
  const HapticScene* const newScene = scenes.acquire();
  if (newScene != scene)
  {
    scene = newScene;
    proxy.setScene(scene);
  }
  HapticParameters newParameters;
  if (parameters.version() != parametersVersion && parameters.tryRead(newParameters, &parametersVersion))
  {
    proxy.setParameters(newParameters);
  }
}

ServoLoop::ServoLoop()
  : implementation_(std::make_unique<Implementation>())
{
}

ServoLoop::~ServoLoop()
{
  stop();
}

Status ServoLoop::start(HandPort& port, const HapticParameters& parameters, const ServoSettings& settings)
{
  if (running() || !valid(settings) || parameters.check() != Status::Ok)
  {
    return Status::InvalidParameter;
  }
  stop();
  Implementation& self = *implementation_;
  self.prepare(port, parameters, settings);
  try
  {
    self.thread = std::thread([&self]() noexcept { self.run(); });
  }
  catch (...)
  {
    self.running.store(false, std::memory_order_release);
    throw;
  }
  return Status::Ok;
}

void ServoLoop::stop()
{
  Implementation& self = *implementation_;
  self.stopRequested.store(true, std::memory_order_release);
  if (self.thread.joinable())
  {
    self.thread.join();
  }
  self.scenes.collect();
}

bool ServoLoop::running() const noexcept
{
  return implementation_->running.load(std::memory_order_acquire);
}

void ServoLoop::publishScene(std::shared_ptr<const HapticScene> scene)
{
  implementation_->scenes.publish(std::move(scene));
}

void ServoLoop::setParameters(const HapticParameters& parameters)
{
  implementation_->parameters.write(parameters);
}

ServoSample ServoLoop::latest() const noexcept
{
  return implementation_->newest.read();
}

ServoStatistics ServoLoop::statistics() const noexcept
{
  const Implementation& self = *implementation_;
  ServoStatistics result;
  result.ticks = self.ticks.load(std::memory_order_relaxed);
  result.missedTicks = self.missedTicks.load(std::memory_order_relaxed);
  result.deviceFaults = self.deviceFaults.load(std::memory_order_relaxed);
  result.lostTraceSamples = self.trace.lost();
  const std::int64_t elapsed =
    self.newestWake.load(std::memory_order_relaxed) - self.firstWake.load(std::memory_order_relaxed);
  result.rateHz = elapsed > 0 && result.ticks > 1 ? double(result.ticks - 1) * 1e9 / double(elapsed) : 0.0;
  result.lateness = self.lateness.summary();
  result.update = self.update.summary();
  result.realtime = self.realtime.load(std::memory_order_relaxed);
  return result;
}

void ServoLoop::takeTrace(std::vector<ServoSample>& samples)
{
  implementation_->trace.take(samples);
  implementation_->scenes.collect();
}

} // namespace pointhaptics
