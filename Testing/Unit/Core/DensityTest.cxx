#include "Core/Density.h"
#include "Core/Bandwidth.h"
#include "Core/Reference/ReferenceBandwidth.h"

#include "RandomClouds.h"
#include "ReferenceSamples.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pointhaptics;

namespace
{

PointView view(const std::vector<Vec3>& points)
{
  return { points.data(), std::int64_t(points.size()) };
}

std::vector<double> densitiesOf(
  const std::vector<Vec3>& points, const std::vector<double>& bandwidths, const Executor& executor = {})
{
  NeighborQuery query;
  query.build(view(points));
  std::vector<double> densities;
  surfaceDensities(view(points), query, bandwidths, densities, executor);
  EXPECT_EQ(densities.size(), points.size());
  return densities;
}

} // namespace

TEST(GaussianDensity, MatchesTheReferenceValuesOfOldFaithful)
{
  const std::vector<double>& x = samples::kEruptions;
  const double h = samples::kExpected[0].nrd0;
  const std::int64_t n = std::int64_t(x.size());
  EXPECT_NEAR(gaussianDensity(2.0, x.data(), n, h), 0.341540218346, 1e-11);
  EXPECT_NEAR(gaussianDensity(3.0, x.data(), n, h), 0.0642488565885, 1e-11);
  EXPECT_NEAR(gaussianDensity(4.5, x.data(), n, h), 0.469853495901, 1e-11);
}

TEST(GaussianDensity, IntegratesToOne)
{
  const std::vector<double>& x = samples::kPrecipitation;
  double sum = 0.0;
  for (double at = -60; at < 140; at += 0.05)
  {
    sum += 0.05 * gaussianDensity(at, x.data(), std::int64_t(x.size()), 3.8);
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(GaussianDensity, IsZeroForNoSampleOrNoBandwidth)
{
  const double x = 1.0;
  EXPECT_EQ(gaussianDensity(0.0, nullptr, 0, 1.0), 0.0);
  EXPECT_EQ(gaussianDensity(0.0, &x, 1, 0.0), 0.0);
  EXPECT_EQ(gaussianDensity(0.0, &x, 1, -1.0), 0.0);
  EXPECT_EQ(gaussianDensity(0.0, &x, 1, NAN), 0.0);
}

TEST(SurfaceDensities, MatchTheDirectSumToTheStatedTruncation)
{
  const std::vector<Vec3> points = trial::randomBox(4000, 41, { 0, 0, 0 }, { 1, 1, 0.02 });
  trial::Random random(42);
  std::vector<double> bandwidths;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    bandwidths.push_back(random.uniform(0.005, 0.1));
  }
  const std::vector<double> densities = densitiesOf(points, bandwidths);
  for (std::size_t i = 0; i < points.size(); i += 17)
  {
    const double b = bandwidths[i];
    const double direct = double(reference::surfaceDensity(view(points), points[i], b));
    const double kernelHeight = 1.0 / (2 * 3.14159265358979323846 * b * b);
    EXPECT_LE(densities[i], direct * (1 + 1e-12));
    EXPECT_LE(direct - densities[i], 1.6e-8 * kernelHeight + 1e-12 * direct);
  }
}

TEST(SurfaceDensities, FindTheDensityOfAUniformSquare)
{
  const std::vector<Vec3> points = trial::randomBox(40000, 43, { 0, 0, 0 }, { 2, 2, 0 });
  const std::vector<double> densities = densitiesOf(points, std::vector<double>(points.size(), 0.05));
  double sum = 0.0;
  int inner = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3& p = points[i];
    if (p.x > 0.4 && p.x < 1.6 && p.y > 0.4 && p.y < 1.6)
    {
      sum += densities[i];
      ++inner;
    }
  }
  EXPECT_NEAR(sum / inner, 0.25, 0.005) << "one over the area";
}

TEST(SurfaceDensities, GiveZeroWhereThereIsNothingToSum)
{
  std::vector<Vec3> points = trial::randomBox(50, 44, { 0, 0, 0 }, { 1, 1, 0 });
  points[1].x = NAN;
  std::vector<double> bandwidths(50, 0.1);
  bandwidths[2] = 0.0;
  bandwidths[3] = -1.0;
  bandwidths[4] = NAN;
  const std::vector<double> densities = densitiesOf(points, bandwidths);
  for (const std::size_t i : { 1, 2, 3, 4 })
  {
    EXPECT_EQ(densities[i], 0.0) << i;
  }
  EXPECT_GT(densities[0], 0.0);
  EXPECT_TRUE(densitiesOf({}, {}).empty());
}

TEST(SurfaceDensities, OfALonePointIsTheKernelsHeight)
{
  const std::vector<double> densities = densitiesOf({ { 5, 6, 7 } }, { 0.5 });
  EXPECT_NEAR(densities[0], 1.0 / (2 * 3.14159265358979323846 * 0.25), 1e-12);
}

TEST(SurfaceDensities, DoNotDependOnTheExecutor)
{
  const std::vector<Vec3> points = trial::randomBox(5000, 45, { 0, 0, 0 }, { 1, 1, 0 });
  const std::vector<double> bandwidths(points.size(), 0.03);
  EXPECT_EQ(densitiesOf(points, bandwidths), densitiesOf(points, bandwidths, trial::ThreadedExecutor(3)));
}
