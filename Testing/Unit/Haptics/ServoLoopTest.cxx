#include "ServoLoopFixtures.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::trial;

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
  // The tick after a read of 10 ms comes 9.5 ms after its deadline, whatever the machine does.
  port.onRead = [](int n)
  {
    if (n == 50)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  };
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
  EXPECT_EQ(samples.back().tick, statistics.ticks + statistics.deadlineMisses)
    << "a skipped tick is a counted one";
  EXPECT_EQ(statistics.update.count, statistics.ticks);
  EXPECT_EQ(statistics.jitter.count, statistics.ticks);
  EXPECT_GE(statistics.deadlineMisses, 18u);
  EXPECT_GE(statistics.jitter.maximum, 0.009);
  EXPECT_GE(statistics.update.maximum, 0.01);
  EXPECT_GT(statistics.rateHz, 0.0);
  EXPECT_LE(statistics.rateHz, 2100.0);
  EXPECT_EQ(statistics.deviceFaults, 0u);
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

/// Flags that the readers of a loop share with the thread that starts and stops it.
struct Watch
{
  std::atomic<bool> done{ false };
  std::atomic<int> runs{ 0 }; // Odd while the loop runs.
  std::atomic<int> compared{ 0 };
};

/// Expects whole samples and counters that only grow within a run, until the watch is done.
void readUntilDone(const ServoLoop& loop, const ScriptedPort& port, Watch& watch)
{
  int lastRun = 0;
  std::uint64_t lastTick = 0;
  std::uint64_t lastCount = 0;
  while (!watch.done)
  {
    const int run = watch.runs;
    const ServoSample sample = loop.latest();
    const ServoStatistics statistics = loop.statistics();
    if (sample.tick > 0)
    {
      EXPECT_EQ(sample.state.hip, port.path(sample.timeSeconds)) << "torn at tick " << sample.tick;
    }
    if (run % 2 == 1 && run == watch.runs)
    {
      EXPECT_GE(sample.tick, run == lastRun ? lastTick : 0);
      EXPECT_GE(statistics.ticks, run == lastRun ? lastCount : 0);
      lastRun = run;
      lastTick = sample.tick;
      lastCount = statistics.ticks;
      watch.compared += sample.tick > 0 ? 1 : 0;
    }
    std::this_thread::yield();
  }
}

TEST(ServoLoop, IsReadByManyThreadsWhileItRunsAndRestarts)
{
  ScriptedPort port;
  // Elsewhere in each tick: the parts of a sample tell whether they belong together.
  port.path = [](double t) { return press(t) + Vec3(0.001 * t, -0.002 * t, 0.0); };
  ServoLoop loop;
  Watch watch;
  ServoSettings settings = plainSettings();
  settings.rateHz = 10000.0;
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i)
  {
    readers.emplace_back([&] { readUntilDone(loop, port, watch); });
  }
  for (int round = 0; round < 3; ++round)
  {
    ASSERT_EQ(loop.start(port, HapticParameters(), settings), Status::Ok);
    ++watch.runs;
    for (int i = 0; i < 5; ++i)
    {
      loop.publishScene(plane());
      EXPECT_EQ(loop.setParameters(HapticParameters()), Status::Ok);
      const std::uint64_t before = loop.statistics().ticks;
      EXPECT_TRUE(eventually([&] { return loop.statistics().ticks > before; }));
    }
    const int before = watch.compared;
    EXPECT_TRUE(eventually([&] { return watch.compared > before + 20000; })) << "nobody reads";
    ++watch.runs;
    loop.stop();
  }
  watch.done = true;
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

TEST(ServoLoop, RestsOnlyWhileAStillHandTouchesNothing)
{
  std::atomic<double> height{ 0.01 };
  std::atomic<bool> trembles{ false };
  ScriptedPort port;
  port.path = [&](double t) { return Vec3(0.0, 0.0, height + (trembles ? 1e-6 * std::sin(1e3 * t) : 0.0)); };
  ServoSettings settings;
  settings.realtimePriority = false;
  settings.idlesWhenStill = true;
  ServoLoop loop;
  loop.publishScene(plane());
  ASSERT_EQ(loop.start(port, {}, settings), Status::Ok);
  const auto idle = [&] { return loop.statistics().idleTicks; };
  const auto ticksLater = [&](std::uint64_t more)
  {
    const std::uint64_t wanted = loop.statistics().ticks + more;
    return eventually([&, wanted] { return loop.statistics().ticks >= wanted; });
  };
  ASSERT_TRUE(eventually([&] { return idle() > 0; }));
  // Ticks that were left out have their numbers, and are not missed.
  EXPECT_GE(loop.latest().tick, loop.statistics().ticks + idle());
  trembles = true;
  ASSERT_TRUE(ticksLater(2));
  std::uint64_t before = idle();
  ASSERT_TRUE(ticksLater(600));
  EXPECT_EQ(idle(), before);
  trembles = false;
  height = -0.001;
  ASSERT_TRUE(eventually([&] { return loop.latest().state.contact; }));
  before = idle();
  ASSERT_TRUE(ticksLater(700));
  EXPECT_EQ(idle(), before);
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

TEST(ServoLoop, TakesAPublishedSceneBeforeItReadsTheHand)
{
  // The step that is prefetched before the deadline is one in that scene.
  constexpr int kPublished = 30;
  const std::shared_ptr<const HapticScene> first = plane();
  const std::shared_ptr<const HapticScene> second = plane();
  ScriptedPort port;
  port.readStatus = [](int n) { return n < 2 * kPublished ? Status::Ok : Status::EndOfPath; };
  ServoLoop loop;
  port.onRead = [&](int n)
  {
    if (n == kPublished)
    {
      loop.publishScene(second);
    }
  };
  loop.publishScene(first);
  ASSERT_EQ(loop.start(port, {}, plainSettings()), Status::Ok);
  ASSERT_TRUE(eventually([&] { return !loop.running(); }));
  std::vector<ServoSample> samples;
  loop.takeTrace(samples);
  ASSERT_GT(samples.size(), std::size_t(kPublished + 1));
  EXPECT_EQ(samples[kPublished].scene, first->number()) << "it came after the updates of that tick";
  EXPECT_EQ(samples[kPublished + 1].scene, second->number());
}
