#include "Core/Bandwidth/GaussianPairSum.h"
#include "Core/Reference/ReferenceKernelSum.h"

#include "RandomSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;

namespace
{

const GaussianDerivative kDerivatives[] = { GaussianDerivative::Fourth, GaussianDerivative::Sixth };

/// Error over |He_r(0)| n^2: the height of the summed function and the number of pairs.
double errorOf(std::vector<double> sample, double h, GaussianDerivative derivative)
{
  std::sort(sample.begin(), sample.end());
  const long double exact = reference::pairSum(sample, h, int(derivative));
  const double n = double(sample.size());
  const double height = double(std::fabs(reference::gaussianDerivative(0, int(derivative))));
  const double sum = GaussianPairSum().sum(sample.data(), std::int64_t(sample.size()), h, derivative);
  return double(std::fabs(sum - exact)) / (height * n * n);
}

} // namespace

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
    const std::vector<double> sample = trial::randomSample(n, kind, std::uint64_t(trial), offset, scale);
    for (const GaussianDerivative derivative : kDerivatives)
    {
      EXPECT_LE(errorOf(sample, h, derivative), 1e-15)
        << "kind " << kind << ", n " << n << ", h " << h / scale << ", derivative " << int(derivative);
    }
  }
}

TEST(GaussianPairSum, IsRightWhereEveryCellHasASeries)
{
  for (const double h : { 0.05, 0.3, 2.0 })
  {
    for (const GaussianDerivative derivative : kDerivatives)
    {
      EXPECT_LE(errorOf(trial::randomSample(1200, 1, 72), h, derivative), 1e-15)
        << h << " " << int(derivative);
    }
  }
}
