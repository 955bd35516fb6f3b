#include "Devices/Falcon/FalconForceChain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace pointhaptics;

namespace
{
constexpr double kTick = 1e-3;

FalconAngles anglesAt(const Vec3& position)
{
  FalconAngles angles{};
  EXPECT_TRUE(falcon::inverse(position, angles));
  return angles;
}

FalconAngles torquesOf(const Vec3& force, const Vec3& position)
{
  FalconAngles torques{};
  EXPECT_TRUE(falcon::torques(position, anglesAt(position), force, torques));
  return torques;
}

/// A chain whose ramp is over.
FalconForceChain armed(const FalconForceLimits& limits = {})
{
  FalconForceChain chain(limits);
  for (int i = 0; i < 1100; ++i)
  {
    chain.step(Vec3(), falcon::kCenter, anglesAt(falcon::kCenter), true, kTick);
  }
  return chain;
}

bool isZero(const std::array<std::int16_t, 3>& motors)
{
  return motors == std::array<std::int16_t, 3>{};
}

Vec3 randomForce(std::mt19937_64& random, double size)
{
  std::normal_distribution<double> normal;
  return size * normalized({ normal(random), normal(random), normal(random) });
}
}

TEST(FalconForceChain, LeavesForcesInsideAllLimitsAsTheyAre)
{
  std::mt19937_64 random(1);
  FalconForceLimits limits;
  limits.maximumTorqueRate = std::numeric_limits<double>::infinity();
  FalconForceChain chain = armed(limits);
  for (int i = 0; i < 1000; ++i)
  {
    const Vec3 p = falcon::kCenter + randomForce(random, 0.02);
    const Vec3 force = randomForce(random, 4.0 * double(i) / 1000.0);
    const std::array<std::int16_t, 3> motors = chain.step(force, p, anglesAt(p), true, kTick);
    EXPECT_EQ(chain.torques(), torquesOf(force, p)) << "bit for bit";
    for (std::size_t leg = 0; leg < 3; ++leg)
    {
      EXPECT_NEAR(motors[leg], -10000.0 * chain.torques()[leg], 0.5);
    }
  }
}

TEST(FalconForceChain, ClampsALongForceAndKeepsItsDirection)
{
  std::mt19937_64 random(2);
  FalconForceLimits limits;
  limits.maximumTorqueRate = std::numeric_limits<double>::infinity();
  FalconForceChain chain = armed(limits);
  for (int i = 0; i < 1000; ++i)
  {
    const Vec3 direction = randomForce(random, 1.0);
    chain.step(5.0 * (1 + i) * direction, falcon::kCenter, anglesAt(falcon::kCenter), true, kTick);
    const FalconAngles expected = torquesOf(4.0 * direction, falcon::kCenter);
    for (std::size_t leg = 0; leg < 3; ++leg)
    {
      EXPECT_NEAR(chain.torques()[leg], expected[leg], 1e-12);
    }
  }
}

TEST(FalconForceChain, ScalesTorquesTogetherWhenOneIsTooLarge)
{
  std::mt19937_64 random(3);
  FalconForceLimits limits;
  limits.maximumForce = 8.0;
  limits.maximumTorque = 0.1;
  limits.maximumTorqueRate = std::numeric_limits<double>::infinity();
  FalconForceChain chain = armed(limits);
  int scaled = 0;
  for (int i = 0; i < 1000; ++i)
  {
    const Vec3 force = randomForce(random, 8.0);
    const FalconAngles wanted = torquesOf(force, falcon::kCenter);
    const auto size = [](const FalconAngles& t) {
      return std::max({ std::abs(t[0]), std::abs(t[1]), std::abs(t[2]) });
    };
    chain.step(force, falcon::kCenter, anglesAt(falcon::kCenter), true, kTick);
    if (size(wanted) <= limits.maximumTorque)
    {
      continue;
    }
    ++scaled;
    EXPECT_NEAR(size(chain.torques()), limits.maximumTorque, 1e-12);
    for (std::size_t leg = 0; leg < 3; ++leg)
    {
      EXPECT_NEAR(chain.torques()[leg] / limits.maximumTorque, wanted[leg] / size(wanted), 1e-12);
    }
  }
  EXPECT_GT(scaled, 500);
}

TEST(FalconForceChain, NoMotorValueLeavesItsRangeWhateverTheForce)
{
  std::mt19937_64 random(4);
  FalconForceLimits limits;
  limits.maximumForce = 8.0;
  FalconForceChain chain = armed(limits);
  for (int i = 0; i < 20000; ++i)
  {
    const double size = std::pow(10.0, double(random() % 600) - 300.0);
    const Vec3 p = falcon::kCenter + randomForce(random, 0.04);
    for (std::int16_t motor : chain.step(randomForce(random, size), p, anglesAt(p), true, kTick))
    {
      ASSERT_LE(std::abs(motor), 4096);
    }
  }
  EXPECT_EQ(falconMotorValue(1.0), -4096);
  EXPECT_EQ(falconMotorValue(-1.0), 4096);
  EXPECT_EQ(falconMotorValue(std::nan("")), 0);
}

TEST(FalconForceChain, RampsUpOverASecondAfterArming)
{
  FalconForceChain chain;
  const Vec3 force(0.0, 0.0, 2.0);
  const FalconAngles angles = anglesAt(falcon::kCenter);
  EXPECT_TRUE(isZero(chain.step(force, falcon::kCenter, angles, false, kTick)));
  const double full = torquesOf(force, falcon::kCenter)[0];
  for (int tick = 1; tick <= 1500; ++tick)
  {
    chain.step(force, falcon::kCenter, angles, true, kTick);
    ASSERT_NEAR(chain.torques()[0], full * std::min(1.0, tick / 1000.0), 1e-9) << tick;
  }
  EXPECT_EQ(chain.torques()[0], full);
}

TEST(FalconForceChain, GivesNothingWhenNotHomedOrNotArmedAndRampsAnew)
{
  FalconForceChain chain = armed();
  const Vec3 force(0.0, 1.0, 2.0);
  EXPECT_FALSE(isZero(chain.step(force, falcon::kCenter, anglesAt(falcon::kCenter), true, kTick)));
  EXPECT_TRUE(isZero(chain.step(force, falcon::kCenter, anglesAt(falcon::kCenter), false, kTick)));
  EXPECT_EQ(chain.ramp(), 0.0);
  chain.step(force, falcon::kCenter, anglesAt(falcon::kCenter), true, kTick);
  EXPECT_NEAR(chain.ramp(), 1e-3, 1e-12);
  chain.restart();
  EXPECT_EQ(chain.ramp(), 0.0);
}

TEST(FalconForceChain, GivesNothingForWhatIsNoNumberOrASingularPose)
{
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  const FalconAngles angles = anglesAt(falcon::kCenter);
  const Vec3 force(0.0, 0.0, 2.0);
  FalconForceChain chain = armed();
  const auto expectZero = [&](const Vec3& f, const Vec3& p, const FalconAngles& a)
  {
    EXPECT_FALSE(isZero(armed().step(force, falcon::kCenter, angles, true, kTick)));
    EXPECT_TRUE(isZero(chain.step(f, p, a, true, kTick)));
    EXPECT_EQ(chain.ramp(), 0.0) << "the ramp begins anew";
  };
  expectZero({ nan, 0.0, 0.0 }, falcon::kCenter, angles);
  expectZero({ 0.0, infinity, 0.0 }, falcon::kCenter, angles);
  expectZero(force, { 0.0, 0.0, nan }, angles);
  expectZero(force, falcon::kCenter, { angles[0], nan, angles[2] });
  expectZero(force, { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 });
}

TEST(FalconForceChain, GrowsNoFasterThanTheSlewLimitAndLetsGoAtOnce)
{
  FalconForceLimits limits;
  limits.maximumTorqueRate = 10.0;
  FalconForceChain chain = armed(limits);
  const FalconAngles angles = anglesAt(falcon::kCenter);
  const Vec3 force(0.0, 0.0, 4.0);
  const auto size = [](const FalconAngles& t) { return std::hypot(t[0], t[1], t[2]); };
  double last = 0.0;
  int ticks = 0;
  while (size(chain.torques()) < size(torquesOf(force, falcon::kCenter)) && ticks < 1000)
  {
    chain.step(force, falcon::kCenter, angles, true, kTick);
    ASSERT_LE(size(chain.torques()), last + 0.010001);
    last = size(chain.torques());
    ++ticks;
  }
  EXPECT_GT(ticks, 5);
  EXPECT_LT(ticks, 1000);
  EXPECT_TRUE(isZero(chain.step(Vec3(), falcon::kCenter, angles, true, kTick)));
}

TEST(FalconForceChain, LongOrOddTimesDoNotSkipTheRamp)
{
  FalconForceChain chain;
  const FalconAngles angles = anglesAt(falcon::kCenter);
  for (double dt : { -1.0, 0.0, std::nan("") })
  {
    chain.step({ 0.0, 0.0, 1.0 }, falcon::kCenter, angles, true, dt);
    EXPECT_EQ(chain.ramp(), 0.0) << dt;
  }
  chain.step({ 0.0, 0.0, 1.0 }, falcon::kCenter, angles, true, 1e9);
  EXPECT_LE(chain.ramp(), 0.1);
}

TEST(FalconForceLimits, RefusesWhatIsBeyondTheHardware)
{
  const auto check = [](void (*change)(FalconForceLimits&))
  {
    FalconForceLimits limits;
    change(limits);
    const Status status = limits.check();
    FalconForceChain chain(limits);
    for (int i = 0; i < 2000; ++i)
    {
      const bool pushes =
        !isZero(chain.step({ 0.0, 0.0, 1.0 }, falcon::kCenter, anglesAt(falcon::kCenter), true, kTick));
      EXPECT_TRUE(status == Status::Ok || !pushes) << "no force passes under limits that are refused";
    }
    return status;
  };
  EXPECT_EQ(check([](FalconForceLimits&) {}), Status::Ok);
  EXPECT_EQ(check([](FalconForceLimits& l) { l.maximumForce = 8.0; }), Status::Ok);
  EXPECT_EQ(check([](FalconForceLimits& l) { l.maximumForce = 8.1; }), Status::InvalidParameter);
  EXPECT_EQ(check([](FalconForceLimits& l) { l.maximumForce = -1.0; }), Status::InvalidParameter);
  EXPECT_EQ(check([](FalconForceLimits& l) { l.maximumTorque = 0.5; }), Status::InvalidParameter);
  EXPECT_EQ(check([](FalconForceLimits& l) { l.rampSeconds = 0.9; }), Status::InvalidParameter);
  EXPECT_EQ(
    check([](FalconForceLimits& l) { l.maximumTorqueRate = std::nan(""); }), Status::InvalidParameter);
}
