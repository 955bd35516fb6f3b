#include "Haptics/ServoLoop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <thread>

using namespace pointhaptics;

namespace
{
/// What the test's device does; every member is set before start() or is atomic.
class ScriptedPort : public HandPort
{
public:
  std::function<Vec3(double)> path = [](double) { return Vec3(); };
  std::function<Status(int)> readStatus = [](int) { return Status::Ok; }; ///< Of the n-th read, from 0.
  std::function<Status(int)> writeStatus = [](int) { return Status::Ok; };
  std::function<void(int)> onRead = [](int) {};
  HandLimits bounds; ///< What limits() says.

  std::atomic<int> reads{ 0 };
  std::atomic<int> writes{ 0 };
  std::atomic<double> lastForce{ -1.0 };
  std::atomic<bool> forceAfterFault{ false }; ///< A write after a failed read carried a force.

  Status read(double timeSeconds, HandState& state) noexcept override
  {
    const int n = reads.fetch_add(1);
    onRead(n);
    const Status status = readStatus(n);
    failed_ = status != Status::Ok;
    state.position = path(timeSeconds);
    state.buttons = 5;
    return status;
  }
  Status write(double, const Vec3& force) noexcept override
  {
    lastForce = norm(force);
    forceAfterFault = forceAfterFault || (failed_ && norm(force) != 0.0);
    return writeStatus(writes.fetch_add(1));
  }

  HandLimits limits() const noexcept override { return bounds; }
  bool mayRest() const noexcept override { return true; }

private:
  bool failed_ = false;
};

/// Waits for a condition, not for a time: a busy machine only makes the test slower.
bool eventually(const std::function<bool()>& condition)
{
  for (int i = 0; i < 60000; ++i)
  {
    if (condition())
    {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

/// A plane z = 0 of 0.5 mm spacing, 20 mm wide.
std::shared_ptr<const HapticScene> plane()
{
  HapticSceneInput input;
  for (int i = -20; i <= 20; ++i)
  {
    for (int j = -20; j <= 20; ++j)
    {
      input.points.push_back({ 0.0005 * i, 0.0005 * j, 0.0 });
    }
  }
  input.cellSize = 0.0005;
  Status status = Status::Ok;
  return HapticScene::create(std::move(input), status);
}

ServoSettings plainSettings()
{
  ServoSettings settings;
  settings.realtimePriority = false;
  return settings;
}

/// From 5 mm above the plane to 1 mm below it within 60 ms, then still.
Vec3 press(double timeSeconds)
{
  return { 0.0, 0.0, std::max(-0.001, 0.005 - 0.1 * timeSeconds) };
}
}

TEST(ServoLoop, RefusesSettingsOutOfRange)
{
  ScriptedPort port;
  ServoLoop loop;
  const auto startWith = [&](const std::function<void(ServoSettings&, HapticParameters&)>& change)
  {
    ServoSettings settings = plainSettings();
    HapticParameters parameters;
    change(settings, parameters);
    return loop.start(port, parameters, settings);
  };
  const double infinity = std::numeric_limits<double>::infinity();
  for (double rate : { 0.0, -1.0, 0.5, 10001.0, infinity, std::nan("") })
  {
    EXPECT_EQ(startWith([=](auto& s, auto&) { s.rateHz = rate; }), Status::InvalidParameter) << rate;
  }
  EXPECT_EQ(startWith([](auto& s, auto&) { s.traceCapacity = 0; }), Status::InvalidParameter);
  EXPECT_EQ(startWith([](auto& s, auto&) { s.limits.maximumForce = -1.0; }), Status::InvalidParameter);
  EXPECT_EQ(startWith([](auto& s, auto&) { s.watchdogSeconds = -1.0; }), Status::InvalidParameter);
  EXPECT_EQ(startWith([](auto&, auto& p) { p.contact.stiffness = -1.0; }), Status::InvalidParameter);
  EXPECT_FALSE(loop.running());
  EXPECT_EQ(port.reads, 0);
}

TEST(ServoLoop, StartsStopsAndStartsAgain)
{
  ScriptedPort port;
  ServoLoop loop;
  EXPECT_EQ(loop.latest().tick, 0u);
  loop.stop();
  for (int round = 0; round < 3; ++round)
  {
    ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
    EXPECT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::InvalidParameter)
      << "already running";
    ASSERT_TRUE(eventually([&] { return loop.latest().tick >= 5; }));
    EXPECT_TRUE(loop.running());
    loop.stop();
    loop.stop();
    EXPECT_FALSE(loop.running());
  }
}

TEST(ServoLoop, TicksAreNumberedAndTimedByTheirDeadlines)
{
  ScriptedPort port;
  ServoLoop loop;
  ServoSettings settings = plainSettings();
  settings.rateHz = 2000.0;
  ASSERT_EQ(loop.start(port, HapticParameters(), settings), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.statistics().ticks >= 100; }));
  loop.stop();
  std::vector<ServoSample> samples;
  loop.takeTrace(samples);
  const ServoStatistics statistics = loop.statistics();
  ASSERT_EQ(samples.size(), statistics.ticks);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    EXPECT_DOUBLE_EQ(samples[i].timeSeconds, double(samples[i].tick - 1) / 2000.0);
    EXPECT_GT(samples[i].tick, i > 0 ? samples[i - 1].tick : 0);
    EXPECT_EQ(samples[i].buttons, 5u);
  }
  EXPECT_EQ(samples.back().tick, statistics.ticks + statistics.missedTicks)
    << "a skipped tick is a counted one";
  EXPECT_EQ(statistics.update.count, statistics.ticks);
  EXPECT_EQ(statistics.lateness.count, statistics.ticks);
  EXPECT_GE(statistics.lateness.maximum, 0.0);
  EXPECT_GT(statistics.rateHz, 0.0);
  EXPECT_LE(statistics.rateHz, 2100.0);
  EXPECT_EQ(statistics.deviceFaults, 0u);
}

TEST(ServoLoop, SkipsAndCountsTicksThatASlowDeviceHasMissed)
{
  ScriptedPort port;
  port.onRead = [](int n)
  {
    if (n == 3)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  };
  ServoLoop loop;
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.statistics().ticks >= 10; }));
  loop.stop();
  EXPECT_GE(loop.statistics().missedTicks, 18u);
  EXPECT_GE(loop.statistics().update.maximum, 0.02);
}

TEST(ServoLoop, PushesAgainstAPlaneAndStopsWithZeroForce)
{
  ScriptedPort port;
  port.path = press;
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().timeSeconds > 0.08; }));
  const ServoSample sample = loop.latest();
  EXPECT_TRUE(sample.state.contact);
  EXPECT_NEAR(sample.state.force.z, 0.8, 0.02);
  loop.stop();
  EXPECT_EQ(port.lastForce, 0.0);
}

TEST(ServoLoop, TakesParametersAndScenesWhileItRuns)
{
  ScriptedPort port;
  port.path = press;
  ServoLoop loop;
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().tick > 0; }));
  EXPECT_TRUE(loop.latest().state.status & kProxyNoScene);
  loop.stop();

  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().state.force.z > 0.5; }));
  HapticParameters soft;
  soft.contact.stiffness = 100.0;
  EXPECT_EQ(loop.setParameters(soft), Status::Ok);
  EXPECT_TRUE(eventually([&] { return std::abs(loop.latest().state.force.z - 0.1) < 0.01; }));
  loop.publishScene(nullptr);
  EXPECT_TRUE(eventually([&] { return (loop.latest().state.status & kProxyNoScene) != 0; }));
  loop.stop();
}

TEST(ServoLoop, FreesAReplacedSceneWhileItRuns)
{
  ScriptedPort port;
  ServoLoop loop;
  std::shared_ptr<const HapticScene> first = plane();
  const std::weak_ptr<const HapticScene> watched = first;
  loop.publishScene(std::move(first));
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().tick > 0; }));
  loop.publishScene(plane());
  std::vector<ServoSample> samples;
  EXPECT_TRUE(eventually(
    [&]
    {
      samples.clear();
      loop.takeTrace(samples);
      return watched.expired();
    }));
  loop.stop();
}

TEST(ServoLoop, AnswersAFailedReadWithZeroForceAndCountsIt)
{
  ScriptedPort port;
  port.path = press;
  port.readStatus = [](int n) { return n % 3 == 1 ? Status::DeviceNotOpen : Status::Ok; };
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.statistics().ticks >= 60 && loop.latest().timeSeconds > 0.08; }));
  EXPECT_TRUE(loop.running()) << "a fault is a state, not an end";
  EXPECT_TRUE(eventually([&] { return loop.latest().state.force.z > 0.7; }))
    << "contact outlives a short fault";
  loop.stop();
  EXPECT_GE(loop.statistics().deviceFaults, 19u);
  EXPECT_FALSE(port.forceAfterFault);
}

TEST(ServoLoop, TakesTheHandAsNewAfterALongSilence)
{
  ScriptedPort port;
  port.path = press;
  std::atomic<bool> silent{ false };
  port.readStatus = [&](int) { return silent ? Status::DeviceNotOpen : Status::Ok; };
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().state.force.z > 0.7; }));
  silent = true;
  const std::uint64_t faults = loop.statistics().deviceFaults;
  ASSERT_TRUE(eventually([&] { return loop.statistics().deviceFaults > faults + 150; }));
  silent = false;
  const std::uint64_t tick = loop.latest().tick;
  ASSERT_TRUE(eventually([&] { return loop.latest().tick > tick + 20; }));
  EXPECT_FALSE(loop.latest().state.contact) << "no force before the hand has come to the surface again";
  loop.stop();
}

TEST(ServoLoop, KeepsTheHandOnItsSideWhenTheMachineStoodStill)
{
  ScriptedPort port;
  port.path = press;
  std::atomic<bool> stall{ false };
  port.onRead = [&](int)
  {
    if (stall.exchange(false))
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(250));
    }
  };
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().state.force.z > 0.7; }));
  stall = true;
  ASSERT_TRUE(eventually([&] { return loop.statistics().missedTicks >= 200; }));
  const std::uint64_t tick = loop.latest().tick;
  ASSERT_TRUE(eventually([&] { return loop.latest().tick > tick + 5; }));
  EXPECT_GT(loop.latest().state.force.z, 0.7) << "a wall does not vanish because a computer was busy";
  loop.stop();
}

TEST(ServoLoop, CountsAFailedWriteAndReportsZeroForce)
{
  ScriptedPort port;
  port.path = press;
  port.writeStatus = [](int) { return Status::DeviceNotOpen; };
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().timeSeconds > 0.08; }));
  EXPECT_EQ(norm(loop.latest().state.force), 0.0);
  loop.stop();
  EXPECT_EQ(loop.statistics().deviceFaults, loop.statistics().ticks);
}

TEST(ServoLoop, EndsByItselfAtTheEndOfThePath)
{
  ScriptedPort port;
  port.path = press;
  port.readStatus = [](int n) { return n < 70 ? Status::Ok : Status::EndOfPath; };
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  EXPECT_TRUE(eventually([&] { return !loop.running(); }));
  EXPECT_EQ(port.lastForce, 0.0);
  EXPECT_EQ(loop.statistics().ticks, 70u);
  EXPECT_EQ(loop.statistics().deviceFaults, 0u);
  EXPECT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok)
    << "may start again without stop()";
}

TEST(ServoLoop, KeepsItsForceLimitsWhateverTheProxySays)
{
  ScriptedPort port;
  port.path = press;
  ServoSettings settings = plainSettings();
  settings.limits.maximumForce = 0.25;
  settings.limits.maximumSlewRate = 20.0;
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, HapticParameters(), settings), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().timeSeconds > 0.15; }));
  loop.stop();
  std::vector<ServoSample> samples;
  loop.takeTrace(samples);
  double last = 0.0;
  double largest = 0.0;
  for (const ServoSample& sample : samples)
  {
    const double force = norm(sample.state.force);
    EXPECT_LE(force, last + 0.02 + 1e-12) << sample.tick;
    largest = std::max(largest, force);
    last = force;
  }
  EXPECT_NEAR(largest, 0.25, 1e-9);
}

TEST(ServoLoop, CountsWhatAFullTraceLoses)
{
  ScriptedPort port;
  ServoSettings settings = plainSettings();
  settings.traceCapacity = 8;
  ServoLoop loop;
  ASSERT_EQ(loop.start(port, HapticParameters(), settings), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.statistics().lostTraceSamples >= 5; }));
  loop.stop();
  std::vector<ServoSample> samples;
  loop.takeTrace(samples);
  EXPECT_EQ(samples.size(), 8u);
  EXPECT_EQ(loop.statistics().lostTraceSamples + 8, loop.statistics().ticks);
}

TEST(ServoLoop, IsReadByManyThreadsWhileItRunsAndRestarts)
{
  ScriptedPort port;
  port.path = press;
  ServoLoop loop;
  std::atomic<bool> done{ false };
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i)
  {
    readers.emplace_back(
      [&]
      {
        while (!done)
        {
          const ServoSample sample = loop.latest();
          const ServoStatistics statistics = loop.statistics();
          EXPECT_EQ(sample.state.hip.x, 0.0);
          EXPECT_LE(statistics.ticks, 1u << 20);
          std::this_thread::yield();
        }
      });
  }
  for (int round = 0; round < 3; ++round)
  {
    ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
    for (int i = 0; i < 5; ++i)
    {
      loop.publishScene(plane());
      EXPECT_EQ(loop.setParameters(HapticParameters()), Status::Ok);
      const std::uint64_t before = loop.statistics().ticks;
      EXPECT_TRUE(eventually([&] { return loop.statistics().ticks > before; }));
    }
    loop.stop();
  }
  done = true;
  for (std::thread& reader : readers)
  {
    reader.join();
  }
}

TEST(ServoLoop, RunsAtRatesFromHalfAKilohertzToTen)
{
  for (double rate : { 500.0, 10000.0 })
  {
    ScriptedPort port;
    ServoLoop loop;
    ServoSettings settings = plainSettings();
    settings.rateHz = rate;
    ASSERT_EQ(loop.start(port, HapticParameters(), settings), Status::Ok);
    ASSERT_TRUE(eventually([&] { return loop.latest().timeSeconds > 0.05; }));
    const ServoSample sample = loop.latest();
    EXPECT_DOUBLE_EQ(sample.timeSeconds, double(sample.tick - 1) / rate);
    loop.stop();
  }
}

TEST(ServoLoop, RefusesSpringsAndRatesBeyondThePortWithTheLimitInTheMessage)
{
  ScriptedPort port;
  port.bounds.damping = 2.5;
  port.bounds.delayTicks = 1.0;
  port.bounds.maximumRateHz = 1000.0;
  ServoLoop loop;
  std::string message;
  HapticParameters parameters;
  parameters.contact.stiffness = 1700.0;
  EXPECT_EQ(loop.start(port, parameters, plainSettings(), &message), Status::NotPassive);
  for (const char* part : { "1700 N/m", "0.00 N s/m", "1000 Hz", "1666 N/m" })
  {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  parameters.contact = { 1000.0, 1.5, 0.0, 0.0 };
  EXPECT_EQ(loop.start(port, parameters, plainSettings(), &message), Status::NotPassive);
  EXPECT_NE(message.find("666 N/m beside"), std::string::npos) << message;
  ServoSettings fast = plainSettings();
  fast.rateHz = 2000.0;
  EXPECT_EQ(loop.start(port, HapticParameters(), fast, &message), Status::RateNotSupported);
  EXPECT_NE(message.find("at most 1000 Hz"), std::string::npos) << message;
  EXPECT_FALSE(loop.running());

  parameters.contact = { 1600.0, 0.0, 0.0, 0.0 };
  ASSERT_EQ(loop.start(port, parameters, plainSettings(), &message), Status::Ok);
  EXPECT_TRUE(message.empty());
  parameters.contact.damping = 1.0;
  EXPECT_EQ(loop.setParameters(parameters, &message), Status::NotPassive);
  EXPECT_NE(message.find("at most 1000 N/m"), std::string::npos) << message;
  parameters.contact.stiffness = 999.0;
  EXPECT_EQ(loop.setParameters(parameters), Status::Ok);
  parameters.contact.stiffness = -1.0;
  EXPECT_EQ(loop.setParameters(parameters), Status::InvalidParameter);
  loop.stop();
}

TEST(ServoLoop, CountsTicksOfADeviceThatIsNotReadyApartFromFaults)
{
  ScriptedPort port;
  port.path = press;
  port.readStatus = [](int n) { return n < 30 ? Status::DeviceNotReady : Status::Ok; };
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.statistics().ticks >= 50; }));
  loop.stop();
  std::vector<ServoSample> samples;
  loop.takeTrace(samples);
  ASSERT_GE(samples.size(), 50u);
  EXPECT_EQ(samples[29].device, Status::DeviceNotReady);
  EXPECT_EQ(samples[30].device, Status::Ok);
  EXPECT_EQ(loop.statistics().waitingTicks, 30u);
  EXPECT_EQ(loop.statistics().deviceFaults, 0u);
  EXPECT_FALSE(port.forceAfterFault);
}

TEST(ServoLoop, TakesTheForceAwaySlowlyWhenItStops)
{
  ScriptedPort port;
  port.path = press;
  port.bounds.rampDownSeconds = 0.06;
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, HapticParameters(), plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().state.force.z > 0.79; }));
  std::vector<ServoSample> samples;
  loop.takeTrace(samples);
  samples.clear();
  loop.stop();
  loop.takeTrace(samples);
  // Pulled back by less than 3 percent of it a tick, to zero: no kick when the program ends.
  double last = 0.8;
  int falling = 0;
  for (const ServoSample& sample : samples)
  {
    EXPECT_GE(sample.state.force.z, last - 0.8 / 60.0 - 1e-3);
    falling += sample.state.force.z < last - 1e-6 ? 1 : 0;
    last = sample.state.force.z;
  }
  EXPECT_GE(falling, 59);
  EXPECT_EQ(last, 0.0);
  EXPECT_EQ(port.lastForce, 0.0);
}

TEST(ServoLoop, TakesTheForceAwayWhenTheProgramGivesNoSignOfLife)
{
  ScriptedPort port;
  port.path = press;
  port.bounds.rampDownSeconds = 0.02;
  port.bounds.rampUpSeconds = 0.02;
  ServoSettings settings = plainSettings();
  settings.watchdogSeconds = 0.05;
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, HapticParameters(), settings), Status::Ok);
  const auto aliveUntil = [&](const std::function<bool()>& condition)
  {
    return eventually(
      [&]
      {
        loop.keepAlive();
        return condition();
      });
  };
  ASSERT_TRUE(aliveUntil([&] { return loop.latest().state.force.z > 0.79; }));
  EXPECT_TRUE(eventually([&] { return loop.latest().state.force.z == 0.0; })) << "nobody said anything";
  EXPECT_TRUE(loop.latest().state.contact) << "the touch itself goes on";
  EXPECT_GT(loop.statistics().staleTicks, 0u);
  EXPECT_TRUE(aliveUntil([&] { return loop.latest().state.force.z > 0.79; })) << "and comes back with life";
  loop.stop();
}

TEST(ServoLoop, TakesTheForceAwayWhileTheHandHoldsTheModelAndGivesItBackSlowly)
{
  ScriptedPort port;
  port.path = press;
  std::atomic<double> largestRise{ 0.0 };
  std::atomic<double> largestFall{ 0.0 };
  double before = 0.0; // the servo thread's
  port.onRead = [&](int)
  {
    const double now = std::max(0.0, port.lastForce.load());
    largestRise = std::max(largestRise.load(), now - before);
    largestFall = std::max(largestFall.load(), before - now);
    before = now;
  };
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, {}, plainSettings()), Status::Ok);
  const double whole = 0.8; // 1 mm at 800 N/m
  ASSERT_TRUE(eventually([&] { return port.lastForce > 0.99 * whole; }));
  loop.setClutched(true);
  ASSERT_TRUE(eventually([&] { return port.lastForce == 0.0; }));
  EXPECT_LT(largestFall, 1.01 * whole / (1000.0 * ServoLoop::kClutchDownSeconds));
  EXPECT_TRUE(loop.latest().state.contact) << "the proxy keeps its side of the surface";
  const int held = port.writes;
  ASSERT_TRUE(eventually([&] { return port.writes > held + 20; }));
  EXPECT_EQ(port.lastForce, 0.0);
  largestRise = 0.0;
  loop.setClutched(false);
  ASSERT_TRUE(eventually([&] { return port.lastForce > 0.99 * whole; }));
  loop.stop();
  EXPECT_LT(largestRise, 1.01 * whole / (1000.0 * ServoLoop::kClutchUpSeconds));
}

TEST(ServoLoop, ReportsWhatTheSystemRefuses)
{
  ScriptedPort port;
  ServoLoop loop;
  ServoSettings settings;
  settings.lockMemory = true;
  ASSERT_EQ(loop.start(port, HapticParameters(), settings), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().tick > 0; }));
  const ServoStatistics statistics = loop.statistics();
  loop.stop();
  EXPECT_EQ(statistics.realtime, statistics.realtimeRefusal == 0);
  EXPECT_EQ(statistics.memoryLocked, statistics.memoryRefusal == 0);
  const std::string text = describeRefusals(statistics);
  EXPECT_EQ(text.find("rtprio") != std::string::npos, !statistics.realtime);
  EXPECT_EQ(text.find("memlock") != std::string::npos, !statistics.memoryLocked);
  EXPECT_TRUE(describeRefusals(ServoStatistics()).empty());
  ServoStatistics refused;
  refused.realtimeRefusal = 1;
  refused.memoryRefusal = 1;
  EXPECT_NE(describeRefusals(refused).find("rtprio 40"), std::string::npos);
  EXPECT_NE(describeRefusals(refused).find("memlock unlimited"), std::string::npos);
}

TEST(ServoLoop, RestsOnlyWhileAStillHandTouchesNothing)
{
  std::atomic<double> height{ 0.01 };
  std::atomic<bool> trembles{ false };
  ScriptedPort port;
  port.path = [&](double t) { return Vec3(0.0, 0.0, height + (trembles ? 1e-6 * std::sin(1e3 * t) : 0.0)); };
  ServoSettings settings;
  settings.realtimePriority = false;
  settings.restsWhenIdle = true;
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, {}, settings), Status::Ok);
  const auto rested = [&] { return loop.statistics().restedTicks; };
  const auto ticksLater = [&](std::uint64_t more)
  {
    const std::uint64_t wanted = loop.statistics().ticks + more;
    return eventually([&, wanted] { return loop.statistics().ticks >= wanted; });
  };
  ASSERT_TRUE(eventually([&] { return rested() > 0; }));
  // Ticks that were left out have their numbers, and are not missed.
  EXPECT_GE(loop.latest().tick, loop.statistics().ticks + rested());
  trembles = true;
  ASSERT_TRUE(ticksLater(2));
  std::uint64_t before = rested();
  ASSERT_TRUE(ticksLater(600));
  EXPECT_EQ(rested(), before);
  trembles = false;
  height = -0.001;
  ASSERT_TRUE(eventually([&] { return loop.latest().state.contact; }));
  before = rested();
  ASSERT_TRUE(ticksLater(700));
  EXPECT_EQ(rested(), before);
  loop.stop();
}

TEST(ServoLoop, CountsTheScenesItTakes)
{
  ScriptedPort port;
  ServoSettings settings;
  settings.realtimePriority = false;
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, {}, settings), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().scenes == 1; }));
  loop.publishScene(plane());
  EXPECT_TRUE(eventually([&] { return loop.latest().scenes == 2; }));
  loop.stop();
}
