#include "Core/Bandwidth/EpanechnikovSum.h"
#include "Core/Reference/ReferenceKernelSum.h"

#include "RandomSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;

namespace
{

EpanechnikovSum built(const std::vector<double>& sample, double w)
{
  EpanechnikovSum sum;
  EXPECT_EQ(sum.build(sample.data(), std::int64_t(sample.size()), w), Status::Ok);
  EXPECT_EQ(sum.size(), std::int64_t(sample.size()));
  return sum;
}

/// Error over the number of values under the kernel, one more counted for a value at its very edge.
double errorAt(const EpanechnikovSum& sum, const std::vector<double>& sample, double w, double target)
{
  std::int64_t inside = 0;
  const long double exact = reference::epanechnikovSum(sample, w, target, inside);
  return double(std::fabs(sum.sum(target) - exact)) / double(inside + 1);
}

std::vector<double> targetsOf(const std::vector<double>& sample, double w, std::uint64_t seed)
{
  trial::Random random(seed);
  std::vector<double> targets;
  for (int i = 0; i < 20; ++i)
  {
    const double value = sample[random.below(sample.size())];
    targets.insert(targets.end(), { value, value + w, value - w, value + w * random.uniform(-1.1, 1.1) });
  }
  return targets;
}

} // namespace

TEST(EpanechnikovSum, StaysWithinItsErrorBoundForSamplesOfEveryKind)
{
  trial::Random random(61);
  for (int trial = 0; trial < 150; ++trial)
  {
    const int kind = trial % trial::kNumberOfSampleKinds;
    const std::size_t n = 1 + random.below(3000);
    const double scale = trial::randomMagnitude(random, 1e-9, 1e9);
    const double offset = trial % 3 == 0 ? 0.0 : random.uniform(-1e6, 1e6);
    const double w = scale * trial::randomMagnitude(random, 1e-4, 1e2);
    const std::vector<double> sample = trial::randomSample(n, kind, std::uint64_t(trial), offset, scale);
    const EpanechnikovSum sum = built(sample, w);
    for (const double target : targetsOf(sample, w, 1000 + std::uint64_t(trial)))
    {
      EXPECT_LE(errorAt(sum, sample, w, target), 1e-14)
        << "kind " << kind << ", n " << n << ", w " << w / scale << ", target " << target / scale;
    }
  }
}

TEST(EpanechnikovSum, KeepsItsDigitsAtTheEndOfALongRunningSum)
{
  // 200,000 values in one cell, of which the kernel at the target has the last few dozen.
  std::vector<double> sample = trial::randomSample(200000, 0, 62);
  std::sort(sample.begin(), sample.end());
  const EpanechnikovSum sum = built(sample, 1.0);
  for (const int values : { 9, 20, 50, 400 })
  {
    const double target = sample[sample.size() - std::size_t(values)] + 0.999999;
    EXPECT_LE(errorAt(sum, sample, 1.0, target), 1e-14) << values;
  }
}

TEST(EpanechnikovSum, OfOneValueIsTheKernel)
{
  const EpanechnikovSum sum = built({ 3.0 }, 2.0);
  EXPECT_EQ(sum.sum(3.0), 1.0);
  EXPECT_EQ(sum.sum(4.0), 0.75);
  EXPECT_EQ(sum.sum(2.0), 0.75);
  EXPECT_EQ(sum.sum(5.0), 0.0);
  EXPECT_EQ(sum.sum(1.0), 0.0);
  EXPECT_EQ(sum.sum(9.0), 0.0);
  EXPECT_DOUBLE_EQ(sum.density(4.0), 0.75 * 0.75 / 2.0);
}

TEST(EpanechnikovSum, IntegratesToOne)
{
  const EpanechnikovSum sum = built(trial::randomSample(300, 2, 63), 0.2);
  double integral = 0.0;
  for (double y = -5.0; y < 10.0; y += 1e-3)
  {
    integral += 1e-3 * sum.density(y);
  }
  EXPECT_NEAR(integral, 1.0, 1e-5);
}

TEST(EpanechnikovSum, DoesNotDependOnTheOrderOfTheValues)
{
  const std::vector<double> sample = trial::randomSample(5000, 4, 64);
  const EpanechnikovSum sum = built(sample, 0.3);
  const EpanechnikovSum other = built(trial::shuffled(sample, 65), 0.3);
  for (const double target : targetsOf(sample, 0.3, 66))
  {
    EXPECT_EQ(sum.sum(target), other.sum(target));
  }
}

TEST(EpanechnikovSum, SurvivesExtremeHalfWidths)
{
  std::vector<double> sample(500, 1.0);
  sample.insert(sample.end(), 300, 1.0 + 0x1p-52);
  for (const double w : { 1e-320, 1e-300, 1e-20 })
  {
    EXPECT_EQ(built(sample, w).sum(1.0), 500.0) << w;
    EXPECT_EQ(built(sample, w).sum(1.5), 0.0) << w;
  }
  EXPECT_NEAR(built(sample, 1e300).sum(-1e200), 800.0, 1e-10);
}

TEST(EpanechnikovSum, RefusesWhatIsNotANumber)
{
  EpanechnikovSum sum;
  const double good[] = { 1.0, 2.0 };
  for (const double bad : { 0.0, -1.0, double(NAN), double(INFINITY) })
  {
    EXPECT_EQ(sum.build(good, 2, bad), Status::InvalidParameter) << bad;
    EXPECT_EQ(sum.sum(1.0), 0.0);
  }
  const double sample[] = { 1.0, NAN };
  EXPECT_EQ(sum.build(sample, 2, 1.0), Status::InvalidParameter);
  EXPECT_EQ(sum.build(nullptr, 0, 1.0), Status::Empty);
  EXPECT_EQ(sum.density(1.0), 0.0);
  ASSERT_EQ(sum.build(good, 2, 1.0), Status::Ok);
  EXPECT_EQ(sum.sum(NAN), 0.0);
  EXPECT_EQ(sum.sum(INFINITY), 0.0);
}
