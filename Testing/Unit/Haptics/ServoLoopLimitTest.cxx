// Springs that the loop refuses, forces that it limits and takes away.
#include "ServoLoopFixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::trial;

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
  for (double early : { -1e-6, 1.1e-3, std::nan("") })
  {
    EXPECT_EQ(startWith([=](auto& s, auto&) { s.wakeEarlySeconds = early; }), Status::InvalidParameter)
      << early;
  }
  EXPECT_EQ(startWith([](auto&, auto& p) { p.contact.stiffness = -1.0; }), Status::InvalidParameter);
  EXPECT_FALSE(loop.running());
  EXPECT_EQ(port.reads, 0);
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
  ASSERT_TRUE(eventually([&] { return norm(loop.latest().state.force) > 0.25 - 1e-9; }));
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

TEST(ServoLoop, PushesNoHarderThanTheLeastOfThreeLimits)
{
  struct Case
  {
    double device, user, program, expected;
    const char* name;
  };
  for (const Case& each : { Case{ 0.5, 8.0, 8.0, 0.5, "device" }, Case{ 2.0, 1e9, 1e9, 2.0, "device" },
         Case{ 20.0, INFINITY, 1e9, 8.0, "program" }, Case{ 20.0, 1.0, INFINITY, 1.0, "user" },
         Case{ 4.0, 6.0, 0.25, 0.25, "program" }, Case{ INFINITY, 8.0, INFINITY, 8.0, "program" } })
  {
    ScriptedPort port;
    port.declared = each.device;
    double largest = 0.0;
    port.onWrite = [&largest](double force) { largest = std::max(largest, force); };
    port.path = [](double time) { return Vec3{ 0.0, 0.0, std::max(-0.004, 0.001 - 0.2 * time) }; };
    ServoSettings settings = plainSettings();
    settings.limits = { each.program, INFINITY };
    HapticParameters parameters;
    parameters.contact.stiffness = 1e4;
    parameters.contact.forceLimit = each.user;
    ServoLoop loop;
    loop.publishScene(plane());
    ASSERT_EQ(loop.start(port, parameters, settings), Status::Ok);
    EXPECT_EQ(loop.forceLimit().newtons(), each.expected);
    EXPECT_STREQ(loop.forceLimit().name(), each.name);
    ASSERT_TRUE(eventually([&] { return loop.latest().timeSeconds > 0.06; }));
    // Whatever is asked for later.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> exponent(-1.0, 1.0);
    for (int i = 0; i < 40; ++i)
    {
      parameters.contact.stiffness = 1e4 * std::pow(10.0, exponent(random));
      parameters.contact.damping = std::pow(10.0, 2.0 * exponent(random));
      parameters.contact.staticFriction = parameters.contact.dynamicFriction =
        std::pow(10.0, exponent(random));
      parameters.contact.forceLimit = each.user * std::pow(10.0, exponent(random) + 1.0);
      parameters.method = ProxyMethod(i % 3);
      EXPECT_EQ(loop.setParameters(parameters), Status::Ok);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    loop.stop();
    const double most = std::min({ each.device, each.program, kMostServoForce });
    EXPECT_LE(largest, most) << each.name;
    EXPECT_GT(largest, 0.9 * each.expected) << each.name;
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
  const auto scene = plane();
  loop.publishScene(scene);
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
  const auto isAway = [&]
  {
    loop.publishScene(scene); // by a thread that follows the hand
    return loop.latest().state.force.z == 0.0;
  };
  EXPECT_TRUE(eventually(isAway)) << "nobody said anything";
  EXPECT_TRUE(loop.latest().state.contact) << "the touch itself goes on";
  EXPECT_GT(loop.statistics().staleTicks, 0u);
  EXPECT_TRUE(aliveUntil([&] { return loop.latest().state.force.z > 0.79; })) << "and comes back with life";
  loop.stop();
}
