/// @file
/// The 1 kHz thread: reads the hand, steps the proxy, guards the force, writes it, publishes the
/// sample.
#pragma once

#include "Core/Base/Lifetime.h"
#include "Haptics/HapticPort.h"
#include "Haptics/Proxy.h"
#include "Haptics/SceneOrigin.h"
#include "Haptics/Servo/ForceGuard.h"
#include "Haptics/Servo/ForceLimit.h"
#include "Haptics/Servo/LatencyHistogram.h"
#include "Haptics/Servo/ServoSample.h"
#include "Haptics/Servo/ServoStep.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointhaptics
{

/// How a servo loop runs: rate, priority, watchdog, trace and force limits.
struct ServoSettings
{
  double rateHz = 1000.0;       ///< 1 to 10000.
  bool realtimePriority = true; ///< Ask for SCHED_FIFO for this thread; a refusal is reported, not an error.
  bool lockMemory = false;      ///< Ask that the process stays in memory (mlockall); a refusal is reported.
  /// Ask that no core falls asleep while the loop runs (/dev/cpu_dma_latency), so that ticks find the core
  /// awake and its caches full; costs power. A refusal is reported.
  bool keepCoresAwake = false;
  /// The thread wakes so long before each deadline, prefetches its step (Proxy::prefetch()) in the newest
  /// scene and spins until the deadline: neither the time to wake up nor cold caches are the tick's then. 0
  /// to 1e-3, at most a half of the period is used; 0: sleep until the deadline. Costs that part of one core,
  /// 10 % at 1 kHz.
  double wakeEarlySeconds = 1e-4;
  double watchdogSeconds = 0.0; ///< Without a heartbeat (ServoLoop::keepAlive()) for so long the force is
                                ///< taken away; 0: never. 0 to 3600.
  int traceCapacity = 1 << 15; ///< Ticks kept until takeTrace(), 1 to 2^22 (200 bytes each); what comes while
                               ///< the trace is full is lost and counted.
  bool idlesWhenStill = false; ///< Where the port allows it (HapticPort::mayIdle()): after half a second in
                               ///< which the hand stood still and touched nothing and no update came, only
                               ///< every fiftieth of a second is a tick, until that changes.
  ForceLimits limits;
};

/// Counts and times of a servo loop since start(): ticks, deadline misses, faults.
struct ServoStatistics
{
  std::uint64_t ticks = 0;
  std::uint64_t deadlineMisses =
    0; ///< Deadlines already followed by the next one when the thread woke; skipped.
  std::uint64_t deviceFaults = 0; ///< Ticks in which read() or write() failed.
  std::uint64_t waitingTicks = 0; ///< Ticks in which the device was not ready (starting, not homed).
  std::uint64_t idleTicks = 0;    ///< Deadlines passed over while the loop was idle.
  std::uint64_t staleTicks = 0;   ///< Ticks without a heartbeat for longer than the watchdog allows.
  std::uint64_t lostTraceSamples = 0;
  double rateHz = 0.0; ///< Achieved between the first and the newest tick since start(); idle ticks count
                       ///< as ticks.
  LatencyHistogram::Summary jitter; ///< Wake-up after the deadline, seconds.
  LatencyHistogram::Summary update; ///< Duration of a tick's work, seconds.
  bool realtime = false;            ///< SCHED_FIFO was granted.
  int realtimeRefusal = 0;          ///< errno of a refused SCHED_FIFO; 0: granted or not asked for.
  int memoryRefusal = 0;            ///< errno of a refused mlockall; 0: granted or not asked for.
  int awakeRefusal = 0;             ///< errno of refused keepCoresAwake; 0: granted or not asked for.
};

/// A scene as it was published: enough to make it again where its cloud is.
struct PublishedScene
{
  static PublishedScene of(const HapticScene* scene);

  std::uint64_t number = 0; ///< HapticScene::number(); 0: no scene.
  AffineTransform modelToWorkspace;
  std::uint64_t cloud = 0;                   ///< HapticScene::cloudNumber().
  std::shared_ptr<const SceneOrigin> origin; ///< Origin of the cloud; null: not known.
};

/// Parameters that a servo loop was given.
struct PublishedParameters
{
  std::uint64_t number = 0; ///< As ServoSample::parameters names them.
  HapticParameters parameters;
};

/// Scenes and parameters that a servo loop was given, oldest first.
struct ServoInputs
{
  std::vector<PublishedScene> scenes;
  std::vector<PublishedParameters> parameters;
};

/// One sentence for each request that the system refused, with the cure; empty where nothing was refused.
std::string describeRefusals(const ServoStatistics& statistics);

/// Deadlines are absolute times of the steady clock, one period apart; the thread sleeps until shortly before
/// each (ServoSettings::wakeEarlySeconds), and takes the newest scene and parameters then. A tick: read the
/// device, step the proxy, guard the force, write it, publish the sample. No step of it allocates, locks,
/// logs or throws.
///
/// Faults: a tick whose read() fails sends zero force and steps nothing, and the force grows again from zero
/// under the guard's slew limit. The proxy keeps its side of the surface over a short fault; after one of 0.1
/// s or more, after a stall of the machine of 1 s, and where the device found it anew (HandState::isNew), the
/// hand is taken as new, in free space.
/// DeviceNotReady is answered the same way and counted apart. EndOfPath from read() ends the loop: zero
/// force, then running() is false.
///
/// Springs that the port cannot render without giving energy to the hand (HapticPort::limits()) are refused
/// by start() and setParameters(). When the loop stops, and when the watchdog hears no heartbeat of the
/// program, the force goes to zero over the port's rampDownSeconds; with the next heartbeat it comes back
/// over its rampUpSeconds.
///
/// Thread safety: start, stop, setParameters, setClutched, takeTrace, keepAlive from one thread (the GUI's);
/// publishScene from any one thread at a time; latest(), statistics() and running() from any. None of them
/// makes the servo thread wait.
class ServoLoop
{
public:
  ServoLoop();
  ~ServoLoop(); ///< Stops.
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  /// Starts the thread on @p port, which must be open and outlive stop(). Statistics and trace start anew; a
  /// published scene stays. InvalidParameter: a setting, limit or parameter out of range, or already running.
  /// NotPassive, RateNotSupported: the port cannot render this; @p message, where given, names the limit.
  /// Throws std::system_error or std::bad_alloc where the system has no thread or memory to give.
  Status start(HapticPort& port, const HapticParameters& parameters, const ServoSettings& settings = {},
    std::string* message = nullptr);
  /// Takes the force away over the port's rampDownSeconds, writes zero force, joins; waits that long and two
  /// periods at most. Safe to call twice.
  void stop();
  /// Instead of start(): the samples are those of feed(), as of a replay, and nothing is felt here.
  /// Statistics and trace start anew; stop() ends it. InvalidParameter: already running.
  Status startFed(const ServoStepSettings& settings, int traceCapacity = ServoSettings().traceCapacity);
  /// The newest tick, from one thread, between startFed() and stop(). Does not wait.
  void feed(const ServoSample& sample) noexcept;
  /// False before start(), after stop() and after the end of a path.
  bool running() const noexcept;

  /// The servo thread takes the scene when it wakes for its next tick; the one before is freed here at a
  /// later call, never there.
  void publishScene(std::shared_ptr<const HapticScene> scene);
  /// Taken as a scene is. InvalidParameter, NotPassive: nothing changes; @p message, where given, names
  /// the limit.
  Status setParameters(const HapticParameters& parameters, std::string* message = nullptr);
  /// While true the hand holds the model instead of feeling it: the force goes to zero over the port's
  /// rampDownSeconds, at least kClutchDownSeconds, and stays there. After setClutched(false) it comes back
  /// over rampUpSeconds, at least kClutchUpSeconds, in the newest scene published before that call. The proxy
  /// steps on, so that a surface the hand holds stays on its side. start() begins unclutched.
  void setClutched(bool clutched) noexcept;
  static constexpr double kClutchDownSeconds = 0.05;
  static constexpr double kClutchUpSeconds = 0.3;
  /// The heartbeat of the program, for the watchdog. setParameters() and takeTrace() are one too;
  /// publishScene() is not: threads that follow the hand go on where the program hangs.
  void keepAlive() noexcept;

  /// The newest finished tick; tick 0 means none yet.
  ServoSample latest() const noexcept;
  ServoStatistics statistics() const noexcept;
  /// Moves all ticks since the last call to the end of @p samples, oldest first.
  void takeTrace(std::vector<ServoSample>& samples);
  /// Moves what was published since the last call to the end of @p inputs, the scene and the parameters in
  /// use included where this is the first call. What a sample of takeTrace() names was published before that
  /// call. The 10,000 newest of either are kept. Thread: that of takeTrace().
  void takeInputs(ServoInputs& inputs);
  /// From the next tick on in which the hand touches nothing and no force is held back, the proxy forgets
  /// what was before (ServoSample::tickFlags, kTickBegins): from there on the forces can be computed again
  /// from samples and inputs. The hand feels nothing of it. The first tick after start() is such a one.
  void beginAnew() noexcept;
  /// Settings of a running loop that a replay of its ticks needs.
  const ServoStepSettings& stepSettings() const noexcept;
  /// Limit that no force since start() or setParameters() has exceeded, and whose limit it is. Thread: that
  /// of start() and setParameters().
  ForceLimit forceLimit() const noexcept;
  /// steady_clock's nanoseconds at which the time of the samples is 0; 0 before the thread runs.
  std::int64_t origin() const noexcept;
  /// For those who point to the loop without owning it, such as threads that publish scenes.
  const Lifetime& lifetime() const noexcept { return lifetime_; }

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
  Lifetime lifetime_;
};

} // namespace pointhaptics
