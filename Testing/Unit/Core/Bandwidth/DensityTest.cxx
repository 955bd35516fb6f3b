#include "Core/Bandwidth/Density.h"
#include "Core/Reference/ReferenceBandwidth.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;
using trial::view;

namespace
{

std::vector<double> densitiesOf(const std::vector<Vec3>& points, const std::vector<double>& bandwidths,
  const Executor& executor = {}, DensityKernel kernel = DensityKernel::Gaussian)
{
  NeighborQuery query;
  query.build(view(points));
  std::vector<double> densities;
  surfaceDensities(view(points), {}, query, bandwidths, densities, executor, kernel);
  EXPECT_EQ(densities.size(), points.size());
  return densities;
}

} // namespace

TEST(SurfaceDensities, WithTheEpanechnikovKernelMatchTheDirectSum)
{
  const std::vector<Vec3> points = trial::randomBox(3000, 49, { 0, 0, 0 }, { 1, 1, 0.02 });
  const double b = 0.04;
  const std::vector<double> densities =
    densitiesOf(points, std::vector<double>(points.size(), b), {}, DensityKernel::Epanechnikov);
  const long double w2 = 6.0L * b * b;
  for (std::size_t i = 0; i < points.size(); i += 17)
  {
    long double sum = 0;
    for (const Vec3& p : points)
    {
      sum += std::max(0.0L, 1 - norm2(p - points[i]) / w2);
    }
    const double direct = double(sum * 2 / (3.14159265358979323846L * w2 * points.size()));
    EXPECT_NEAR(densities[i] / direct, 1.0, 1e-12);
  }
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

TEST(SurfaceDensities, DoNotDependOnTheExecutor)
{
  const std::vector<Vec3> points = trial::randomBox(5000, 45, { 0, 0, 0 }, { 1, 1, 0 });
  const std::vector<double> bandwidths(points.size(), 0.03);
  EXPECT_EQ(densitiesOf(points, bandwidths), densitiesOf(points, bandwidths, trial::ThreadedExecutor(3)));
}

TEST(SurfaceDensities, CountRepeatedPoints)
{
  const std::vector<Vec3> places = trial::randomBox(600, 52, { 0, 0, 0 }, { 1, 1, 0 });
  std::vector<Vec3> points = places;
  points.insert(points.end(), places.begin(), places.end());
  const std::vector<double> once = densitiesOf(places, std::vector<double>(600, 0.1));
  const std::vector<double> twice = densitiesOf(points, std::vector<double>(1200, 0.1));
  points.insert(points.end(), 1200, places[5]);
  const std::vector<double> crowded = densitiesOf(points, std::vector<double>(2400, 0.1));
  for (std::size_t i = 0; i < 600; ++i)
  {
    EXPECT_NEAR(twice[i] / once[i], 1.0, 1e-12);
    EXPECT_EQ(twice[i], twice[i + 600]);
    const double kernel = std::exp(-0.5 * norm2(places[i] - places[5]) / 0.01);
    const double added = 1200.0 * kernel / (2400.0 * 2.0 * 3.14159265358979323846 * 0.01);
    EXPECT_NEAR(crowded[i], 0.5 * once[i] + added, 1e-6 * crowded[5]);
  }
}

TEST(SurfaceDensities, OfMeansCountEveryPoint)
{
  trial::Random random(31);
  std::vector<Vec3> means;
  std::vector<double> counts;
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i)
  {
    means.push_back({ random.uniform(0, 1), random.uniform(0, 1), 0.0 });
    counts.push_back(1.0 + i % 5);
    points.insert(points.end(), std::size_t(counts.back()), means.back());
  }
  for (const DensityKernel kernel : { DensityKernel::Gaussian, DensityKernel::Epanechnikov })
  {
    NeighborQuery query;
    query.build(view(means));
    std::vector<double> densities;
    surfaceDensities(
      view(means), counts, query, std::vector<double>(means.size(), 0.05), densities, {}, kernel);
    const std::vector<double> expected =
      densitiesOf(points, std::vector<double>(points.size(), 0.05), {}, kernel);
    std::size_t at = 0;
    for (std::size_t i = 0; i < means.size(); ++i)
    {
      ASSERT_NEAR(densities[i] / expected[at], 1.0, 1e-12);
      at += std::size_t(counts[i]);
    }
  }
}
