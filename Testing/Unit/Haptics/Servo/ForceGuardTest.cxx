#include "Haptics/Servo/ForceGuard.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace pointhaptics;

namespace
{
constexpr double kTick = 1e-3;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Vec3 randomVector(std::mt19937_64& random, double scale)
{
  std::uniform_real_distribution<double> coordinate(-scale, scale);
  return { coordinate(random), coordinate(random), coordinate(random) };
}

/// 4 N a tick, 8 N at most.
ForceGuard defaultGuard()
{
  return ForceGuard(ForceLimits());
}
}

TEST(ForceGuard, PassesForcesInsideItsLimitsBitForBit)
{
  ForceGuard guard = defaultGuard();
  std::mt19937_64 random(1);
  Vec3 force;
  for (int tick = 0; tick < 10000; ++tick)
  {
    Vec3 next = force + randomVector(random, 2.2);
    next = norm(next) > 7.9 ? (7.9 / norm(next)) * next : next;
    if (norm(next - force) < 3.99)
    {
      ASSERT_EQ(guard.limit(next, kTick), next);
      force = next;
    }
  }
}

TEST(ForceGuard, KeepsItsLimitsForEveryRequest)
{
  ForceGuard guard = defaultGuard();
  std::mt19937_64 random(2);
  Vec3 last;
  for (int tick = 0; tick < 100000; ++tick)
  {
    const double scale = std::pow(10.0, std::uniform_real_distribution<double>(-3.0, 3.0)(random));
    const Vec3 request = randomVector(random, scale);
    const Vec3 sent = guard.limit(request, kTick);
    ASSERT_LE(norm(sent), 8.0);
    ASSERT_LE(norm(sent), norm(request) * (1.0 + 1e-12)) << "the guard pushed harder than asked";
    // Letting go may be faster than the slew limit; growing and turning may not.
    const Vec3 base = norm(last) > norm(sent) ? (norm(sent) / norm(last)) * last : last;
    ASSERT_LE(norm(sent - base), 4.0 * (1.0 + 1e-12));
    ASSERT_LE(norm(sent), norm(last) + 4.0 * (1.0 + 1e-12));
    last = sent;
  }
}

TEST(ForceGuard, LetsGoAtOnce)
{
  ForceGuard guard = defaultGuard();
  EXPECT_EQ(guard.limit({ 4.0, 0.0, 0.0 }, kTick), Vec3(4.0, 0.0, 0.0));
  EXPECT_EQ(guard.limit({ 8.0, 0.0, 0.0 }, kTick), Vec3(8.0, 0.0, 0.0));
  EXPECT_EQ(guard.limit({ 0.0, 0.0, 0.0 }, kTick), Vec3());
}

TEST(ForceGuard, DoesNotPullTheOldWayWhenTheRequestTurnsAround)
{
  ForceGuard guard = defaultGuard();
  guard.limit({ 4.0, 0.0, 0.0 }, kTick);
  guard.limit({ 8.0, 0.0, 0.0 }, kTick);
  EXPECT_EQ(guard.limit({ -1.0, 0.0, 0.0 }, kTick), Vec3(-1.0, 0.0, 0.0));
  guard.reset();
  guard.limit({ 4.0, 0.0, 0.0 }, kTick);
  EXPECT_NEAR(guard.limit({ -4.0, 0.0, 0.0 }, kTick).x, 0.0, 1e-12);
  EXPECT_NEAR(guard.limit({ -4.0, 0.0, 0.0 }, kTick).x, -4.0, 1e-12);
}

TEST(ForceGuard, ReachesALargeRequestOverSeveralTicks)
{
  ForceGuard guard(ForceLimits{ 8.0, 1000.0 });
  const Vec3 request(0.0, 0.0, 20.0);
  for (int tick = 1; tick <= 8; ++tick)
  {
    EXPECT_NEAR(guard.limit(request, kTick).z, double(tick), 1e-9);
  }
  EXPECT_NEAR(guard.limit(request, kTick).z, 8.0, 1e-9);
}

TEST(ForceGuard, ClampKeepsTheDirection)
{
  ForceGuard guard(ForceLimits{ 8.0, kInfinity });
  const Vec3 sent = guard.limit({ 300.0, -400.0, 1200.0 }, kTick);
  EXPECT_NEAR(norm(sent - (8.0 / 1300.0) * Vec3(300.0, -400.0, 1200.0)), 0.0, 1e-12);
}

TEST(ForceGuard, CountsForcesThatAreNotFiniteAsZero)
{
  ForceGuard guard = defaultGuard();
  guard.limit({ 3.0, 0.0, 0.0 }, kTick);
  EXPECT_EQ(guard.limit({ kNaN, 1.0, 1.0 }, kTick), Vec3());
  EXPECT_EQ(guard.limit({ 1.0, kInfinity, 1.0 }, kTick), Vec3());
  EXPECT_EQ(guard.limit({ 1.0, 1.0, -kInfinity }, kTick), Vec3());
}

TEST(ForceGuard, SurvivesTheLargestNumbers)
{
  ForceGuard guard(ForceLimits{ 8.0, kInfinity });
  const double huge = std::numeric_limits<double>::max();
  EXPECT_TRUE(isFinite(guard.limit({ huge, huge, huge }, kTick)));
  EXPECT_NEAR(guard.limit({ 1e300, 0.0, 0.0 }, kTick).x, 8.0, 1e-12);
  EXPECT_EQ(guard.limit({ 5e-324, 0.0, 0.0 }, kTick), Vec3(5e-324, 0.0, 0.0));
}

TEST(ForceGuard, DoesNotGrowWithoutTime)
{
  for (double dt : { 0.0, -1.0, kNaN, kInfinity })
  {
    ForceGuard guard = defaultGuard();
    EXPECT_EQ(guard.limit({ 1.0, 0.0, 0.0 }, dt), Vec3()) << dt;
  }
}

TEST(ForceGuard, TakesInvalidLimitsAsZero)
{
  for (double limit : { -1.0, kNaN })
  {
    ForceGuard noForce(ForceLimits{ limit, 4000.0 });
    EXPECT_EQ(noForce.limit({ 1.0, 0.0, 0.0 }, kTick), Vec3());
    ForceGuard noGrowth(ForceLimits{ 8.0, limit });
    EXPECT_EQ(noGrowth.limit({ 1.0, 0.0, 0.0 }, kTick), Vec3());
  }
}

TEST(ForceGuard, GrowsFromZeroAfterReset)
{
  ForceGuard guard = defaultGuard();
  guard.limit({ 4.0, 0.0, 0.0 }, kTick);
  guard.limit({ 8.0, 0.0, 0.0 }, kTick);
  guard.reset();
  EXPECT_NEAR(guard.limit({ 8.0, 0.0, 0.0 }, kTick).x, 4.0, 1e-12);
}
