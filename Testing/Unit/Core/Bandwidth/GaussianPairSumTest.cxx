#include "Core/Bandwidth/GaussianPairSum.h"
#include "Core/Reference/ReferenceKernelSum.h"

#include "RandomSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;

namespace
{

const GaussianDerivative kDerivatives[] = { GaussianDerivative::Zeroth, GaussianDerivative::Second,
  GaussianDerivative::Fourth, GaussianDerivative::Sixth };

double sumOf(const std::vector<double>& sorted, double h, GaussianDerivative derivative)
{
  GaussianPairSum sums;
  return sums.sum(sorted.data(), std::int64_t(sorted.size()), h, derivative);
}

std::vector<double> sorted(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values;
}

/// Error over |He_r(0)| n^2: the height of the summed function and the number of pairs.
double errorOf(const std::vector<double>& sample, double h, GaussianDerivative derivative)
{
  const long double exact = reference::pairSum(sample, h, int(derivative));
  const double n = double(sample.size());
  const double height = double(std::fabs(reference::gaussianDerivative(0, int(derivative))));
  return double(std::fabs(sumOf(sample, h, derivative) - exact)) / (height * n * n);
}

} // namespace

TEST(GaussianPairSum, OfOneOrTwoValuesIsTheDefinition)
{
  const double t = 0.75;
  const double height = std::exp(-0.5 * t * t);
  const double at0[] = { 1, -1, 3, -15 };
  const double atT[] = { 1, t * t - 1, std::pow(t, 4) - 6 * t * t + 3,
    std::pow(t, 6) - 15 * std::pow(t, 4) + 45 * t * t - 15 };
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_DOUBLE_EQ(sumOf({ 5.0 }, 0.1, kDerivatives[i]), at0[i]);
    EXPECT_NEAR(sumOf({ 10.0, 10.0 + 2 * t }, 2.0, kDerivatives[i]), 2 * at0[i] + 2 * atT[i] * height, 1e-14);
  }
}

TEST(GaussianPairSum, StaysWithinItsErrorBoundForSamplesOfEveryKind)
{
  trial::Random random(71);
  for (int trial = 0; trial < 150; ++trial)
  {
    const int kind = trial % trial::kNumberOfSampleKinds;
    const std::size_t n = 1 + random.below(250);
    const double scale = trial::randomMagnitude(random, 1e-9, 1e9);
    const double offset = trial % 3 == 0 ? 0.0 : random.uniform(-1e6, 1e6);
    const double h = scale * trial::randomMagnitude(random, 1e-4, 1e2);
    const std::vector<double> sample =
      sorted(trial::randomSample(n, kind, std::uint64_t(trial), offset, scale));
    for (const GaussianDerivative derivative : kDerivatives)
    {
      EXPECT_LE(errorOf(sample, h, derivative), 1e-15)
        << "kind " << kind << ", n " << n << ", h " << h / scale << ", derivative " << int(derivative);
    }
  }
}

TEST(GaussianPairSum, IsRightWhereEveryCellHasASeries)
{
  const std::vector<double> sample = sorted(trial::randomSample(1200, 1, 72));
  for (const double h : { 0.05, 0.3, 2.0 })
  {
    for (const GaussianDerivative derivative : kDerivatives)
    {
      EXPECT_LE(errorOf(sample, h, derivative), 1e-15) << h << " " << int(derivative);
      const double exact = double(reference::pairSum(sample, h, int(derivative)));
      EXPECT_NEAR(sumOf(sample, h, derivative) / exact, 1.0, 1e-10) << h << " " << int(derivative);
    }
  }
}

TEST(GaussianPairSum, CountsCoincidencesForTinyAndAllPairsForHugeBandwidths)
{
  // 9 distinct values, a quarter apart.
  const std::vector<double> sample = sorted(trial::randomSample(900, 3, 73));
  double coincidences = 0.0;
  for (const double v : sample)
  {
    coincidences += double(std::count(sample.begin(), sample.end(), v));
  }
  EXPECT_DOUBLE_EQ(sumOf(sample, 1e-3, GaussianDerivative::Zeroth), coincidences);
  EXPECT_DOUBLE_EQ(sumOf(sample, 1e-3, GaussianDerivative::Sixth), -15 * coincidences);
  EXPECT_DOUBLE_EQ(sumOf(sample, 1e12, GaussianDerivative::Zeroth), 900.0 * 900.0);
  EXPECT_DOUBLE_EQ(sumOf(sample, 1e12, GaussianDerivative::Fourth), 3 * 900.0 * 900.0);
}

TEST(GaussianPairSum, ReachesElevenBandwidths)
{
  // 50 values each, so that a pair that should count is felt.
  std::vector<double> sample(50, 0.0);
  sample.insert(sample.end(), 50, 7.5);
  for (const GaussianDerivative derivative : kDerivatives)
  {
    const double exact = double(reference::pairSum(sample, 1.0, int(derivative)));
    const double alone = double(reference::pairSum(std::vector<double>(50, 0.0), 1.0, int(derivative)));
    EXPECT_NEAR((sumOf(sample, 1.0, derivative) - 2 * alone) / (exact - 2 * alone), 1.0, 0.01)
      << int(derivative);
  }
}

TEST(GaussianPairSum, DoesNotDependOnShiftAndScaleByPowersOfTwo)
{
  // Multiples of 2^-20: exact after the shift.
  std::vector<double> sample;
  for (const double v : trial::randomSample(700, 1, 74))
  {
    sample.push_back(std::floor(v * 0x1p20) * 0x1p-20);
  }
  std::sort(sample.begin(), sample.end());
  for (const GaussianDerivative derivative : kDerivatives)
  {
    const double expected = sumOf(sample, 0.125, derivative);
    for (const double scale : { 0x1p-600, 0x1p-30, 0x1p30, 0x1p600 })
    {
      std::vector<double> moved;
      for (const double v : sample)
      {
        moved.push_back((v + 0x1p28) * scale);
      }
      EXPECT_EQ(sumOf(moved, 0.125 * scale, derivative), expected) << scale;
    }
  }
}

TEST(GaussianPairSum, DoesNotDependOnFormerCalls)
{
  GaussianPairSum used;
  const std::vector<double> large = sorted(trial::randomSample(3000, 0, 75));
  const std::vector<double> small = sorted(trial::randomSample(200, 1, 76));
  (void)used.sum(large.data(), 3000, 0.01, GaussianDerivative::Sixth);
  EXPECT_EQ(used.sum(small.data(), 200, 0.2, GaussianDerivative::Fourth),
    sumOf(small, 0.2, GaussianDerivative::Fourth));
}

TEST(GaussianPairSum, IsNeverOfTheWrongSign)
{
  // The Fourier transform of these derivatives does not change its sign, so neither do the sums.
  for (int kind = 0; kind < trial::kNumberOfSampleKinds; ++kind)
  {
    const std::vector<double> sample = sorted(trial::randomSample(300, kind, 77));
    for (const double h : { 1e-3, 0.03, 0.3 })
    {
      EXPECT_GT(sumOf(sample, h, GaussianDerivative::Zeroth), 0.0);
      EXPECT_LT(sumOf(sample, h, GaussianDerivative::Second), 0.0);
      EXPECT_GT(sumOf(sample, h, GaussianDerivative::Fourth), 0.0);
      EXPECT_LT(sumOf(sample, h, GaussianDerivative::Sixth), 0.0);
    }
  }
}

TEST(GaussianPairSum, IsZeroForNothingToSum)
{
  EXPECT_EQ(sumOf({}, 1.0, GaussianDerivative::Zeroth), 0.0);
  for (const double h : { 0.0, -1.0, double(NAN), double(INFINITY) })
  {
    EXPECT_EQ(sumOf({ 1.0, 2.0 }, h, GaussianDerivative::Fourth), 0.0) << h;
  }
}
