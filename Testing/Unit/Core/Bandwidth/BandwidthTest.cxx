#include "Core/Bandwidth/Bandwidth.h"
#include "Core/Reference/ReferenceBandwidth.h"

#include "RandomSamples.h"
#include "ReferenceSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace pointhaptics;

namespace
{

/// Rules that need no more than the spread.
const BandwidthRule kSpreadRules[] = { BandwidthRule::NormalReference, BandwidthRule::SilvermanRobust,
  BandwidthRule::ScottMultivariate, BandwidthRule::SilvermanMultivariate };
const BandwidthRule kRules[] = { BandwidthRule::NormalReference, BandwidthRule::SilvermanRobust,
  BandwidthRule::ScottMultivariate, BandwidthRule::SilvermanMultivariate, BandwidthRule::SheatherJones };

double bandwidthOf(BandwidthRule rule, const std::vector<double>& sample)
{
  std::vector<double> scratch;
  double b = 0.0;
  EXPECT_EQ(sampleBandwidth(rule, sample.data(), std::int64_t(sample.size()), scratch, b), Status::Ok);
  return b;
}

} // namespace

TEST(SampleSpread, MatchesR)
{
  for (const samples::Expected& expected : samples::kExpected)
  {
    std::vector<double> values = expected.sample;
    const SampleSpread spread = sampleSpread(values);
    EXPECT_EQ(spread.count, std::int64_t(expected.sample.size()));
    EXPECT_NEAR(spread.standardDeviation / expected.standardDeviation, 1.0, 1e-9);
    EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
  }
}

TEST(SampleSpread, MatchesLongDoubleFarFromZero)
{
  trial::Random random(1);
  for (const double offset : { 0.0, 1e3, -1e6, 1e9 })
  {
    std::vector<double> values;
    for (int i = 0; i < 997; ++i)
    {
      values.push_back(offset + random.normal());
    }
    const reference::Spread expected = reference::spread(values);
    const SampleSpread spread = sampleSpread(values);
    EXPECT_NEAR(spread.standardDeviation / double(expected.standardDeviation), 1.0, 1e-9);
    EXPECT_NEAR(
      spread.interquartileRange, double(expected.interquartileRange), 1e-15 * (1 + std::fabs(offset)));
  }
}

TEST(SampleSpread, LeavesOutWhatIsNotFinite)
{
  std::vector<double> values{ 4.0, NAN, 1.0, INFINITY, 2.0, -INFINITY, NAN };
  std::vector<double> finite{ 4.0, 1.0, 2.0 };
  const SampleSpread spread = sampleSpread(values);
  const SampleSpread expected = sampleSpread(finite);
  EXPECT_EQ(spread.count, 3);
  EXPECT_EQ(spread.standardDeviation, expected.standardDeviation);
  EXPECT_EQ(spread.interquartileRange, expected.interquartileRange);
  EXPECT_EQ(values[0], 1.0);
  EXPECT_EQ(values[2], 4.0);
}

TEST(SampleSpread, NeitherOverflowsNorUnderflows)
{
  for (const double unit : { 0x1p-1070, 1e-300, 1e-150, 1e150, 1e306 })
  {
    std::vector<double> values{ 0.0, unit, 2 * unit, 3 * unit, 4 * unit };
    const SampleSpread spread = sampleSpread(values);
    EXPECT_NEAR(spread.standardDeviation / unit, std::sqrt(2.5), unit < 1e-310 ? 0.05 : 1e-14);
    EXPECT_DOUBLE_EQ(spread.interquartileRange / unit, 2.0);
  }
}

TEST(SampleSpread, OfNothingIsZero)
{
  std::vector<double> none;
  const SampleSpread spread = sampleSpread(none);
  EXPECT_EQ(spread.count, 0);
  EXPECT_EQ(spread.standardDeviation, 0.0);
  EXPECT_EQ(spread.interquartileRange, 0.0);
}

TEST(UnivariateBandwidth, MatchesRsNrd0)
{
  for (const samples::Expected& expected : samples::kExpected)
  {
    EXPECT_NEAR(bandwidthOf(BandwidthRule::SilvermanRobust, expected.sample) / expected.nrd0, 1.0, 1e-9);
  }
}

TEST(UnivariateBandwidth, MatchesRsNrdWithItsRobustSpread)
{
  for (const samples::Expected& expected : samples::kExpected)
  {
    std::vector<double> values = expected.sample;
    const SampleSpread spread = sampleSpread(values);
    const double s = std::min(spread.standardDeviation, spread.interquartileRange / 1.34);
    double b = 0.0;
    ASSERT_EQ(bandwidth(BandwidthRule::NormalReference, s, double(spread.count), 1, b), Status::Ok);
    EXPECT_NEAR(b / expected.nrd, 1.0, 1e-9);
  }
}

TEST(UnivariateBandwidth, FallsBackToTheDeviationWhereTheQuartilesCoincide)
{
  std::vector<double> values(20, 1.0);
  values[0] = 3.0;
  const SampleSpread spread = sampleSpread(values);
  ASSERT_EQ(spread.interquartileRange, 0.0);
  const double b = bandwidthOf(BandwidthRule::SilvermanRobust, values);
  EXPECT_NEAR(b, 0.9 * spread.standardDeviation * std::pow(20.0, -0.2), 1e-14);
}

TEST(Bandwidth, IsTheFactorOfEachRuleInEachDimension)
{
  // Worked out by hand for n = 32: 32^(-1/5) = 1/2; (32 * 3/4)^(-1/5), 32^(-1/6), 32^(-1/7), (32 *
  // 5/4)^(-1/7).
  const struct
  {
    BandwidthRule rule;
    int dimensions;
    double factor;
  } expected[] = {
    { BandwidthRule::NormalReference, 1, 0.53 },
    { BandwidthRule::NormalReference, 2, 0.53 },
    { BandwidthRule::SilvermanRobust, 1, 0.45 },
    { BandwidthRule::ScottMultivariate, 1, 0.5 },
    { BandwidthRule::ScottMultivariate, 2, 0.56123102415468651 },
    { BandwidthRule::ScottMultivariate, 3, 0.60950682710223767 },
    { BandwidthRule::SilvermanMultivariate, 1, 0.5296119205244061 },
    { BandwidthRule::SilvermanMultivariate, 2, 0.56123102415468651 },
    { BandwidthRule::SilvermanMultivariate, 3, 0.5903836027749966 },
  };
  for (const auto& line : expected)
  {
    double b = 0.0;
    ASSERT_EQ(bandwidth(line.rule, 2.0, 32, line.dimensions, b), Status::Ok);
    EXPECT_NEAR(b / (2.0 * line.factor), 1.0, 1e-14) << int(line.rule) << " in " << line.dimensions;
  }
}

TEST(Bandwidth, RefusesSamplesWithoutSpread)
{
  for (const BandwidthRule rule : kSpreadRules)
  {
    for (const double s : { 0.0, -1.0, double(NAN), double(INFINITY) })
    {
      double b = 7.0;
      EXPECT_EQ(bandwidth(rule, s, 100, 2, b), Status::DegenerateSample) << s;
      EXPECT_EQ(b, 7.0);
    }
    for (const double n : { 1.0, 0.0, double(NAN), double(INFINITY) })
    {
      double b = 7.0;
      EXPECT_EQ(bandwidth(rule, 1.0, n, 2, b), Status::DegenerateSample) << n;
      EXPECT_EQ(b, 7.0);
    }
    for (const int d : { 0, 4, -1 })
    {
      double b = 7.0;
      EXPECT_EQ(bandwidth(rule, 1.0, 100, d, b), Status::InvalidParameter) << d;
      EXPECT_EQ(b, 7.0);
    }
    double b = 7.0;
    EXPECT_NE(bandwidth(rule, 5e-324, 1e9, 1, b) == Status::Ok, b == 7.0) << "where the product underflows";
  }
}

TEST(SampleBandwidth, ScalesAndShiftsWithTheSampleWhateverItsOrder)
{
  for (const BandwidthRule rule : kRules)
  {
    for (const int kind : { 0, 1, 2, 4 })
    {
      const std::vector<double> sample = trial::randomSample(200, kind, 51);
      const double b = bandwidthOf(rule, sample);
      EXPECT_EQ(bandwidthOf(rule, trial::shuffled(sample, 52)), b);
      for (const double scale : { 1e-9, 0.3, 1e9, 0x1p-900, 0x1p900 })
      {
        const std::vector<double> scaled = trial::randomSample(200, kind, 51, 0.0, scale);
        EXPECT_NEAR(bandwidthOf(rule, scaled) / (scale * b), 1.0, 1e-9) << int(rule) << " " << scale;
      }
      for (const double offset : { -3.0, 1e3 })
      {
        const std::vector<double> moved = trial::randomSample(200, kind, 51, offset);
        EXPECT_NEAR(bandwidthOf(rule, moved) / b, 1.0, 1e-9) << int(rule) << " " << offset;
      }
    }
  }
}

TEST(SampleBandwidth, DegenerateSamplesHaveAStatusAndTouchNothing)
{
  std::vector<double> scratch;
  for (const BandwidthRule rule : kRules)
  {
    for (const std::vector<double>& sample : { std::vector<double>{}, std::vector<double>{ 5 },
           std::vector<double>(10, 5.0), std::vector<double>{ 3, 3 }, std::vector<double>{ -1e308, 1e308 } })
    {
      double b = 7.0;
      EXPECT_EQ(sampleBandwidth(rule, sample.data(), std::int64_t(sample.size()), scratch, b),
        Status::DegenerateSample);
      EXPECT_EQ(b, 7.0);
    }
    for (const double bad : { double(NAN), double(INFINITY), -double(INFINITY) })
    {
      const double sample[] = { 1.0, bad, 2.0, 4.0, bad };
      double b = 7.0;
      EXPECT_EQ(sampleBandwidth(rule, sample, 5, scratch, b), Status::InvalidParameter);
      EXPECT_EQ(b, 7.0);
    }
  }
}

TEST(SampleBandwidth, OfAnUnsolvedEquationIsThatOfTheRobustRule)
{
  std::vector<double> scratch;
  const double sample[] = { 0.0, 2.0 * std::numeric_limits<double>::denorm_min() };
  double robust = 0.0;
  double b = 0.0;
  ASSERT_EQ(sampleBandwidth(BandwidthRule::SilvermanRobust, sample, 2, scratch, robust), Status::Ok);
  EXPECT_EQ(sampleBandwidth(BandwidthRule::SheatherJones, sample, 2, scratch, b), Status::EquationUnsolved);
  EXPECT_EQ(b, robust);
}

TEST(SampleBandwidth, IsUsableForEveryKindOfSample)
{
  std::vector<double> scratch;
  trial::Random random(53);
  for (int trial = 0; trial < 300; ++trial)
  {
    const int kind = trial % trial::kNumberOfSampleKinds;
    const std::vector<double> sample = trial::randomSample(random.below(60), kind, std::uint64_t(trial),
      random.uniform(-1e3, 1e3), trial::randomMagnitude(random, 1e-12, 1e12));
    for (const BandwidthRule rule : kRules)
    {
      double b = 0.0;
      const Status status = sampleBandwidth(rule, sample.data(), std::int64_t(sample.size()), scratch, b);
      EXPECT_TRUE(status != Status::Ok || (b > 0.0 && std::isfinite(b))) << int(rule) << " kind " << kind;
      EXPECT_EQ(status == Status::Ok,
        sample.size() > 1 &&
          *std::min_element(sample.begin(), sample.end()) < *std::max_element(sample.begin(), sample.end()));
    }
  }
}
