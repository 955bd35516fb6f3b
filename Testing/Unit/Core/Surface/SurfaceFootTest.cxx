// From a fit to the surface: foot points, normals, and settling on it.
#include "FitFixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace pointhaptics;
using namespace pointhaptics::trial;

TEST(FootPoint, IsTheNearestPointOfTheFit)
{
  Random random(7);
  for (int i = 0; i < 300; ++i)
  {
    SurfaceFit fit;
    fit.quality = FitQuality::Quadric;
    fit.radius = 2e-3;
    for (int j = 0; j < 6; ++j)
    {
      fit.k[j] = random.uniform(-0.1, 0.1);
    }
    const SurfaceFrame frame = frameAlong(random.direction(), random.inBox({ -1, -1, -1 }, { 1, 1, 1 }));
    const Vec3 local = fit.radius * random.inBox({ -0.25, -0.25, -0.6 }, { 0.25, 0.25, 0.6 });
    const Vec3 target = frame.toWorld(local);
    Vec3 foot, normal;
    ASSERT_TRUE(footPoint(fit, frame, target, foot, normal));
    const Vec3 f = frame.toLocal(foot) / fit.radius;
    EXPECT_NEAR(f.z, fit.height(f.x, f.y), 1e-12) << "on the surface";
    EXPECT_NEAR(norm(normal), 1.0, 1e-12);
    EXPECT_GT(dot(normal, frame.normal), 0.0);
    EXPECT_LE(norm(cross(target - foot, normal)), 1e-9 * fit.radius) << "at right angles";
    double nearest = INFINITY;
    for (int u = -100; u <= 100; ++u)
    {
      for (int v = -100; v <= 100; ++v)
      {
        const Vec3 p(0.005 * u, 0.005 * v, fit.height(0.005 * u, 0.005 * v));
        nearest = std::min(nearest, norm(p - local / fit.radius));
      }
    }
    EXPECT_LE(norm(target - foot) / fit.radius, nearest + 1e-12);
  }
}

TEST(FootPoint, SaysWhenItStoppedAtABound)
{
  SurfaceFit fit;
  fit.quality = FitQuality::Plane;
  fit.radius = 1e-3;
  Vec3 foot, normal;
  EXPECT_FALSE(footPoint(fit, SurfaceFrame(), { 0.05, 0, 1e-4 }, foot, normal));
  EXPECT_LE(norm(foot), 0.5 * 1e-3 * (1 + 1e-9));
  EXPECT_TRUE(isFinite(foot) && isFinite(normal));
}

TEST(FootPoint, StaysFiniteOnStrongCurvature)
{
  Random random(8);
  for (int i = 0; i < 1000; ++i)
  {
    SurfaceFit fit;
    fit.quality = FitQuality::Quadric;
    fit.radius = 1.0;
    for (double& k : fit.k)
    {
      k = random.uniform(-10, 10);
    }
    Vec3 foot, normal;
    (void)footPoint(fit, SurfaceFrame(), random.inBox({ -2, -2, -2 }, { 2, 2, 2 }), foot, normal);
    EXPECT_TRUE(isFinite(foot) && isFinite(normal));
    EXPECT_NEAR(norm(normal), 1.0, 1e-9);
  }
}

TEST(PrincipalNormal, RefusesLinesAndEmptiness)
{
  std::vector<Vec3> line;
  for (int i = 0; i < 100; ++i)
  {
    line.emplace_back(i * 1e-4, 0.0, 0.0);
  }
  Vec3 normal;
  EXPECT_FALSE(
    principalNormal(resampled(line, 3e-4), { 5e-3, 0, 0 }, 3e-3, *std::make_unique<FitCells>(), normal));
  EXPECT_FALSE(
    principalNormal(resampled(line, 3e-4), { 1, 1, 1 }, 3e-3, *std::make_unique<FitCells>(), normal));
}

TEST(SettleOnSurface, FindsTheSphereItsNormalAndItsCurvature)
{
  const CellPyramid pyramid = resampled(sphere(300000, 0.025, 10), 1e-3 / 3);
  const auto memory = std::make_unique<FitCells>();
  Random random(11);
  for (int i = 0; i < 50; ++i)
  {
    const Vec3 direction = random.direction();
    SurfaceFrame frame = frameAlong(normalized(direction + 0.1 * random.direction()), {});
    SurfaceFit fit;
    double curvature[3];
    ASSERT_TRUE(
      settleOnSurface(pyramid, (0.025 + 5e-5) * direction, 1.5e-3, 6e-4, *memory, frame, fit, curvature));
    EXPECT_NEAR(norm(frame.origin), 0.025, 2e-8);
    EXPECT_GE(dot(frame.normal, normalized(frame.origin)), std::cos(2e-4));
    EXPECT_NEAR(curvature[0], -20.0, 0.2) << "-1/(2R) along a";
    EXPECT_NEAR(curvature[2], -20.0, 0.2) << "-1/(2R) along b";
    EXPECT_NEAR(curvature[1], 0.0, 0.2);
  }
}

TEST(SettleOnSurface, StaysOnTheSheetItBeginsOn)
{
  // The lower one has more points: a fit to both would lie nearer to it.
  std::vector<Vec3> points = trial::randomBox(40000, 21, { -0.02, -0.02, 0 }, { 0.02, 0.02, 0 });
  const std::vector<Vec3> below =
    trial::randomBox(200000, 22, { -0.02, -0.02, -8e-4 }, { 0.02, 0.02, -8e-4 });
  points.insert(points.end(), below.begin(), below.end());
  const CellPyramid pyramid = resampled(points, 1e-3 / 3);
  const auto memory = std::make_unique<FitCells>();
  for (const double sheet : { 0.0, -8e-4 })
  {
    SurfaceFrame frame;
    SurfaceFit fit;
    double curvature[3];
    ASSERT_TRUE(settleOnSurface(pyramid, { 1e-3, 2e-3, sheet }, 3e-3, 5e-4, *memory, frame, fit, curvature));
    EXPECT_NEAR(frame.origin.z, sheet, 1e-9);
  }
}
