#include "Core/Bandwidth/GaussianSum.h"
#include "Core/Reference/ReferenceKernelSum.h"

#include "RandomSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

using namespace pointhaptics;

namespace
{

GaussianSum built(const std::vector<double>& sample, double h)
{
  GaussianSum sum;
  EXPECT_EQ(sum.build(sample.data(), std::int64_t(sample.size()), h), Status::Ok);
  EXPECT_EQ(sum.size(), std::int64_t(sample.size()));
  return sum;
}

/// Relative error at @p target; 0 where the sum is too small for double.
double errorAt(const GaussianSum& sum, const std::vector<double>& sample, double h, double target)
{
  const long double exact = reference::gaussianSum(sample, h, target);
  return exact > 1e-290L ? double(std::fabs(sum.sum(target) / exact - 1)) : 0.0;
}

/// Values of the sample, places between them, near the ends and out in the tails.
std::vector<double> targetsOf(const std::vector<double>& sample, double h, std::uint64_t seed)
{
  trial::Random random(seed);
  const auto ends = std::minmax_element(sample.begin(), sample.end());
  std::vector<double> targets;
  for (int i = 0; i < 12; ++i)
  {
    targets.push_back(sample[random.below(sample.size())]);
    targets.push_back(sample[random.below(sample.size())] + h * random.uniform(-1, 1));
    targets.push_back(sample[random.below(sample.size())] + h * random.uniform(-30, 30));
    targets.push_back(random.uniform(*ends.first, *ends.second));
    targets.push_back(*ends.first - h * random.uniform(0, 36));
    targets.push_back(*ends.second + h * random.uniform(0, 36));
  }
  return targets;
}

} // namespace

TEST(GaussianSum, IsWithinItsRelativeErrorForSamplesOfEveryKindInTheTailsToo)
{
  trial::Random random(81);
  for (int trial = 0; trial < 120; ++trial)
  {
    const int kind = trial % trial::kNumberOfSampleKinds;
    const std::size_t n = 1 + random.below(1500);
    const double scale = trial::randomMagnitude(random, 1e-9, 1e9);
    const double offset = trial % 3 == 0 ? 0.0 : random.uniform(-1e6, 1e6);
    const double h = scale * trial::randomMagnitude(random, 1e-4, 1e2);
    const std::vector<double> sample = trial::randomSample(n, kind, std::uint64_t(trial), offset, scale);
    const GaussianSum sum = built(sample, h);
    for (const double target : targetsOf(sample, h, 1000 + std::uint64_t(trial)))
    {
      EXPECT_LE(errorAt(sum, sample, h, target), 1e-12)
        << "kind " << kind << ", n " << n << ", h " << h / scale << ", target " << target / scale;
    }
  }
}

TEST(GaussianSum, KeepsTheErrorItWasAskedFor)
{
  const std::vector<double> sample = trial::randomSample(900, 1, 87);
  double worst = 0.0;
  for (const double epsilon : { 1e-3, 1e-6, 1e-9 })
  {
    for (const double h : { 0.3, 0.01 })
    {
      GaussianSum sum;
      ASSERT_EQ(sum.build(sample.data(), 900, h, epsilon), Status::Ok);
      for (const double target : targetsOf(sample, h, 88))
      {
        EXPECT_LE(errorAt(sum, sample, h, target), epsilon) << "h " << h << ", target " << target;
        worst = std::max(worst, errorAt(sum, sample, h, target));
      }
    }
  }
  EXPECT_GT(worst, 1e-9) << "a large error was allowed and not made use of";
}

TEST(GaussianSum, RefusesAnErrorOutOfRange)
{
  const double sample[] = { 1.0, 2.0 };
  GaussianSum sum;
  for (const double epsilon : { 0.0, -1.0, 1e-14, 0.2, double(NAN) })
  {
    EXPECT_EQ(sum.build(sample, 2, 1.0, epsilon), Status::InvalidParameter) << epsilon;
    EXPECT_EQ(sum.sum(1.0), 0.0);
  }
}

TEST(GaussianSum, IsRightWhereValuesAreDense)
{
  const std::vector<double> sample = trial::randomSample(20000, 1, 82);
  for (const double h : { 0.02, 0.1, 0.7, 5.0 })
  {
    const GaussianSum sum = built(sample, h);
    for (const double target : targetsOf(sample, h, 83))
    {
      EXPECT_LE(errorAt(sum, sample, h, target), 1e-13) << h << " at " << target;
    }
  }
}

TEST(GaussianSum, IsRightAllTheWayFromADenseClusterToALoneValue)
{
  // The target is near one value, while thousands of others lie at the limit of what may be left out.
  std::vector<double> sample = trial::randomSample(20000, 0, 84, 0.0, 0.2);
  for (const double lone : { 6.0, 8.0, 9.0, 10.0, 12.0, 40.0 })
  {
    sample.push_back(lone);
    const GaussianSum sum = built(sample, 1.0);
    for (double target = -30.0; target < 60.0; target += 0.37)
    {
      EXPECT_LE(errorAt(sum, sample, 1.0, target), 1e-12) << lone << " at " << target;
    }
    sample.pop_back();
  }
}

TEST(GaussianSum, ReachesAsFarAsManyValuesAreFelt)
{
  for (double distance = 5.0; distance < 11.0; distance += 0.1)
  {
    std::vector<double> sample(2000, 0.0);
    sample.insert(sample.end(), 50000, distance);
    const GaussianSum sum = built(sample, 1.0);
    for (const double target : { 0.0, 0.2, -0.2, -0.4, -1.5 })
    {
      const long double far = distance - target;
      const long double near = target;
      const long double exact = 2000 * std::exp(-near * near / 2) + 50000 * std::exp(-far * far / 2);
      EXPECT_NEAR(sum.sum(target) / double(exact), 1.0, 2e-13) << distance << " from " << target;
    }
  }
}

TEST(GaussianSum, OfOneValueIsTheKernel)
{
  const GaussianSum sum = built({ 3.0 }, 0.5);
  EXPECT_EQ(sum.sum(3.0), 1.0);
  EXPECT_NEAR(sum.sum(3.5), std::exp(-0.5), 1e-16);
  EXPECT_NEAR(sum.sum(3.0 - 15.0) / std::exp(-450.0), 1.0, 1e-12);
  EXPECT_NEAR(sum.density(3.5), std::exp(-0.5) / (0.5 * std::sqrt(2 * 3.14159265358979323846)), 1e-15);
  EXPECT_EQ(sum.sum(3.0 + 20.0), 0.0) << "40 bandwidths";
}

TEST(GaussianSum, DoesNotDependOnTheOrderOfTheValues)
{
  for (int kind = 0; kind < trial::kNumberOfSampleKinds; ++kind)
  {
    const std::vector<double> sample = trial::randomSample(5000, kind, 85);
    const GaussianSum sum = built(sample, 0.05);
    const GaussianSum other = built(trial::shuffled(sample, 86), 0.05);
    for (const double target : targetsOf(sample, 0.05, 87))
    {
      EXPECT_EQ(sum.sum(target), other.sum(target));
    }
  }
}

TEST(GaussianSum, ScalesExactlyByPowersOfTwo)
{
  const std::vector<double> sample = trial::randomSample(3000, 2, 88);
  const GaussianSum sum = built(sample, 0.07);
  for (const double scale : { 0x1p-500, 0x1p-30, 0x1p30, 0x1p500 })
  {
    std::vector<double> scaled = sample;
    std::for_each(scaled.begin(), scaled.end(), [scale](double& v) { v *= scale; });
    const GaussianSum other = built(scaled, 0.07 * scale);
    for (const double target : targetsOf(sample, 0.07, 89))
    {
      EXPECT_EQ(other.sum(target * scale), sum.sum(target));
      // Not relative: far out the density underflows at the large scale.
      EXPECT_NEAR(
        other.density(target * scale) * scale, sum.density(target), 1e-15 * sum.density(target) + 1e-150);
    }
  }
}

TEST(GaussianSum, CountsDuplicatesForExtremeBandwidths)
{
  std::vector<double> sample(500, 1.0);
  sample.insert(sample.end(), 300, 1.0 + 0x1p-52);
  for (const double h : { 1e-320, 1e-300, 1e-20 })
  {
    const GaussianSum sum = built(sample, h);
    EXPECT_EQ(sum.sum(1.0), 500.0) << h;
    EXPECT_EQ(sum.sum(1.0 + 0x1p-52), 300.0) << h;
    EXPECT_EQ(sum.sum(1.5), 0.0) << h;
  }
  EXPECT_NEAR(built(sample, 1e300).sum(-1e200), 800.0, 1e-10);
}

TEST(GaussianSum, RefusesWhatIsNotANumber)
{
  GaussianSum sum;
  const double good[] = { 1.0, 2.0 };
  for (const double bad : { 0.0, -1.0, double(NAN), double(INFINITY) })
  {
    EXPECT_EQ(sum.build(good, 2, bad), Status::InvalidParameter) << bad;
    EXPECT_EQ(sum.sum(1.0), 0.0);
    EXPECT_EQ(sum.density(1.0), 0.0);
  }
  for (const double bad : { double(NAN), double(INFINITY), -double(INFINITY) })
  {
    ASSERT_EQ(sum.build(good, 2, 1.0), Status::Ok);
    EXPECT_EQ(sum.sum(bad), 0.0);
    const double sample[] = { 1.0, bad };
    EXPECT_EQ(sum.build(sample, 2, 1.0), Status::InvalidParameter);
    EXPECT_EQ(sum.sum(1.0), 0.0) << "nothing is left of the former sample";
  }
  EXPECT_EQ(sum.build(nullptr, 0, 1.0), Status::Empty);
  EXPECT_EQ(sum.density(1.0), 0.0);
}

TEST(GaussianSum, MayBeAskedFromSeveralThreads)
{
  const std::vector<double> sample = trial::randomSample(5000, 4, 90);
  const GaussianSum sum = built(sample, 0.1);
  const std::vector<double> targets = targetsOf(sample, 0.1, 91);
  std::vector<double> expected;
  for (const double target : targets)
  {
    expected.push_back(sum.sum(target));
  }
  std::vector<std::vector<double>> found(3, std::vector<double>(targets.size()));
  std::vector<std::thread> threads;
  for (std::vector<double>& mine : found)
  {
    threads.emplace_back(
      [&]() {
        std::transform(targets.begin(), targets.end(), mine.begin(), [&](double y) { return sum.sum(y); });
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const std::vector<double>& mine : found)
  {
    EXPECT_EQ(mine, expected);
  }
}
