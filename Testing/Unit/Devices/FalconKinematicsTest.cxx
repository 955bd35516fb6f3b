#include "Devices/Falcon/FalconKinematics.h"

#include "FalconReplies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

using namespace pointhaptics;
using falcon::forward;
using falcon::inverse;

namespace
{
constexpr double kPi = 3.14159265358979323846;

/// Uniform in the 4 cm ball about the workspace's centre.
Vec3 inBall(std::mt19937_64& random)
{
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (;;)
  {
    const Vec3 p(unit(random), unit(random), unit(random));
    if (norm(p) <= 1.0)
    {
      return falcon::kCenter + 0.04 * p;
    }
  }
}

/// d(angle_leg)/d(position) of the closed form, by central differences: knows nothing of the driver's
/// matrices.
std::array<Vec3, 3> anglesByPosition(const Vec3& p)
{
  constexpr double h = 1e-6;
  std::array<Vec3, 3> result;
  for (int axis = 0; axis < 3; ++axis)
  {
    Vec3 offset;
    offset[axis] = h;
    FalconAngles low;
    FalconAngles high;
    EXPECT_TRUE(inverse(p - offset, low) && inverse(p + offset, high));
    for (std::size_t leg = 0; leg < 3; ++leg)
    {
      result[leg][axis] = (high[leg] - low[leg]) / (2.0 * h);
    }
  }
  return result;
}
}

TEST(FalconKinematics, KnowsThePoseInTheMiddle)
{
  FalconAngles angles;
  ASSERT_TRUE(inverse({ 0.0, 0.0, 0.15 }, angles));
  const std::array<double, 3> counts = { trial::countOf(angles[0]), trial::countOf(angles[1]),
    trial::countOf(angles[2]) };
  for (std::size_t leg = 0; leg < 3; ++leg)
  {
    EXPECT_NEAR(angles[leg] * 180.0 / kPi, 47.24, 0.01);
    EXPECT_NEAR(counts[leg], 336.0, 0.5);
    EXPECT_NEAR(falcon::anglesFromCounts(counts)[leg], angles[leg], 1e-15);
  }
  EXPECT_NEAR(falcon::countsPerRadian() * kPi / 180.0, 27.45, 0.005);
}

TEST(FalconKinematics, LeadsThereAndBackWithinANanometreInTheWholeBall)
{
  std::mt19937_64 random(1);
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i)
  {
    const Vec3 p = inBall(random);
    FalconAngles angles;
    Vec3 back;
    ASSERT_TRUE(inverse(p, angles)) << p.x << " " << p.y << " " << p.z;
    ASSERT_TRUE(forward(angles, falcon::kCenter, back)) << p.x << " " << p.y << " " << p.z;
    worst = std::max(worst, norm(back - p));
  }
  std::printf("[ figure   ] forward(inverse(x)) - x: %.2g m at most\n", worst);
  EXPECT_LT(worst, 1e-12);
}

TEST(FalconKinematics, ConvergesFromAnyGuessInTheWorkspace)
{
  std::mt19937_64 random(2);
  for (int i = 0; i < 20000; ++i)
  {
    const Vec3 p = inBall(random);
    FalconAngles angles;
    Vec3 back;
    ASSERT_TRUE(inverse(p, angles));
    ASSERT_TRUE(forward(angles, inBall(random), back));
    ASSERT_LT(norm(back - p), 1e-12);
  }
}

TEST(FalconKinematics, JacobianIsThatOfFiniteDifferences)
{
  std::mt19937_64 random(3);
  constexpr double h = 1e-6;
  for (int i = 0; i < 2000; ++i)
  {
    const Vec3 p = inBall(random);
    FalconAngles angles;
    std::array<Vec3, 3> derivatives;
    ASSERT_TRUE(inverse(p, angles));
    ASSERT_TRUE(falcon::jacobian(p, angles, derivatives));
    for (std::size_t leg = 0; leg < 3; ++leg)
    {
      FalconAngles low = angles;
      FalconAngles high = angles;
      low[leg] -= h;
      high[leg] += h;
      Vec3 pLow;
      Vec3 pHigh;
      ASSERT_TRUE(forward(low, p, pLow) && forward(high, p, pHigh));
      const Vec3 difference = (pHigh - pLow) / (2.0 * h);
      EXPECT_LT(norm(derivatives[leg] - difference), 1e-6 * norm(difference));
    }
  }
}

TEST(FalconKinematics, TorquesGiveTheForceExactlyInSizeAndDirection)
{
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  double worst = 0.0;
  for (int i = 0; i < 5000; ++i)
  {
    const Vec3 p = inBall(random);
    const Vec3 force(normal(random), normal(random), normal(random));
    FalconAngles angles;
    FalconAngles torques;
    ASSERT_TRUE(inverse(p, angles));
    ASSERT_TRUE(falcon::torques(p, angles, force, torques));
    const std::array<Vec3, 3> byPosition = anglesByPosition(p);
    const Vec3 felt = torques[0] * byPosition[0] + torques[1] * byPosition[1] + torques[2] * byPosition[2];
    worst = std::max(worst, norm(felt - force) / norm(force));
  }
  std::printf("[ figure   ] force error before quantisation: %.2g of the force at most\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(FalconKinematics, ACountMovesTheGripByFiftyMicrometresInTheMiddleAndSixtyAtMost)
{
  // The step that the passivity limit assumes.
  std::mt19937_64 random(5);
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i)
  {
    const Vec3 p = i == 0 ? Vec3(0.0, 0.0, 0.15) : inBall(random);
    FalconAngles angles;
    std::array<Vec3, 3> derivatives;
    ASSERT_TRUE(inverse(p, angles));
    ASSERT_TRUE(falcon::jacobian(p, angles, derivatives));
    for (const Vec3& derivative : derivatives)
    {
      const double step = norm(derivative) / falcon::countsPerRadian();
      if (i == 0)
      {
        EXPECT_GT(step, 40e-6);
        EXPECT_LT(step, 55e-6);
      }
      worst = std::max(worst, step);
    }
  }
  std::printf("[ figure   ] one count moves the grip by %.3g m at most\n", worst);
  EXPECT_LT(worst, 60e-6);
}

TEST(FalconKinematics, RefusesWhatIsOutOfReachOrNoNumber)
{
  FalconAngles angles{ 1.0, 2.0, 3.0 };
  for (const Vec3& p : { Vec3(0.0, 0.0, 0.5), Vec3(0.3, 0.0, 0.12), Vec3(std::nan(""), 0.0, 0.1) })
  {
    EXPECT_FALSE(inverse(p, angles));
  }
  EXPECT_EQ(angles[2], 3.0);
  Vec3 position(1.0, 1.0, 1.0);
  EXPECT_FALSE(forward({ std::nan(""), 0.8, 0.8 }, falcon::kCenter, position));
  EXPECT_FALSE(forward({ -2.0, 2.5, 0.8 }, falcon::kCenter, position)) << "no joint turns that far";
  EXPECT_EQ(position, Vec3(1.0, 1.0, 1.0));
}

TEST(FalconKinematics, AnyCountsGiveAPoseThatFitsThemOrNone)
{
  std::mt19937_64 random(6);
  int poses = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const auto count = [&] { return double(std::int16_t(random()) / (i % 2 ? 1 : 40)); };
    const FalconAngles angles = falcon::anglesFromCounts({ count(), count(), count() });
    Vec3 p;
    if (forward(angles, falcon::kCenter, p))
    {
      ++poses;
      ASSERT_TRUE(isFinite(p));
      ASSERT_LT(norm(p), 0.25);
    }
  }
  EXPECT_GT(poses, 500);
}
