// The loop when device, machine or system fail it.
#include "ServoLoopFixtures.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::trial;

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
  ASSERT_TRUE(eventually([&] { return loop.statistics().deadlineMisses >= 200; }));
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

TEST(ServoLoop, ReportsWhatTheSystemRefuses)
{
  ScriptedPort port;
  ServoLoop loop;
  ServoSettings settings;
  settings.lockMemory = true;
  settings.keepCoresAwake = true;
  ASSERT_EQ(loop.start(port, HapticParameters(), settings), Status::Ok);
  ASSERT_TRUE(eventually([&] { return loop.latest().tick > 0; }));
  const ServoStatistics statistics = loop.statistics();
  loop.stop();
  EXPECT_EQ(statistics.realtime, statistics.realtimeRefusal == 0);
  const std::string text = describeRefusals(statistics);
  EXPECT_EQ(text.find("rtprio") != std::string::npos, !statistics.realtime);
  EXPECT_EQ(text.find("memlock") != std::string::npos, statistics.memoryRefusal != 0);
  EXPECT_EQ(text.find("cpu_dma_latency") != std::string::npos, statistics.awakeRefusal != 0);
  EXPECT_TRUE(describeRefusals(ServoStatistics()).empty());
  ServoStatistics refused;
  refused.realtimeRefusal = 1;
  refused.memoryRefusal = 1;
  refused.awakeRefusal = 13;
  EXPECT_NE(describeRefusals(refused).find("rtprio 40"), std::string::npos);
  EXPECT_NE(describeRefusals(refused).find("memlock unlimited"), std::string::npos);
  EXPECT_NE(describeRefusals(refused).find("/dev/cpu_dma_latency"), std::string::npos);
}

/// A recording is taken as a path by these flags.
TEST(ServoStep, SaysInTheSampleWhereTheHandIsTakenAsNew)
{
  const std::shared_ptr<const HapticScene> scene = plane();
  const auto flagsAt = [&scene](std::uint64_t number, int failures)
  {
    ServoStep step;
    step.setScene(scene.get());
    ServoSample sample;
    const auto tick = [&](std::uint64_t n, Status reading, double z)
    {
      TickInput input;
      input.number = n;
      input.reading = reading;
      input.hand.position = { 0.0, 0.0, z };
      step.step(input, sample);
      step.finish(input, Status::Ok, sample);
    };
    tick(1, Status::Ok, 0.005);
    EXPECT_EQ(sample.tickFlags & kTickNewHand, 0u);
    for (int i = 0; i < failures; ++i)
    {
      tick(2 + std::uint64_t(i), Status::DeviceLost, 0.0);
    }
    tick(number, Status::Ok, -0.001);
    EXPECT_NE(sample.state.contact, (sample.tickFlags & kTickNewHand) != 0) << number;
    return sample.tickFlags & kTickNewHand;
  };
  EXPECT_EQ(flagsAt(2, 0), 0u);
  EXPECT_EQ(flagsAt(1001, 0), 0u);
  EXPECT_NE(flagsAt(1003, 0), 0u) << "stood still for more than 1 s";
  EXPECT_EQ(flagsAt(52, 50), 0u);
  EXPECT_NE(flagsAt(152, 150), 0u) << "no reading for more than 0.1 s";
}
