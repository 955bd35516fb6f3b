#include "Core/SurfaceFit.h"
#include "Core/VoxelMean.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace pointhaptics;

namespace
{

/// z = c0 + c1 x + c2 y + c3 xx + c4 xy + c5 yy in the given frame.
struct Quadric
{
  double c[6];
  double height(double x, double y) const
  {
    return c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y;
  }
};

std::vector<Vec3> sampled(
  const Quadric& q, const SurfaceFrame& frame, double halfWidth, int n, std::uint64_t seed)
{
  trial::Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
  {
    const double x = random.uniform(-halfWidth, halfWidth);
    const double y = random.uniform(-halfWidth, halfWidth);
    points.push_back(frame.toWorld({ x, y, q.height(x, y) }));
  }
  return points;
}

SurfaceFit fitSurface(const CellPyramid& pyramid, const SurfaceFrame& frame, const FitSettings& settings)
{
  const auto memory = std::make_unique<FitCells>();
  return pointhaptics::fitSurface(pyramid, frame, settings, *memory);
}

CellPyramid resampled(const std::vector<Vec3>& points, double voxelSize)
{
  const PointView view(points.data(), std::int64_t(points.size()));
  LatticeSettings settings;
  settings.voxelSize = voxelSize;
  Lattice lattice;
  EXPECT_EQ(makeLattice(settings, transformedBounds(view, {}), lattice), Status::Ok);
  VoxelMeans means;
  EXPECT_EQ(voxelMeans(view, {}, lattice, true, means), Status::Ok);
  std::vector<Cell> cells(means.keys.size());
  for (std::size_t v = 0; v < cells.size(); ++v)
  {
    cells[v].mean = means.means[v];
    cells[v].count = double(means.counts[v]);
    cells[v].covariance = means.covariances[v];
  }
  CellPyramid pyramid;
  std::vector<std::uint32_t> source;
  EXPECT_EQ(pyramid.build(std::move(cells), voxelSize, source), Status::Ok);
  return pyramid;
}

SurfaceFrame frameAlong(const Vec3& normal, const Vec3& origin)
{
  SurfaceFrame frame;
  frame.origin = origin;
  frame.normal = normal;
  frame.a = anyPerpendicular(normal);
  frame.b = cross(normal, frame.a);
  return frame;
}

std::vector<Vec3> sphere(int n, double radius, std::uint64_t seed, double noise = 0.0)
{
  trial::Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
  {
    const Vec3 direction = random.direction();
    points.push_back((radius + noise * random.normal()) * direction);
  }
  return points;
}

} // namespace

TEST(SurfaceFrame, TurnsItsTangentsAlongAndStaysOrthonormal)
{
  trial::Random random(1);
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
  trial::Random random(2);
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
        const SurfaceFit fit = fitSurface(pyramid, frame, settings);
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
  trial::Random random(12);
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
  std::vector<std::uint32_t> source;
  ASSERT_EQ(pyramid.build(std::move(cells), kRadius / 40.0, source), Status::Ok);
  const auto memory = std::make_unique<FitCells>();
  FitSettings settings;
  settings.radius = kRadius;
  TracedSlopes slopes;
  slopes.strength = 1.0;
  const SurfaceFit traced = pointhaptics::fitSurface(pyramid, frame, settings, *memory, &slopes);
  const SurfaceFit quadric = fitSurface(pyramid, frame, settings);
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
  std::vector<std::uint32_t> source;
  ASSERT_EQ(pyramid.build(std::move(cells), 1e-4, source), Status::Ok);
  FitSettings settings;
  settings.radius = 2e-3;
  const SurfaceFit fit = fitSurface(pyramid, frame, settings);
  ASSERT_EQ(fit.quality, FitQuality::Quadric);
  EXPECT_LE(fit.residual, 1e-10);
}

TEST(SurfaceFit, CentroidIsZeroInsideAndKnownOnAStraightRim)
{
  const SurfaceFrame frame;
  trial::Random random(4);
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
  const SurfaceFit inside = fitSurface(resampled(full, 5e-4), frame, settings);
  EXPECT_NEAR(inside.centroidU, 0.0, 0.01);
  EXPECT_NEAR(inside.centroidV, 0.0, 0.01);
  const SurfaceFit rim = fitSurface(resampled(half, 5e-4), frame, settings);
  // 0.2352 for a continuous half disc; the cells are a third of the radius wide.
  EXPECT_NEAR(rim.centroidU, 0.235, 0.03);
  EXPECT_NEAR(rim.centroidV, 0.0, 0.01);
}

TEST(SurfaceFit, GateLeavesOutTheSheetBelow)
{
  trial::Random random(5);
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
  const SurfaceFit fit = fitSurface(pyramid, SurfaceFrame(), settings);
  EXPECT_NE(fit.quality, FitQuality::None);
  EXPECT_NEAR(fit.k[0] * fit.radius, 0.0, 1e-7);
  settings.gate = 0.0;
  const SurfaceFit blind = fitSurface(pyramid, SurfaceFrame(), settings);
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
  EXPECT_EQ(fitSurface(resampled(line, 3e-4), SurfaceFrame(), settings).quality, FitQuality::None);
  SurfaceFrame far;
  far.origin = { 5, 5, 5 };
  EXPECT_EQ(fitSurface(resampled(line, 3e-4), far, settings).quality, FitQuality::None);
  const std::vector<Vec3> two{ { 0, 0, 0 }, { 1e-3, 0, 0 } };
  EXPECT_EQ(fitSurface(resampled(two, 3e-4), SurfaceFrame(), settings).quality, FitQuality::None);
}

TEST(SurfaceFit, WithFewPointsIsAPlane)
{
  const std::vector<Vec3> few{ { 0, 0, 0 }, { 1e-3, 0, 0 }, { 0, 1e-3, 0 }, { -1e-3, 0, 0 },
    { 0, -1e-3, 0 } };
  FitSettings settings;
  settings.radius = 3e-3;
  const SurfaceFit fit = fitSurface(resampled(few, 3e-4), SurfaceFrame(), settings);
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
  trial::Random random(12);
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

TEST(FootPoint, IsTheNearestPointOfTheFit)
{
  trial::Random random(7);
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
  trial::Random random(8);
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

TEST(PrincipalNormal, IsThatOfAPlane)
{
  const Vec3 n = normalized({ 1, 2, -3 });
  const std::vector<Vec3> points =
    sampled({ { 0, 0, 0, 0, 0, 0 } }, frameAlong(n, { 0.1, 0.2, 0.3 }), 0.01, 5000, 9);
  Vec3 normal;
  ASSERT_TRUE(principalNormal(resampled(points, 5e-4), { 0.1, 0.2, 0.3 }, 3e-3, normal));
  EXPECT_NEAR(std::fabs(dot(n, normal)), 1.0, 1e-9);
}

TEST(PrincipalNormal, RefusesLinesAndEmptiness)
{
  std::vector<Vec3> line;
  for (int i = 0; i < 100; ++i)
  {
    line.emplace_back(i * 1e-4, 0.0, 0.0);
  }
  Vec3 normal;
  EXPECT_FALSE(principalNormal(resampled(line, 3e-4), { 5e-3, 0, 0 }, 3e-3, normal));
  EXPECT_FALSE(principalNormal(resampled(line, 3e-4), { 1, 1, 1 }, 3e-3, normal));
}

TEST(SettleOnSurface, FindsTheSphereItsNormalAndItsCurvature)
{
  const CellPyramid pyramid = resampled(sphere(300000, 0.025, 10), 1e-3 / 3);
  const auto memory = std::make_unique<FitCells>();
  trial::Random random(11);
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

TEST(SurfaceFit, TracedSlopesAreThoseOfTheSurfaceThatTheMovingFitTraces)
{
  // No quadric: only there do the fit's own slopes differ from those of what it traces.
  trial::Random random(31);
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
  const SurfaceFit plain = fitSurface(pyramid, frame, settings);
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
