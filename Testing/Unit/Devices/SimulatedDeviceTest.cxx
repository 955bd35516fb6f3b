#include "Devices/SimulatedDevice.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

using namespace pointhaptics;

namespace
{
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double readZ(SimulatedDevice& device, double time)
{
  HandState hand;
  EXPECT_EQ(device.read(time, hand), Status::Ok);
  return hand.position.z;
}
}

TEST(SimulatedDevice, IsAtItsStartWhenOpened)
{
  SimulatedHandSettings settings;
  settings.start = { 0.01, 0.02, 0.03 };
  SimulatedDevice device(settings);
  HandState hand;
  EXPECT_EQ(device.read(0.0, hand), Status::DeviceNotOpen);
  EXPECT_EQ(device.write(0.0, Vec3()), Status::DeviceNotOpen);
  ASSERT_EQ(device.open(), Status::Ok);
  device.setButtons(3);
  ASSERT_EQ(device.read(7.0, hand), Status::Ok);
  EXPECT_EQ(hand.position, settings.start);
  EXPECT_EQ(hand.buttons, 3u);
  EXPECT_EQ(device.target(), settings.start);
}

TEST(SimulatedDevice, StepResponseIsRightToOnePercent)
{
  // Critically damped: c^2 = 4 k m. Exact answer for a step of 1 cm.
  SimulatedHandSettings settings;
  settings.gripDamping = 2.0 * std::sqrt(settings.gripStiffness * settings.mass);
  SimulatedDevice device(settings);
  ASSERT_EQ(device.open(), Status::Ok);
  readZ(device, 0.0);
  device.setTarget({ 0.0, 0.0, 0.01 });
  const double omega = std::sqrt(settings.gripStiffness / settings.mass);
  for (int tick = 1; tick <= 500; ++tick)
  {
    const double t = tick / 1000.0;
    const double exact = 0.01 * (1.0 - (1.0 + omega * t) * std::exp(-omega * t));
    ASSERT_NEAR(readZ(device, t), exact, 0.01 * 0.01) << tick;
  }
}

TEST(SimulatedDevice, YieldsToAForceByTheGripsStiffness)
{
  SimulatedDevice device;
  ASSERT_EQ(device.open(), Status::Ok);
  for (int tick = 0; tick < 2000; ++tick)
  {
    readZ(device, tick / 1000.0);
    ASSERT_EQ(device.write(tick / 1000.0, { 0.0, 0.0, 2.0 }), Status::Ok);
  }
  EXPECT_NEAR(readZ(device, 2.0), 2.0 / 200.0, 1e-9);
}

TEST(SimulatedDevice, RestsAgainstAStiffWallAtOneKilohertz)
{
  // The wall is the servo loop's: a force from each reading, held for a millisecond. 4000 N/m is far below
  // the passivity limit 2 b / T = 18,000 N/m; the hand must come to rest at the balance of both springs.
  constexpr double kWall = 4000.0;
  SimulatedHandSettings settings;
  settings.start = { 0.0, 0.0, 0.02 };
  SimulatedDevice device(settings);
  ASSERT_EQ(device.open(), Status::Ok);
  device.setTarget({ 0.0, 0.0, -0.02 });
  double z = 0.0;
  for (int tick = 0; tick < 3000; ++tick)
  {
    z = readZ(device, tick / 1000.0);
    ASSERT_EQ(device.write(tick / 1000.0, { 0.0, 0.0, std::max(0.0, -kWall * z) }), Status::Ok);
    ASSERT_GT(z, -0.01);
  }
  EXPECT_NEAR(z, -0.02 * 200.0 / (200.0 + kWall), 1e-6);
}

TEST(SimulatedDevice, StaysBoundedWhateverForceSpringAndRate)
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> exponent(-4.0, 4.0);
  std::uniform_real_distribution<double> signedUnit(-1.0, 1.0);
  for (int trial = 0; trial < 50; ++trial)
  {
    SimulatedHandSettings settings;
    settings.mass = std::pow(10.0, exponent(random));
    settings.gripStiffness = std::pow(10.0, exponent(random) + 2.0);
    settings.gripDamping = std::pow(10.0, exponent(random));
    SimulatedDevice device(settings);
    ASSERT_EQ(device.open(), Status::Ok);
    double time = 0.0;
    for (int tick = 0; tick < 200; ++tick)
    {
      HandState hand;
      ASSERT_EQ(device.read(time, hand), Status::Ok);
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_LE(std::abs(hand.position[axis]), 0.05);
      }
      const double force = 1e6 * signedUnit(random);
      ASSERT_EQ(device.write(time, { force, -force, force }), Status::Ok);
      device.setTarget({ signedUnit(random), signedUnit(random), signedUnit(random) });
      time += std::pow(10.0, exponent(random));
    }
  }
}

TEST(SimulatedDevice, WithoutYieldIsAtItsTargetWhateverTheForce)
{
  SimulatedHandSettings settings;
  settings.yieldsToForce = false;
  SimulatedDevice device(settings);
  ASSERT_EQ(device.open(), Status::Ok);
  ASSERT_EQ(device.write(0.0, { 5.0, 5.0, 5.0 }), Status::Ok);
  device.setTarget({ 0.01, 0.0, 0.02 });
  EXPECT_EQ(readZ(device, 0.001), 0.02);
}

TEST(SimulatedDevice, IsPlacedWithoutAWayAndSaysSoOnce)
{
  SimulatedDevice device;
  ASSERT_EQ(device.open(), Status::Ok);
  HandState hand;
  ASSERT_EQ(device.read(0.0, hand), Status::Ok);
  device.setTarget({ 0.02, 0.0, 0.0 });
  ASSERT_EQ(device.read(0.01, hand), Status::Ok);
  EXPECT_GT(hand.position.x, 0.0);
  EXPECT_FALSE(hand.isNew);
  device.placeAt({ 0.0, 1.0, 0.03 });
  device.placeAt({ std::nan(""), 0.0, 0.0 });
  EXPECT_EQ(device.target(), Vec3(0.0, 0.05, 0.03));
  ASSERT_EQ(device.read(0.011, hand), Status::Ok);
  EXPECT_EQ(hand.position, Vec3(0.0, 0.05, 0.03));
  EXPECT_TRUE(hand.isNew);
  ASSERT_EQ(device.read(0.012, hand), Status::Ok);
  EXPECT_EQ(hand.position, Vec3(0.0, 0.05, 0.03)) << "it was at rest";
  EXPECT_FALSE(hand.isNew);
}

TEST(SimulatedDevice, ClampsTargetsAndIgnoresThoseThatAreNotFinite)
{
  SimulatedDevice device;
  ASSERT_EQ(device.open(), Status::Ok);
  device.setTarget({ 1.0, -1.0, 0.03 });
  EXPECT_EQ(device.target(), Vec3(0.05, -0.05, 0.03));
  device.setTarget({ std::nan(""), 0.0, 0.0 });
  device.setTarget({ 0.0, kInfinity, 0.0 });
  EXPECT_EQ(device.target(), Vec3(0.05, -0.05, 0.03));
}

TEST(SimulatedDevice, FeelsNoForceThatIsNotFinite)
{
  SimulatedDevice device;
  ASSERT_EQ(device.open(), Status::Ok);
  readZ(device, 0.0);
  EXPECT_EQ(device.write(0.0, { 0.0, 0.0, kInfinity }), Status::InvalidParameter);
  EXPECT_EQ(readZ(device, 0.1), 0.0);
}

TEST(SimulatedDevice, StandsStillWhenTimeDoes)
{
  SimulatedDevice device;
  ASSERT_EQ(device.open(), Status::Ok);
  readZ(device, 1.0);
  device.setTarget({ 0.0, 0.0, 0.04 });
  EXPECT_EQ(readZ(device, 1.0), 0.0);
  EXPECT_EQ(readZ(device, 0.5), 0.0);
  EXPECT_EQ(readZ(device, std::nan("")), 0.0);
  EXPECT_GT(readZ(device, 0.51), 0.0);
}

TEST(SimulatedDevice, RefusesImpossibleHands)
{
  const auto openWith = [](void (*change)(SimulatedHandSettings&))
  {
    SimulatedHandSettings settings;
    change(settings);
    return SimulatedDevice(settings).open();
  };
  EXPECT_EQ(openWith([](SimulatedHandSettings& s) { s.mass = 0.0; }), Status::InvalidParameter);
  EXPECT_EQ(openWith([](SimulatedHandSettings& s) { s.mass = kInfinity; }), Status::InvalidParameter);
  EXPECT_EQ(openWith([](SimulatedHandSettings& s) { s.gripStiffness = -1.0; }), Status::InvalidParameter);
  EXPECT_EQ(
    openWith([](SimulatedHandSettings& s) { s.gripDamping = std::nan(""); }), Status::InvalidParameter);
  EXPECT_EQ(openWith([](SimulatedHandSettings& s) { s.start.x = std::nan(""); }), Status::InvalidParameter);
}

TEST(SimulatedDevice, TakesTargetsFromAnotherThreadWhole)
{
  SimulatedHandSettings settings;
  settings.yieldsToForce = false;
  SimulatedDevice device(settings);
  ASSERT_EQ(device.open(), Status::Ok);
  std::atomic<bool> done{ false };
  std::thread mouse(
    [&]
    {
      for (int i = 0; i < 100000; ++i)
      {
        const double value = (i % 100) * 1e-4;
        device.setTarget({ value, value, value });
      }
      done = true;
    });
  double time = 0.0;
  while (!done)
  {
    HandState hand;
    ASSERT_EQ(device.read(time += 1e-3, hand), Status::Ok);
    ASSERT_EQ(hand.position.x, hand.position.y);
    ASSERT_EQ(hand.position.x, hand.position.z);
  }
  mouse.join();
}

TEST(SimulatedDevice, FollowsAPathAsAPersonWouldAndEndsWithIt)
{
  SimulatedDevice device;
  HipPath path;
  path.points = { { 5.0, { 0.0, 0.0, 0.02 } }, { 5.2, { 0.0, 0.0, 0.01 } }, { 6.2, { 0.0, 0.0, 0.01 } } };
  device.setPath(path);
  ASSERT_EQ(device.open(), Status::Ok);
  EXPECT_EQ(readZ(device, 0.0), 0.02);
  device.setTarget({ 0.0, 0.0, -0.04 });
  EXPECT_LT(readZ(device, 0.1), 0.02);
  EXPECT_GT(readZ(device, 0.2), 0.01) << "a mass lags behind";
  EXPECT_NEAR(readZ(device, 0.3), 0.01, 2e-3);
  for (int tick = 301; tick <= 1200; ++tick)
  {
    readZ(device, tick / 1000.0);
    ASSERT_EQ(device.write(tick / 1000.0, { 0.0, 0.0, 0.4 }), Status::Ok);
  }
  EXPECT_NEAR(readZ(device, 1.2), 0.012, 1e-4) << "and yields to forces";
  HandState hand;
  EXPECT_EQ(device.read(1.201, hand), Status::EndOfPath);
  ASSERT_EQ(device.open(), Status::Ok);
  EXPECT_EQ(readZ(device, 0.0), 0.02) << "from the beginning";
}

TEST(SimulatedDevice, RefusesAPathThatIsNone)
{
  SimulatedDevice device;
  HipPath path;
  path.points = { { 1.0, Vec3() }, { 0.0, Vec3() } };
  device.setPath(path);
  EXPECT_EQ(device.open(), Status::InvalidParameter);
}

TEST(SimulatedDevice, TellsWhatItsGripBears)
{
  SimulatedHandSettings settings;
  settings.gripDamping = 3.0;
  const SimulatedDevice yielding(settings);
  EXPECT_EQ(checkPassive(yielding.limits(), 6001.0, 0.0, 1000.0), Status::NotPassive);
  EXPECT_EQ(checkPassive(yielding.limits(), 6001.0, 0.0, 2000.0), Status::Ok);
  settings.yieldsToForce = false;
  EXPECT_EQ(checkPassive(SimulatedDevice(settings).limits(), 1e5, 1e3, 500.0), Status::Ok);
}

TEST(SimulatedDevice, IsExactlyOnItsPathWhereItDoesNotYield)
{
  HipPath path;
  path.points = { { 10.0, { 0.0, 0.0, 0.1 } }, { 10.5, { 0.0, 0.0, -0.1 } } };
  SimulatedHandSettings settings;
  settings.yieldsToForce = false;
  for (const bool holds : { false, true })
  {
    settings.holdsAtEnd = holds;
    SimulatedDevice device(settings);
    device.setPath(path);
    EXPECT_STREQ(device.name(), "path");
    EXPECT_EQ(device.maximumForce(), INFINITY);
    HandState hand;
    EXPECT_EQ(device.read(0.0, hand), Status::DeviceNotOpen);
    for (int round = 0; round < 2; ++round)
    {
      ASSERT_EQ(device.open(), Status::Ok);
      for (int tick = 0; tick <= 500; ++tick)
      {
        ASSERT_EQ(device.read(tick / 1000.0, hand), Status::Ok) << tick;
        ASSERT_NEAR(hand.position.z, 0.1 - 0.2 * tick / 500.0, 1e-15);
      }
      EXPECT_EQ(device.read(2.0, hand), holds ? Status::Ok : Status::EndOfPath);
      EXPECT_EQ(hand.position.z, -0.1);
      device.close();
    }
    std::swap(path.points[0], path.points[1]);
    device.setPath(path);
    EXPECT_EQ(device.open(), Status::InvalidParameter);
    std::swap(path.points[0], path.points[1]);
  }
}
