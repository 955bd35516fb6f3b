#include "Core/Bandwidth/SheatherJones.h"
#include "Core/Bandwidth/Bandwidth.h"
#include "Core/Reference/ReferenceKernelSum.h"

#include "RandomSamples.h"
#include "ReferenceSamples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace pointhaptics;

namespace
{

double bandwidthOf(std::vector<double> sample)
{
  const SampleSpread spread = sampleSpread(sample);
  double b = 0.0;
  EXPECT_EQ(sheatherJones(sample.data(), spread.count, spread.robustDeviation(1.349), b), Status::Ok);
  return b;
}

} // namespace

TEST(SheatherJones, MatchesRAsFarAsItsDigitsGo)
{
  for (const samples::Expected& expected : samples::kExpected)
  {
    if (expected.solveTheEquation > 0.0)
    {
      EXPECT_NEAR(bandwidthOf(expected.sample), expected.solveTheEquation, 5.1e-11);
    }
  }
}

TEST(SheatherJones, MatchesTheLongDoubleSumsForSamplesOfEveryKind)
{
  trial::Random random(21);
  for (int trial = 0; trial < 60; ++trial)
  {
    // All but the constant kind.
    const int kind = trial % (trial::kNumberOfSampleKinds - 1);
    const std::vector<double> sample = trial::randomSample(10 + random.below(120), kind, std::uint64_t(trial),
      random.uniform(-10, 10), trial::randomMagnitude(random, 1e-9, 1e9));
    const reference::SheatherJonesOracle oracle(sample);
    EXPECT_NEAR(bandwidthOf(sample) / double(oracle.solveTheEquation()), 1.0, 1e-9) << "kind " << kind;
  }
}

TEST(SheatherJones, FindsTheBestBandwidthOfALargeNormalSample)
{
  // The mean integrated squared error is least at (4/3)^(1/5) s n^(-1/5). Sums pair by pair would take
  // minutes.
  const std::size_t n = 400000;
  const double best = std::pow(4.0 / 3.0, 0.2) * std::pow(double(n), -0.2);
  EXPECT_NEAR(bandwidthOf(trial::randomSample(n, 1, 22)) / best, 1.0, 0.05);
}

TEST(SheatherJones, IsMuchSmallerThanTheNormalReferenceForClustersFarApart)
{
  trial::Random random(23);
  std::vector<double> sample;
  for (int i = 0; i < 2000; ++i)
  {
    sample.push_back(random.normal() + (i % 2 == 0 ? 0.0 : 40.0));
  }
  // The clusters alone ask for (4/3 / 1000)^(1/5) = 0.266; the spread of both for 4.6.
  const double b = bandwidthOf(sample);
  EXPECT_GT(b, 0.2);
  EXPECT_LT(b, 0.5);
}

TEST(SheatherJones, TakesTheSolutionNearestToItsStartWhereThereAreSeveral)
{
  // Solutions, as parts of the start 1.144 s n^(-1/5): 0.748, 0.664, 0.402; and 1.066, 0.793, 0.337.
  const struct
  {
    std::vector<double> sample;
    double ofStart;
  } expected[] = {
    { { -1.35, -1.35, 0.96, 1.73, 3.39, 3.39, 3.39, 3.4, 5.1, 5.1 }, 0.748 },
    { { 1.73, 1.75, 3.41, 3.41, 5.1 }, 1.066 },
  };
  for (const auto& line : expected)
  {
    std::vector<double> sample = line.sample;
    const double start =
      1.144 * sampleSpread(sample).robustDeviation(1.349) * std::pow(double(sample.size()), -0.2);
    const double b = bandwidthOf(sample);
    EXPECT_NEAR(b / start, line.ofStart, 0.03);
    EXPECT_NEAR(b / double(reference::SheatherJonesOracle(sample).solveTheEquation()), 1.0, 1e-9);
  }
}

TEST(SheatherJones, OfADegenerateSampleHasAStatusAndTouchesNothing)
{
  const double same[] = { 5, 5, 5 };
  double b = 7.0;
  EXPECT_EQ(sheatherJones(same, 3, 0.0, b), Status::DegenerateSample);
  EXPECT_EQ(sheatherJones(same, 3, NAN, b), Status::DegenerateSample);
  EXPECT_EQ(sheatherJones(same, 3, INFINITY, b), Status::DegenerateSample);
  EXPECT_EQ(sheatherJones(same, 1, 1.0, b), Status::DegenerateSample);
  EXPECT_EQ(sheatherJones(nullptr, 0, 1.0, b), Status::DegenerateSample);
  EXPECT_EQ(b, 7.0);
}

TEST(SheatherJones, TellsAnEquationItCannotSolveFromASampleWithoutSpread)
{
  // Two denormal steps apart: the solution would be below the least double number.
  const double least = std::numeric_limits<double>::denorm_min();
  const double sample[] = { 0.0, 2.0 * least };
  double b = 7.0;
  EXPECT_EQ(sheatherJones(sample, 2, least, b), Status::EquationUnsolved);
  EXPECT_EQ(b, 7.0);
}
