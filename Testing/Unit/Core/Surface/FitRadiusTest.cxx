#include "Core/Surface/FitRadius.h"
#include "Shapes/Shapes.h"

#include "FitFixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

using namespace pointhaptics;

namespace
{

constexpr double kCloudVoxel = 1e-3 / 3;

CellPyramid resampled(const std::vector<Vec3>& points)
{
  return trial::resampled(points, kCloudVoxel);
}

CellPyramid sphere(int n, double noise, std::uint64_t seed)
{
  return resampled(trial::sphere(n, 0.025, seed, noise));
}

/// Mean weight of the cubic terms over the nodes of a shape.
double cubicShare(Shape shape, double noise)
{
  std::vector<Vec3> points;
  EXPECT_EQ(generateShape(shape, 100000, 9, noise, points), Status::Ok);
  const std::vector<LocalScale> scales = fitScales(resampled(points), 6e-3, 6e-3, trial::ThreadedExecutor(2));
  double sum = 0.0;
  for (const LocalScale& scale : scales)
  {
    EXPECT_GE(scale.cubic, 0.0);
    EXPECT_LE(scale.cubic, 1.0);
    sum += scale.cubic;
  }
  const double weight = sum / double(scales.size());
  std::printf("[ figure   ] weight of cubic terms on the %s = %.2f\n", shapeName(shape), weight);
  return weight;
}

std::vector<FitScale> scalesOf(const CellPyramid& pyramid)
{
  const auto memory = std::make_unique<FitCells>();
  std::vector<FitScale> scales;
  const std::vector<Cell>& cells = pyramid.level(0).cells;
  for (std::size_t i = 0; i < cells.size(); i += cells.size() / 40)
  {
    scales.push_back(chooseFitRadius(pyramid, cells[i].mean, 8e-3, 8e-3, *memory));
  }
  return scales;
}

template <typename Member>
double medianOf(const std::vector<FitScale>& scales, Member member)
{
  std::vector<double> values;
  for (const FitScale& scale : scales)
  {
    values.push_back(scale.*member);
  }
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

} // namespace

TEST(FitRadius, HoldsEnoughPointsAndCells)
{
  const CellPyramid pyramid = sphere(200000, 0.0, 1);
  for (const FitScale& scale : scalesOf(pyramid))
  {
    EXPECT_GE(scale.countRadius, 3.6 * kCloudVoxel * (1 - 1e-9));
    EXPECT_LE(scale.countRadius, 8e-3);
    EXPECT_GE(scale.radius, scale.countRadius);
    EXPECT_LE(scale.radius, 8e-3 * (1 + 1e-9));
  }
}

TEST(FitRadius, IsLargerWhereTheCloudIsSparse)
{
  const double dense = medianOf(scalesOf(sphere(200000, 0.0, 2)), &FitScale::countRadius);
  const double sparse = medianOf(scalesOf(sphere(10000, 0.0, 3)), &FitScale::countRadius);
  EXPECT_GT(sparse, 1.3 * dense);
}

TEST(FitRadius, GrowsWithTheNoise)
{
  const std::vector<FitScale> clean = scalesOf(sphere(200000, 0.0, 4));
  const std::vector<FitScale> noisy = scalesOf(sphere(200000, 3e-6, 4));
  const std::vector<FitScale> noisier = scalesOf(sphere(200000, 20e-6, 4));
  const double cleanRadius = medianOf(clean, &FitScale::radius);
  EXPECT_LE(cleanRadius, 1.6 * medianOf(clean, &FitScale::countRadius)) << "no growth without noise";
  EXPECT_GT(medianOf(noisy, &FitScale::radius), 1.2 * cleanRadius);
  EXPECT_GT(medianOf(noisier, &FitScale::radius), medianOf(noisy, &FitScale::radius));
  EXPECT_NEAR(medianOf(noisy, &FitScale::noise), 3e-6, 1e-6);
  EXPECT_NEAR(medianOf(noisier, &FitScale::noise), 20e-6, 7e-6);
  EXPECT_LT(medianOf(clean, &FitScale::noise), 1e-6);
}

// On a plane every radius agrees with every other: it grows to the largest, and rims are then seen too late.
TEST(FitRadius, StaysNearTheCountRadiusOnACleanPlane)
{
  trial::Random random(7);
  std::vector<Cell> cells(20000);
  for (Cell& cell : cells)
  {
    cell.mean = random.inBox({ -0.03, -0.03, 0 }, { 0.03, 0.03, 0 });
  }
  CellPyramid pyramid;
  ASSERT_EQ(pyramid.build(cells, kCloudVoxel), Status::Ok);
  const FitScale scale =
    chooseFitRadius(pyramid, pyramid.level(0).cells[10000].mean, 8e-3, 8e-3, *std::make_unique<FitCells>());
  EXPECT_LE(scale.radius, 1.6 * scale.countRadius);
}

TEST(FitScales, PreferCubicTermsWhereNoiseHidesAChangeOfCurvature)
{
  EXPECT_GT(cubicShare(Shape::Ellipsoid, 20e-6), 0.8);
  EXPECT_GT(cubicShare(Shape::Torus, 20e-6), 0.7);
  EXPECT_LT(cubicShare(Shape::Sphere, 20e-6), 0.45) << "no change of curvature: they would only add noise";
  EXPECT_EQ(cubicShare(Shape::Torus, 0.0), 0.0) << "clean clouds have them anyway";
  EXPECT_LT(cubicShare(Shape::Sheet, 20e-6), 0.1) << "the other sheet is in reach";
}

// Cells gathered for one node must not serve another, which would round otherwise.
TEST(FitScales, AreTheSameBitsHoweverTheNodesAreShared)
{
  class OneByOne : public Executor
  {
  public:
    void run(std::int64_t count, std::int64_t, void* context, Body body) const override
    {
      for (std::int64_t i = 0; i < count; ++i)
      {
        body(context, i, i + 1);
      }
    }
  };
  const CellPyramid pyramid = sphere(50000, 20e-6, 6);
  for (const FitNeeds& needs : { FitNeeds(), FitNeeds::ofFineCells() })
  {
    const std::vector<LocalScale> together = fitScales(pyramid, 8e-3, 8e-3, {}, needs);
    const std::vector<LocalScale> alone = fitScales(pyramid, 8e-3, 8e-3, OneByOne(), needs);
    ASSERT_EQ(alone.size(), together.size());
    int differ = 0;
    for (std::size_t i = 0; i < alone.size(); ++i)
    {
      differ += alone[i].radius != together[i].radius || alone[i].noise != together[i].noise ||
        alone[i].gate != together[i].gate || alone[i].cubic != together[i].cubic;
    }
    EXPECT_EQ(differ, 0) << "of " << alone.size();
  }
}

// One point a cell: over a node what small fits leave says little, over the cloud it tells shape from noise.
TEST(FitScales, AreSmallWhereBarePointsHaveShapeAndNoNoise)
{
  const auto bareRadius = [](double waves, double noise, bool finer)
  {
    trial::Random random(8);
    std::vector<Cell> cells(20000);
    for (Cell& cell : cells)
    {
      const Vec3 p = random.inBox({ -0.03, -0.03, 0 }, { 0.03, 0.03, 0 });
      cell.mean = { p.x, p.y,
        waves * std::sin(1500.0 * p.x) * std::sin(1500.0 * p.y) + noise * random.normal() };
    }
    CellPyramid pyramid;
    EXPECT_EQ(pyramid.build(cells, kCloudVoxel), Status::Ok);
    FitNeeds needs;
    needs.finerWhereShaped = finer;
    std::vector<double> radii;
    for (const LocalScale& scale : fitScales(pyramid, 8e-3, 8e-3, {}, needs))
    {
      radii.push_back(scale.radius);
    }
    std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(radii.size() / 2), radii.end());
    return radii[radii.size() / 2];
  };
  EXPECT_LT(bareRadius(2e-4, 0.0, true), 0.7 * bareRadius(2e-4, 0.0, false));
  EXPECT_GT(bareRadius(0.0, 2e-5, true), 0.85 * bareRadius(0.0, 2e-5, false));
  EXPECT_GT(bareRadius(0.0, 1e-4, true), 0.85 * bareRadius(0.0, 1e-4, false));
}
