#include "Core/Bandwidth/Density.h"
#include "Core/Bandwidth/Bandwidth.h"
#include "Core/Reference/ReferenceBandwidth.h"
#include "Core/Reference/ReferenceKernelSum.h"

#include "RandomClouds.h"
#include "RandomSamples.h"
#include "ReferenceSamples.h"

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
  surfaceDensities(view(points), query, bandwidths, densities, executor, kernel);
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

TEST(EpanechnikovDensity, OfOneValueIsAParabolaWithTheBandwidthAsDeviation)
{
  const double x = 1.0;
  const double h = 0.5;
  double mass = 0.0;
  double variance = 0.0;
  const double step = 1e-4;
  for (double at = -1.0; at < 3.0; at += step)
  {
    const double f = epanechnikovDensity(at, &x, 1, h);
    mass += step * f;
    variance += step * f * (at - x) * (at - x);
  }
  EXPECT_NEAR(mass, 1.0, 1e-6);
  EXPECT_NEAR(variance, h * h, 1e-6);
  EXPECT_NEAR(epanechnikovDensity(x, &x, 1, h), 0.75 / (std::sqrt(5.0) * h), 1e-15);
}

TEST(EpanechnikovDensity, IsZeroForNoSampleOrNoBandwidth)
{
  const double x = 1.0;
  EXPECT_EQ(epanechnikovDensity(0.0, nullptr, 0, 1.0), 0.0);
  EXPECT_EQ(epanechnikovDensity(1.0, &x, 1, 0.0), 0.0);
  EXPECT_EQ(epanechnikovDensity(1.0, &x, 1, NAN), 0.0);
}

TEST(UnivariateDensities, MatchTheReferenceValuesOfOldFaithful)
{
  const std::vector<double>& x = samples::kEruptions;
  const double targets[] = { 2.0, 3.0, 4.5 };
  std::vector<double> densities;
  ASSERT_EQ(univariateDensities(DensityKernel::Gaussian, x.data(), std::int64_t(x.size()),
              samples::kExpected[0].nrd0, targets, 3, densities),
    Status::Ok);
  EXPECT_NEAR(densities[0], 0.341540218346, 1e-11);
  EXPECT_NEAR(densities[1], 0.0642488565885, 1e-11);
  EXPECT_NEAR(densities[2], 0.469853495901, 1e-11);
}

TEST(UnivariateDensities, AreTheDirectSumsForBothKernels)
{
  trial::Random random(46);
  for (int trial = 0; trial < 40; ++trial)
  {
    const int kind = trial % trial::kNumberOfSampleKinds;
    const std::vector<double> sample =
      trial::randomSample(1 + random.below(2000), kind, std::uint64_t(trial));
    const double h = trial::randomMagnitude(random, 1e-3, 10.0);
    const std::int64_t n = std::int64_t(sample.size());
    std::vector<double> targets;
    for (int i = 0; i < 50; ++i)
    {
      targets.push_back(sample[random.below(sample.size())] + h * random.uniform(-6, 6));
    }
    std::vector<double> gaussian;
    std::vector<double> epanechnikov;
    ASSERT_EQ(univariateDensities(DensityKernel::Gaussian, sample.data(), n, h, targets.data(), 50, gaussian),
      Status::Ok);
    ASSERT_EQ(
      univariateDensities(DensityKernel::Epanechnikov, sample.data(), n, h, targets.data(), 50, epanechnikov),
      Status::Ok);
    for (std::size_t i = 0; i < 50; ++i)
    {
      const double direct = gaussianDensity(targets[i], sample.data(), n, h);
      EXPECT_NEAR(gaussian[i] / direct, 1.0, 1e-12) << "kind " << kind << " h " << h;
      EXPECT_NEAR(epanechnikov[i] * h, h * epanechnikovDensity(targets[i], sample.data(), n, h), 1e-13);
    }
  }
}

TEST(UnivariateDensities, DoNotDependOnTheExecutorNorOnTheOrder)
{
  const std::vector<double> sample = trial::randomSample(5000, 2, 47);
  const std::vector<double> other = trial::shuffled(sample, 48);
  for (const DensityKernel kernel : { DensityKernel::Gaussian, DensityKernel::Epanechnikov })
  {
    std::vector<double> expected;
    ASSERT_EQ(
      univariateDensities(kernel, sample.data(), 5000, 0.02, sample.data(), 5000, expected), Status::Ok);
    for (const int threads : { 1, 2, 8 })
    {
      std::vector<double> found;
      ASSERT_EQ(univariateDensities(kernel, other.data(), 5000, 0.02, sample.data(), 5000, found,
                  trial::ThreadedExecutor(threads)),
        Status::Ok);
      EXPECT_EQ(found, expected) << threads;
    }
  }
}

TEST(UnivariateDensities, AreZeroWithAStatusWhereThereIsNoAnswer)
{
  const double x[] = { 1.0, 2.0 };
  const double bad[] = { 1.0, NAN };
  for (const DensityKernel kernel : { DensityKernel::Gaussian, DensityKernel::Epanechnikov })
  {
    std::vector<double> densities(7, 5.0);
    EXPECT_EQ(univariateDensities(kernel, x, 2, 0.0, x, 2, densities), Status::InvalidParameter);
    EXPECT_EQ(densities, std::vector<double>(2, 0.0));
    EXPECT_EQ(univariateDensities(kernel, bad, 2, 1.0, x, 2, densities), Status::InvalidParameter);
    EXPECT_EQ(densities, std::vector<double>(2, 0.0));
    EXPECT_EQ(univariateDensities(kernel, nullptr, 0, 1.0, x, 2, densities), Status::Empty);
    EXPECT_EQ(densities, std::vector<double>(2, 0.0));
    EXPECT_EQ(univariateDensities(kernel, x, 2, 1.0, bad, 2, densities), Status::Ok);
    EXPECT_GT(densities[0], 0.0);
    EXPECT_EQ(densities[1], 0.0);
    EXPECT_EQ(univariateDensities(kernel, x, 2, 1.0, nullptr, 0, densities), Status::Ok);
    EXPECT_TRUE(densities.empty());
  }
}

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

TEST(SurfaceDensities, OfBothKernelsAgreeOnAUniformSquare)
{
  const std::vector<Vec3> points = trial::randomBox(10000, 50, { 0, 0, 0 }, { 2, 2, 0 });
  const std::vector<double> bandwidths(points.size(), 0.1);
  const std::vector<double> gaussian = densitiesOf(points, bandwidths);
  const std::vector<double> other = densitiesOf(points, bandwidths, {}, DensityKernel::Epanechnikov);
  double worst = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    worst = std::max(worst, std::fabs(other[i] / gaussian[i] - 1.0));
  }
  EXPECT_LT(worst, 0.2);
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
