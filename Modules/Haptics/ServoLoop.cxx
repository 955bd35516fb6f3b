#include "Haptics/ServoLoop.h"

#include "Haptics/Servo/LatestValue.h"
#include "Haptics/Servo/SceneExchange.h"
#include "Haptics/Servo/ServoThread.h"
#include "Haptics/Servo/TraceRing.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>

namespace pointhaptics
{
namespace
{
/// A hand that moved less in a tick stood still, metres.
constexpr double kStill = 1e-8;
constexpr double kIdleAfterSeconds = 0.5;
constexpr double kIdlePeriodSeconds = 0.02;
constexpr int kLargestTrace = 1 << 22;
constexpr double kLongestWatch = 3600.0;
constexpr double kEarliestWake = 1e-3;
/// Largest part of a period by which the thread may wake early: the rest of the core is for others.
constexpr double kLargestEarlyPart = 0.5;
/// Inputs kept for a reader that does not come.
constexpr std::size_t kMostInputs = 10000;

bool valid(const ServoSettings& settings)
{
  return settings.rateHz >= 1.0 && settings.rateHz <= 10000.0 && settings.traceCapacity >= 1 &&
    settings.traceCapacity <= kLargestTrace && settings.wakeEarlySeconds >= 0.0 &&
    settings.wakeEarlySeconds <= kEarliestWake && settings.limits.check() == Status::Ok &&
    settings.watchdogSeconds >= 0.0 && settings.watchdogSeconds <= kLongestWatch;
}

/// The limits of a port, with the lesser of its two maximum forces.
HandLimits limitsOf(const HapticPort& port)
{
  HandLimits limits = port.limits();
  limits.maximumForce = std::min(limits.maximumForce, port.maximumForce());
  return limits;
}

template <typename Input>
void keep(std::vector<Input>& inputs, Input input)
{
  if (inputs.size() >= kMostInputs)
  {
    inputs.erase(inputs.begin(), inputs.begin() + kMostInputs / 2);
  }
  inputs.push_back(std::move(input));
}
}

std::string describeRefusals(const ServoStatistics& statistics)
{
  std::string text;
  const auto add = [&](int error, const std::string& what, const std::string& cure)
  {
    if (error != 0)
    {
      text += (text.empty() ? "" : "\n") + what + " (" + std::generic_category().message(error) + ")" + cure;
    }
  };
  add(statistics.realtimeRefusal, "the servo thread got no real-time priority",
    ": ticks may come late on a busy machine; allow rtprio 40 for this user in /etc/security/limits.d");
  add(statistics.memoryRefusal, "the program may be swapped out",
    "; allow memlock unlimited for this user in /etc/security/limits.d");
  add(statistics.awakeRefusal, "the processor may fall asleep between ticks",
    ": they may come some hundreds of microseconds late; let this user write /dev/cpu_dma_latency, as "
    "70-pointhaptics.rules does for group plugdev after `sudo udevadm trigger "
    "--sysname-match=cpu_dma_latency`");
  return text;
}

PublishedScene PublishedScene::of(const HapticScene* scene)
{
  PublishedScene published;
  if (scene)
  {
    published.number = scene->number();
    published.modelToWorkspace = scene->modelToWorkspace();
    published.cloud = scene->cloudNumber();
    published.origin = scene->origin();
  }
  return published;
}

struct ServoLoop::Implementation
{
  // Shared between the threads, each by an exchange without waiting.
  SceneExchange scenes;
  std::mutex publishing; ///< Guards the publishing side of scenes and inputs; the servo thread never takes
                         ///< it.
  ServoInputs inputs;
  LatestValue<HapticParameters> parameters;
  LatestValue<ServoSample> newest;
  TraceRing<ServoSample> trace;
  LatencyHistogram jitter;
  LatencyHistogram update;
  LatestValue<ServoStatistics> statistics;        ///< Without what the trace and the histograms know.
  std::atomic<std::int64_t> newestHeartbeat{ 0 }; ///< steadyNanoseconds().
  std::atomic<bool> running{ false };
  std::atomic<bool> stopRequested{ false };
  std::atomic<bool> clutched{ false };
  std::atomic<bool> beginsAnew{ false }; ///< As soon as the hand allows it.

  WakefulCores wakefulCores; ///< Requested by the thread that starts and stops.

  // The servo thread's from start() to the join in stop().
  std::thread thread;
  ServoSettings settings;
  HapticPort* port = nullptr;
  HandLimits limits;
  ForceLimit forceLimit{ INFINITY, 0.0, kMostServoForce }; ///< Of the newest parameters.
  std::atomic<std::int64_t> origin{ 0 };                   ///< steadyNanoseconds() of time 0.
  ServoStepSettings stepSettings;
  ServoStep step;
  const HapticScene* scene = nullptr;
  ServoStatistics count;
  std::int64_t firstWake = 0;
  bool isFed = false; ///< By feed(): the thread does not run. Of the thread that starts and stops.
  std::uint64_t parametersVersion = 0;
  Vec3 lastHip;
  std::uint64_t stillTicks = 0; ///< In a row, without anything to do.
  bool hasUpdates = false;      ///< In this tick.
  bool holdsModel = false;      ///< In this tick.
  ServoSample sample;

  HapticParameters writeParameters(HapticParameters newParameters);
  void clear();
  void publish(const ServoSample& newSample, std::int64_t wake) noexcept;
  void prepare(HapticPort& newPort, const HapticParameters& wanted, const ServoSettings& newSettings);
  void run() noexcept;
  void waitFor(std::int64_t deadline, double early) noexcept;
  Status tick(std::uint64_t number, std::int64_t wake) noexcept;
  void applyUpdates() noexcept;
  bool gateIsOpen(std::int64_t wake) noexcept;
  std::uint64_t ticksToIdle() noexcept;
  bool pushes() const noexcept { return sample.state.force != Vec3(); }
  void heartbeat() noexcept { newestHeartbeat.store(steadyNanoseconds(), std::memory_order_relaxed); }
};

/// Publishes the parameters with the force limit that holds. @return those.
HapticParameters ServoLoop::Implementation::writeParameters(HapticParameters newParameters)
{
  forceLimit = servoForceLimit(limits, newParameters.contact, settings.limits);
  // A limit of 0 is the guard's.
  newParameters.contact.forceLimit = std::max(forceLimit.newtons(), std::numeric_limits<double>::min());
  const std::lock_guard<std::mutex> lock(publishing);
  parameters.write(newParameters);
  keep(inputs.parameters, { parameters.version(), newParameters });
  return newParameters;
}

/// Statistics, trace and the newest sample, for a new start.
void ServoLoop::Implementation::clear()
{
  newest.write(sample);
  trace.resize(std::size_t(settings.traceCapacity));
  jitter.clear();
  update.clear();
  count = ServoStatistics();
  firstWake = 0;
  stopRequested.store(false, std::memory_order_relaxed);
}

void ServoLoop::Implementation::prepare(
  HapticPort& newPort, const HapticParameters& wanted, const ServoSettings& newSettings)
{
  port = &newPort;
  settings = newSettings;
  limits = limitsOf(*port);
  stepSettings.rateHz = settings.rateHz;
  stepSettings.limits = settings.limits;
  stepSettings.limits.maximumForce =
    std::min({ settings.limits.maximumForce, kMostServoForce, limits.maximumForce });
  stepSettings.rampDownSeconds = limits.rampDownSeconds;
  stepSettings.rampUpSeconds = limits.rampUpSeconds;
  stepSettings.clutchDownSeconds = std::max(limits.rampDownSeconds, ServoLoop::kClutchDownSeconds);
  stepSettings.clutchUpSeconds = std::max(limits.rampUpSeconds, ServoLoop::kClutchUpSeconds);
  step = ServoStep(stepSettings, writeParameters(wanted));
  clutched.store(false, std::memory_order_relaxed);
  beginsAnew.store(true, std::memory_order_relaxed); // whatever the number of the first tick
  scene = nullptr;
  stillTicks = 0;
  sample = ServoSample();
  parametersVersion = parameters.version();
  sample.parameters = parametersVersion;
  clear();
  count.memoryRefusal = settings.lockMemory ? lockMemory() : 0;
  count.awakeRefusal = settings.keepCoresAwake ? wakefulCores.request() : 0;
  statistics.write(count);
  heartbeat();
  running.store(true, std::memory_order_release);
}

void ServoLoop::Implementation::run() noexcept
{
  flushDenormalsToZero();
  setFinestTimerSlack();
  touchStack();
  if (settings.realtimePriority)
  {
    count.realtimeRefusal = requestRealtimePriority();
    count.realtime = count.realtimeRefusal == 0;
    statistics.write(count);
  }

  const double period = 1e9 / settings.rateHz;
  const std::int64_t start = steadyNanoseconds();
  origin.store(start, std::memory_order_relaxed);
  const auto deadline = [&](std::uint64_t number)
  { return start + std::int64_t(double(number - 1) * period); };
  std::uint64_t number = 1;
  std::uint64_t idle = 0; // deadlines passed over since the last tick
  // A stop is obeyed once the gate has closed, and at once where nothing pushes.
  while (!stopRequested.load(std::memory_order_acquire) || (step.openFraction() > 0.0 && pushes()))
  {
    // An idle loop saves the work of waking early too.
    waitFor(deadline(number),
      idle > 0 ? 0.0 : std::min(settings.wakeEarlySeconds, kLargestEarlyPart * 1e-9 * period));
    const std::int64_t wake = steadyNanoseconds();
    jitter.record(1e-9 * double(wake - deadline(number)));
    std::uint64_t missed = 0;
    if (wake >= deadline(number + 1))
    {
      // Catching up would run ticks back to back with a hand that has not moved: answer the newest deadline
      // only.
      missed = std::uint64_t(double(wake - deadline(number)) / period);
    }
    count.deadlineMisses += missed;
    count.idleTicks += idle;
    number += missed;
    if (tick(number, wake) == Status::EndOfPath)
    {
      break;
    }
    idle = ticksToIdle();
    number += 1 + idle;
  }
  statistics.write(count);
  static_cast<void>(port->write(double(number - 1) / settings.rateHz, Vec3()));
  running.store(false, std::memory_order_release);
}

/// Returns at @p deadline with the updates taken, and with the tick's code and data at hand if it may wake @p
/// early seconds before; late where the system wakes the thread late.
void ServoLoop::Implementation::waitFor(std::int64_t deadline, double early) noexcept
{
  sleepUntil(deadline - std::int64_t(1e9 * early));
  // Whoever let go had published the scene that is to be felt: not the other way about.
  holdsModel = clutched.load(std::memory_order_acquire);
  // The prefetch steps in the newest scene: without this the first tick there would read memory that no tick
  // has read before.
  applyUpdates();
  if (early > 0.0 && steadyNanoseconds() < deadline)
  {
    step.prefetch();
    spinUntil(deadline);
  }
}

Status ServoLoop::Implementation::tick(std::uint64_t number, std::int64_t wake) noexcept
{
  const double time = double(number - 1) / settings.rateHz;
  TickInput input;
  input.number = number;
  input.reading = port->read(time, input.hand);
  if (input.reading == Status::EndOfPath)
  {
    return input.reading;
  }
  input.holdsModel = holdsModel;
  input.gateIsOpen = gateIsOpen(wake);
  if (beginsAnew.load(std::memory_order_relaxed) && !input.holdsModel && input.gateIsOpen && step.isAtRest())
  {
    beginsAnew.store(false, std::memory_order_relaxed);
    step.restart(number);
  }
  step.step(input, sample);
  const bool healthy = input.reading == Status::Ok;
  const Status writing = port->write(time, healthy ? sample.state.force : Vec3());
  step.finish(input, writing, sample);
  if (sample.device != Status::Ok)
  {
    const bool waits = (healthy || input.reading == Status::DeviceNotReady) &&
      (writing == Status::Ok || writing == Status::DeviceNotReady);
    ++(waits ? count.waitingTicks : count.deviceFaults);
  }
  sample.updateSeconds = 1e-9 * double(steadyNanoseconds() - wake);
  update.record(sample.updateSeconds);
  publish(sample, wake);
  return Status::Ok;
}

void ServoLoop::Implementation::publish(const ServoSample& newSample, std::int64_t wake) noexcept
{
  trace.push(newSample);
  newest.write(newSample);
  firstWake = firstWake == 0 ? wake : firstWake;
  ++count.ticks;
  const double answered = double(count.ticks + count.idleTicks);
  count.rateHz =
    count.ticks > 1 && wake > firstWake ? (answered - 1.0) * 1e9 / double(wake - firstWake) : 0.0;
  statistics.write(count);
}

bool ServoLoop::Implementation::gateIsOpen(std::int64_t wake) noexcept
{
  const double age = 1e-9 * double(wake - newestHeartbeat.load(std::memory_order_relaxed));
  const bool stale = settings.watchdogSeconds > 0.0 && age > settings.watchdogSeconds;
  count.staleTicks += stale ? 1 : 0;
  return !stale && !stopRequested.load(std::memory_order_acquire);
}

/// After a tick: how many of the next ones may be left out.
std::uint64_t ServoLoop::Implementation::ticksToIdle() noexcept
{
  const bool still = settings.idlesWhenStill && !hasUpdates && sample.device == Status::Ok &&
    !sample.state.contact && !pushes() && norm(sample.state.hip - lastHip) < kStill && port->mayIdle();
  lastHip = sample.state.hip;
  stillTicks = still ? stillTicks + 1 : 0;
  if (double(stillTicks) < kIdleAfterSeconds * settings.rateHz || kIdlePeriodSeconds * settings.rateHz < 2.0)
  {
    return 0;
  }
  return std::uint64_t(kIdlePeriodSeconds * settings.rateHz) - 1;
}

void ServoLoop::Implementation::applyUpdates() noexcept
{
  const HapticScene* const newScene = scenes.acquire();
  hasUpdates = newScene != scene;
  if (newScene != scene)
  {
    scene = newScene;
    ++sample.scenes;
    sample.scene = scene ? scene->number() : 0;
    step.setScene(scene);
  }
  HapticParameters newParameters;
  if (parameters.version() != parametersVersion && parameters.tryRead(newParameters, &parametersVersion))
  {
    step.setParameters(newParameters);
    sample.parameters = parametersVersion;
    hasUpdates = true;
  }
}

ServoLoop::ServoLoop()
  : implementation_(std::make_unique<Implementation>())
{
}

ServoLoop::~ServoLoop()
{
  lifetime_.end(); // nobody publishes any more
  stop();
}

Status ServoLoop::start(
  HapticPort& port, const HapticParameters& parameters, const ServoSettings& settings, std::string* message)
{
  const HandLimits limits = limitsOf(port);
  const bool mayStart = !running() && valid(settings) && limits.maximumForce > 0.0;
  const Status status = checkSpring(mayStart, limits, parameters, settings.rateHz, message);
  if (status != Status::Ok)
  {
    return status;
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
    self.wakefulCores.release();
    throw;
  }
  return Status::Ok;
}

Status ServoLoop::startFed(const ServoStepSettings& settings, int traceCapacity)
{
  if (running() || traceCapacity < 1 || traceCapacity > kLargestTrace)
  {
    return Status::InvalidParameter;
  }
  stop();
  Implementation& self = *implementation_;
  self.settings = ServoSettings();
  self.settings.rateHz = settings.rateHz;
  self.settings.traceCapacity = traceCapacity;
  self.limits = HandLimits();
  self.forceLimit = servoForceLimit(self.limits, ContactParameters(), self.settings.limits);
  self.stepSettings = settings;
  self.sample = ServoSample();
  self.clear();
  self.isFed = true;
  self.running.store(true, std::memory_order_release);
  return Status::Ok;
}

void ServoLoop::feed(const ServoSample& sample) noexcept
{
  Implementation& self = *implementation_;
  static_cast<void>(self.scenes.acquire()); // what is published for nobody is out of use
  const std::int64_t now = steadyNanoseconds();
  self.update.record(sample.updateSeconds);
  self.publish(sample, now);
}

void ServoLoop::stop()
{
  Implementation& self = *implementation_;
  if (self.isFed)
  {
    self.isFed = false;
    self.running.store(false, std::memory_order_release);
  }
  self.stopRequested.store(true, std::memory_order_release);
  if (self.thread.joinable())
  {
    self.thread.join();
  }
  self.wakefulCores.release();
  const std::lock_guard<std::mutex> lock(self.publishing);
  self.scenes.collect();
}

bool ServoLoop::running() const noexcept
{
  return implementation_->running.load(std::memory_order_acquire);
}

void ServoLoop::publishScene(std::shared_ptr<const HapticScene> scene)
{
  const std::lock_guard<std::mutex> lock(implementation_->publishing);
  keep(implementation_->inputs.scenes, PublishedScene::of(scene.get()));
  implementation_->scenes.publish(std::move(scene));
}

Status ServoLoop::setParameters(const HapticParameters& parameters, std::string* message)
{
  Implementation& self = *implementation_;
  self.heartbeat();
  const Status status = checkSpring(true, self.limits, parameters, self.settings.rateHz, message);
  if (status == Status::Ok)
  {
    self.writeParameters(parameters);
  }
  return status;
}

void ServoLoop::setClutched(bool clutched) noexcept
{
  implementation_->clutched.store(clutched, std::memory_order_release);
}

void ServoLoop::keepAlive() noexcept
{
  implementation_->heartbeat();
}

ServoSample ServoLoop::latest() const noexcept
{
  return implementation_->newest.read();
}

ServoStatistics ServoLoop::statistics() const noexcept
{
  const Implementation& self = *implementation_;
  ServoStatistics result = self.statistics.read();
  result.lostTraceSamples = self.trace.lost();
  result.jitter = self.jitter.summary();
  result.update = self.update.summary();
  return result;
}

void ServoLoop::takeTrace(std::vector<ServoSample>& samples)
{
  implementation_->heartbeat();
  implementation_->trace.take(samples);
  const std::lock_guard<std::mutex> lock(implementation_->publishing);
  implementation_->scenes.collect();
}

void ServoLoop::takeInputs(ServoInputs& inputs)
{
  const std::lock_guard<std::mutex> lock(implementation_->publishing);
  ServoInputs& taken = implementation_->inputs;
  const auto move = [](auto& from, auto& to)
  {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    from.clear();
  };
  move(taken.scenes, inputs.scenes);
  move(taken.parameters, inputs.parameters);
}

void ServoLoop::beginAnew() noexcept
{
  implementation_->beginsAnew.store(true, std::memory_order_relaxed);
}

ForceLimit ServoLoop::forceLimit() const noexcept
{
  return implementation_->forceLimit;
}

std::int64_t ServoLoop::origin() const noexcept
{
  return implementation_->origin.load(std::memory_order_relaxed);
}

const ServoStepSettings& ServoLoop::stepSettings() const noexcept
{
  return implementation_->stepSettings;
}

} // namespace pointhaptics
