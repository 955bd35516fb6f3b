#include "FitFixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace pointhaptics;
using namespace pointhaptics::trial;

TEST(SurfaceFrame, TurnsItsTangentsAlongAndStaysOrthonormal)
{
  Random random(1);
  SurfaceFrame frame;
  for (int i = 0; i < 500; ++i)
  {
    const Vec3 before = frame.a;
    const Vec3 target = normalized(frame.normal + 0.5 * random.direction());
    const double turn = std::acos(std::min(1.0, dot(target, frame.normal)));
    frame.turnTo(target);
    EXPECT_LE(norm(frame.normal - target), 1e-14);
    EXPECT_NEAR(norm(frame.a), 1.0, 1e-14);
    EXPECT_NEAR(norm(frame.b), 1.0, 1e-14);
    EXPECT_NEAR(dot(frame.a, frame.normal), 0.0, 1e-14);
    EXPECT_LE(norm(frame.b - cross(frame.normal, frame.a)), 1e-13);
    EXPECT_LE(norm(frame.a - before), turn + 1e-12) << "as little as possible";
  }
}

TEST(SurfaceFrame, LocalAndWorldUndoEachOther)
{
  const SurfaceFrame frame = frameAlong(normalized({ 1, 2, 3 }), { 4, 5, 6 });
  const Vec3 p(0.3, -7, 2);
  EXPECT_LE(norm(frame.toWorld(frame.toLocal(p)) - p), 1e-14);
}

TEST(SurfaceFit, IsExactForAnyQuadricHoweverCoarseTheCells)
{
  Random random(2);
  for (int trialNumber = 0; trialNumber < 40; ++trialNumber)
  {
    const SurfaceFrame frame = frameAlong(random.direction(), random.inBox({ -1, -1, -1 }, { 1, 1, 1 }));
    Quadric q{};
    q.c[0] = random.uniform(-1e-4, 1e-4);
    q.c[1] = random.uniform(-0.2, 0.2);
    q.c[2] = random.uniform(-0.2, 0.2);
    for (int i = 3; i < 6; ++i)
    {
      q.c[i] = random.uniform(-20, 20);
    }
    const std::vector<Vec3> points = sampled(q, frame, 0.012, 20000, 100 + std::uint64_t(trialNumber));
    for (const double voxelSize : { 3e-4, 1e-3, 2e-3 })
    {
      const CellPyramid pyramid = resampled(points, voxelSize);
      for (const double radius : { 6e-3, 9e-3 })
      {
        FitSettings settings;
        settings.radius = radius;
        const SurfaceFit fit = fitOnce(pyramid, frame, settings);
        ASSERT_EQ(fit.quality, FitQuality::Quadric) << voxelSize << ' ' << radius;
        EXPECT_EQ(fit.radius, radius);
        const double expected[6] = { q.c[0] / radius, q.c[1], q.c[2], q.c[3] * radius, q.c[4] * radius,
          q.c[5] * radius };
        for (int i = 0; i < 6; ++i)
        {
          EXPECT_NEAR(fit.k[i], expected[i], 1e-7)
            << "k" << i << " voxel " << voxelSize << " radius " << radius;
        }
        EXPECT_GT(fit.cells, 9);
      }
    }
  }
}

TEST(SurfaceFit, TracedFitIsExactForAnyCubicOnSinglePoints)
{
  Random random(12);
  const SurfaceFrame frame = frameAlong(random.direction(), { 0.01, -0.02, 0.03 });
  constexpr double kRadius = 3e-3;
  // Over the radius: z = k0 + k1 u + ... + k5 vv and the cubic terms.
  const double k[10] = { 1e-3, 0.1, -0.05, 0.08, -0.06, 0.04, 0.03, -0.02, 0.05, -0.04 };
  std::vector<Cell> cells;
  for (int i = 0; i < 400; ++i)
  {
    const double u = random.uniform(-1.0, 1.0);
    const double v = random.uniform(-1.0, 1.0);
    const double z = k[0] + k[1] * u + k[2] * v + k[3] * u * u + k[4] * u * v + k[5] * v * v +
      k[6] * u * u * u + k[7] * u * u * v + k[8] * u * v * v + k[9] * v * v * v;
    cells.emplace_back();
    cells.back().count = 1.0;
    cells.back().mean = frame.toWorld(kRadius * Vec3(u, v, z));
  }
  CellPyramid pyramid;
  ASSERT_EQ(pyramid.build(cells, kRadius / 40.0), Status::Ok);
  const auto memory = std::make_unique<FitCells>();
  FitSettings settings;
  settings.radius = kRadius;
  TracedSlopes slopes;
  slopes.strength = 1.0;
  const SurfaceFit traced = pointhaptics::fitSurface(pyramid, frame, settings, *memory, &slopes);
  const SurfaceFit quadric = fitOnce(pyramid, frame, settings);
  for (int i = 0; i < 6; ++i)
  {
    // Cells that hold two of the points have no third moments.
    EXPECT_NEAR(traced.k[i], k[i], 1e-4) << i;
  }
  EXPECT_GT(std::abs(quadric.k[1] - k[1]) + std::abs(quadric.k[2] - k[2]), 0.01) << "a quadric bends";
}

TEST(SurfaceFit, HasNoResidualOnSinglePointsOfAQuadric)
{
  const SurfaceFrame frame = frameAlong(normalized({ 1, -1, 2 }), { 0, 0, 0 });
  const Quadric q{ { 1e-5, 0.1, -0.1, 10, 5, -8 } };
  std::vector<Cell> cells;
  for (const Vec3& p : sampled(q, frame, 0.01, 3000, 3))
  {
    Cell cell;
    cell.mean = p;
    cells.push_back(cell);
  }
  CellPyramid pyramid;
  ASSERT_EQ(pyramid.build(cells, 1e-4), Status::Ok);
  FitSettings settings;
  settings.radius = 2e-3;
  const SurfaceFit fit = fitOnce(pyramid, frame, settings);
  ASSERT_EQ(fit.quality, FitQuality::Quadric);
  EXPECT_LE(fit.residual, 1e-10);
}

TEST(SurfaceFit, CentroidIsZeroInsideAndKnownOnAStraightRim)
{
  const SurfaceFrame frame;
  Random random(4);
  std::vector<Vec3> full;
  std::vector<Vec3> half;
  for (int i = 0; i < 200000; ++i)
  {
    const Vec3 p = random.inBox({ -0.01, -0.01, 0 }, { 0.01, 0.01, 0 });
    full.push_back(p);
    half.emplace_back(std::fabs(p.x), p.y, 0.0);
  }
  FitSettings settings;
  settings.radius = 6e-3;
  const SurfaceFit inside = fitOnce(resampled(full, 5e-4), frame, settings);
  EXPECT_NEAR(inside.centroidU, 0.0, 0.01);
  EXPECT_NEAR(inside.centroidV, 0.0, 0.01);
  const SurfaceFit rim = fitOnce(resampled(half, 5e-4), frame, settings);
  // 0.2352 for a continuous half disc; the cells are a third of the radius wide.
  EXPECT_NEAR(rim.centroidU, 0.235, 0.03);
  EXPECT_NEAR(rim.centroidV, 0.0, 0.01);
}

TEST(SurfaceFit, GateLeavesOutTheSheetBelow)
{
  Random random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < 40000; ++i)
  {
    points.push_back(random.inBox({ -0.01, -0.01, 0 }, { 0.01, 0.01, 0 }));
    points.push_back(random.inBox({ -0.01, -0.01, -8e-4 }, { 0.01, 0.01, -8e-4 }));
  }
  const CellPyramid pyramid = resampled(points, 1e-3 / 3);
  FitSettings settings;
  settings.radius = 1.2e-3;
  settings.gate = kGateDepth * settings.radius;
  const SurfaceFit fit = fitOnce(pyramid, SurfaceFrame(), settings);
  EXPECT_NE(fit.quality, FitQuality::None);
  EXPECT_NEAR(fit.k[0] * fit.radius, 0.0, 1e-7);
  settings.gate = 0.0;
  const SurfaceFit blind = fitOnce(pyramid, SurfaceFrame(), settings);
  EXPECT_LT(blind.k[0] * blind.radius, -1e-5) << "without the gate both sheets pull";
}

TEST(SurfaceFit, WithoutPointsOrPlaneIsNone)
{
  std::vector<Vec3> line;
  for (int i = 0; i < 100; ++i)
  {
    line.emplace_back(i * 1e-4, 0.0, 0.0);
  }
  FitSettings settings;
  settings.radius = 3e-3;
  EXPECT_EQ(fitOnce(resampled(line, 3e-4), SurfaceFrame(), settings).quality, FitQuality::None);
  SurfaceFrame far;
  far.origin = { 5, 5, 5 };
  EXPECT_EQ(fitOnce(resampled(line, 3e-4), far, settings).quality, FitQuality::None);
  const std::vector<Vec3> two{ { 0, 0, 0 }, { 1e-3, 0, 0 } };
  EXPECT_EQ(fitOnce(resampled(two, 3e-4), SurfaceFrame(), settings).quality, FitQuality::None);
}

TEST(SurfaceFit, WithFewPointsIsAPlane)
{
  const std::vector<Vec3> few{ { 0, 0, 0 }, { 1e-3, 0, 0 }, { 0, 1e-3, 0 }, { -1e-3, 0, 0 },
    { 0, -1e-3, 0 } };
  FitSettings settings;
  settings.radius = 3e-3;
  const SurfaceFit fit = fitOnce(resampled(few, 3e-4), SurfaceFrame(), settings);
  EXPECT_EQ(fit.quality, FitQuality::Plane);
  EXPECT_NEAR(fit.height(0.1, 0.2), 0.0, 1e-9);
}

namespace
{

/// On a noisy sphere, with or without cubic terms.
void expectHonestErrors(bool cubic)
{
  const double noise = 20e-6;
  const CellPyramid pyramid = resampled(sphere(300000, 0.025, 6, noise), 1e-3 / 3);
  FitSettings settings;
  settings.radius = cubic ? 3e-3 : 2e-3;
  const auto memory = std::make_unique<FitCells>();
  Random random(12);
  double variance = 0.0;
  double actual[3] = { 0, 0, 0 };
  double predicted[3] = { 0, 0, 0 };
  for (int i = 0; i < 100; ++i)
  {
    const Vec3 direction = random.direction();
    SurfaceFitError error;
    const SurfaceFit fit = pointhaptics::fitSurface(
      pyramid, frameAlong(direction, 0.025 * direction), settings, *memory, error, cubic);
    ASSERT_EQ(fit.quality, FitQuality::Quadric);
    variance += error.noise * error.noise / 100;
    const double found[3] = { fit.radius * fit.k[0], fit.k[1], fit.k[2] };
    for (int j = 0; j < 3; ++j)
    {
      actual[j] += found[j] * found[j];
      predicted[j] += error.noise * error.standardError[j] * error.noise * error.standardError[j];
    }
  }
  EXPECT_NEAR(std::sqrt(variance) / noise, 1.0, 0.15);
  for (int j = 0; j < 3; ++j)
  {
    EXPECT_NEAR(std::log(std::sqrt(actual[j] / predicted[j])), 0.0, std::log(1.5)) << j;
  }
}

} // namespace

TEST(SurfaceFit, TellsTheNoiseOfTheCloudAndItsOwnErrors)
{
  expectHonestErrors(false);
}

TEST(SurfaceFit, TellsItsErrorsWithCubicTermsToo)
{
  expectHonestErrors(true);
}

TEST(SurfaceFit, TellsHowMuchTheGateLeftOut)
{
  std::vector<Vec3> points = trial::randomBox(60000, 41, { -0.02, -0.02, 0 }, { 0.02, 0.02, 0 });
  const std::vector<Vec3> below = trial::randomBox(20000, 42, { -0.02, -0.02, -8e-4 }, { 0.02, 0.02, -8e-4 });
  points.insert(points.end(), below.begin(), below.end());
  const CellPyramid pyramid = resampled(points, 1e-3 / 3);
  const auto memory = std::make_unique<FitCells>();
  FitSettings settings;
  settings.radius = 4e-3;
  SurfaceFitError error;
  pointhaptics::fitSurface(pyramid, SurfaceFrame(), settings, *memory, error);
  EXPECT_EQ(error.leftOut, 0.0) << "no gate";
  settings.gate = 4e-4;
  pointhaptics::fitSurface(pyramid, SurfaceFrame(), settings, *memory, error);
  EXPECT_NEAR(error.leftOut, 0.22, 0.03) << "a quarter of the points, further from the middle";
}

TEST(SurfaceFit, CubicTermsGoOnAlongTheSurface)
{
  SurfaceFit fit;
  fit.quality = FitQuality::Quadric;
  fit.radius = 2e-3;
  const double k[6] = { 0.01, 0.1, -0.2, 0.3, 0.1, -0.2 };
  const double c[4] = { 0.2, -0.1, 0.3, 0.15 };
  std::copy(k, k + 6, fit.k);
  std::copy(c, c + 4, fit.cubic);
  const double u = 0.3;
  const double v = -0.2;
  EXPECT_NEAR(fit.height(u, v),
    0.01 + 0.1 * u - 0.2 * v + 0.3 * u * u + 0.1 * u * v - 0.2 * v * v + 0.2 * u * u * u - 0.1 * u * u * v +
      0.3 * u * v * v + 0.15 * v * v * v,
    1e-15);
  constexpr double kStep = 1e-6;
  EXPECT_NEAR(fit.slopeU(u, v), (fit.height(u + kStep, v) - fit.height(u - kStep, v)) / (2 * kStep), 1e-9);
  EXPECT_NEAR(fit.slopeV(u, v), (fit.height(u, v + kStep) - fit.height(u, v - kStep)) / (2 * kStep), 1e-9);
  const SurfaceFrame frame = frameAlong(normalized({ 1, 2, 3 }), { 4e-3, 5e-3, 6e-3 });
  Vec3 point;
  Vec3 normal;
  Vec3 foot;
  Vec3 footNormal;
  pointAt(fit, frame, u, v, point, normal);
  ASSERT_TRUE(footPoint(fit, frame, point - 5e-4 * normal, foot, footNormal));
  EXPECT_LE(norm(foot - point), 1e-12);
  EXPECT_LE(norm(footNormal - normal), 1e-9);
}

TEST(SurfaceFit, TracedSlopesAreThoseOfTheSurfaceThatTheMovingFitTraces)
{
  // No quadric: only there do the fit's own slopes differ from those of what it traces.
  Random random(31);
  std::vector<Vec3> points;
  for (int i = 0; i < 60000; ++i)
  {
    const Vec3 p = random.inBox({ -0.01, -0.01, 0 }, { 0.01, 0.01, 0 });
    points.emplace_back(p.x, p.y, 4e-4 * std::sin(900.0 * p.x + 0.7) * std::cos(700.0 * p.y + 0.4));
  }
  const CellPyramid pyramid = resampled(points, 1e-3 / 3);
  const auto memory = std::make_unique<FitCells>();
  FitSettings settings;
  settings.radius = 1.6e-3;
  TracedSlopes slopes;
  slopes.strength = 1.0;
  slopes.radiusGradient = { 0.2, -0.1, 0.0 };
  SurfaceFrame frame;
  SurfaceFit fit;
  double curvature[3];
  ASSERT_TRUE(settleOnSurface(pyramid, { 1e-3, -5e-4, 0.0 }, 1.6e-3, 1e-2, *memory, frame, fit, curvature));
  // The normal along the traced slopes, as in a converged step.
  for (int round = 0; round < 10; ++round)
  {
    fit = pointhaptics::fitSurface(pyramid, frame, settings, *memory, &slopes);
    Vec3 point;
    Vec3 normal;
    pointAt(fit, frame, 0.0, 0.0, point, normal);
    frame.origin = point;
    frame.turnTo(normal);
  }
  const SurfaceFit plain = fitOnce(pyramid, frame, settings);
  const SurfaceFit traced = pointhaptics::fitSurface(pyramid, frame, settings, *memory, &slopes);
  // The traced surface near by: the same fit from moved, turned frames with the radius there.
  const auto tracedHeight = [&](double u, double v)
  {
    SurfaceFrame moved = frame;
    Vec3 normal;
    pointAt(traced, frame, u, v, moved.origin, normal);
    moved.turnTo(normal);
    FitSettings there = settings;
    there.radius += dot(slopes.radiusGradient, moved.origin - frame.origin);
    const SurfaceFit other = pointhaptics::fitSurface(pyramid, moved, there, *memory, &slopes);
    return frame.toLocal(moved.toWorld({ 0.0, 0.0, other.radius * other.k[0] })).z / settings.radius;
  };
  constexpr double kStep = 1e-4;
  const double byU = (tracedHeight(kStep, 0.0) - tracedHeight(-kStep, 0.0)) / (2.0 * kStep);
  const double byV = (tracedHeight(0.0, kStep) - tracedHeight(0.0, -kStep)) / (2.0 * kStep);
  EXPECT_NEAR(traced.k[1], byU, 1e-6);
  EXPECT_NEAR(traced.k[2], byV, 1e-6);
  EXPECT_GT(std::abs(plain.k[1] - byU) + std::abs(plain.k[2] - byV), 1e-3) << "the fit's own slopes are not";
}
