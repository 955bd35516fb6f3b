#include "Core/LocalBandwidth.h"
#include "Core/Reference/ReferenceBandwidth.h"
#include "Core/Reference/ReferenceKernelSum.h"

#include "RandomSamples.h"
#include "ReferenceSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;

namespace
{

/// Those that need no more than the spread.
const BandwidthRule kSpreadRules[] = { BandwidthRule::NormalReference, BandwidthRule::SilvermanRobust,
  BandwidthRule::ScottMultivariate, BandwidthRule::SilvermanMultivariate };
const BandwidthRule kRules[] = { BandwidthRule::NormalReference, BandwidthRule::SilvermanRobust,
  BandwidthRule::ScottMultivariate, BandwidthRule::SilvermanMultivariate, BandwidthRule::SheatherJones };

double bandwidthOf(BandwidthRule rule, const std::vector<double>& sample)
{
  BandwidthScratch scratch;
  double b = 0.0;
  EXPECT_EQ(sampleBandwidth(rule, sample.data(), std::int64_t(sample.size()), scratch, b), Status::Ok);
  return b;
}

PointView view(const std::vector<Vec3>& points)
{
  return { points.data(), std::int64_t(points.size()) };
}

struct Local
{
  std::vector<double> bandwidths;
  std::vector<double> radii;
};

Local localOf(
  const std::vector<Vec3>& points, const LocalBandwidthSettings& settings, const Executor& executor = {})
{
  NeighborQuery query;
  query.build(view(points));
  Local result;
  EXPECT_EQ(
    localBandwidths(view(points), query, settings, result.bandwidths, result.radii, executor), Status::Ok);
  EXPECT_EQ(result.bandwidths.size(), points.size());
  EXPECT_EQ(result.radii.size(), points.size());
  return result;
}

double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// A square with sixteen times the density on its left half.
std::vector<Vec3> densityStep()
{
  std::vector<Vec3> points = trial::randomBox(16000, 31, { 0, 0, 0 }, { 1, 1, 0 });
  const std::vector<Vec3> sparse = trial::randomBox(1000, 32, { 1, 0, 0 }, { 2, 1, 0 });
  points.insert(points.end(), sparse.begin(), sparse.end());
  return points;
}

void expectUsable(const Local& local)
{
  for (std::size_t i = 0; i < local.radii.size(); ++i)
  {
    EXPECT_GT(local.radii[i], 0.0);
    EXPECT_TRUE(std::isfinite(local.radii[i]));
    EXPECT_GT(local.bandwidths[i], 0.0);
    EXPECT_TRUE(std::isfinite(local.bandwidths[i]));
  }
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
    EXPECT_NEAR(spread.mean, double(expected.mean), 1e-13 * (1 + std::fabs(offset)));
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
  EXPECT_EQ(spread.mean, expected.mean);
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
    EXPECT_NEAR(spread.mean / unit, 2.0, 1e-14);
    EXPECT_DOUBLE_EQ(spread.interquartileRange / unit, 2.0);
  }
}

TEST(SampleSpread, OfNothingIsZero)
{
  std::vector<double> none;
  const SampleSpread spread = sampleSpread(none);
  EXPECT_EQ(spread.count, 0);
  EXPECT_EQ(spread.mean, 0.0);
  EXPECT_EQ(spread.standardDeviation, 0.0);
  EXPECT_EQ(spread.interquartileRange, 0.0);
}

TEST(SampleSpread, OfOneValueIsThatValueWithoutSpread)
{
  std::vector<double> one{ 5.0 };
  const SampleSpread spread = sampleSpread(one);
  EXPECT_EQ(spread.count, 1);
  EXPECT_EQ(spread.mean, 5.0);
  EXPECT_EQ(spread.standardDeviation, 0.0);
}

TEST(UnivariateBandwidth, MatchesRsNrd0)
{
  for (const samples::Expected& expected : samples::kExpected)
  {
    std::vector<double> values = expected.sample;
    double b = 0.0;
    ASSERT_EQ(univariateBandwidth(BandwidthRule::SilvermanRobust, sampleSpread(values), b), Status::Ok);
    EXPECT_NEAR(b / expected.nrd0, 1.0, 1e-9);
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

TEST(UnivariateBandwidth, MatchesTheDefinitionForEveryRule)
{
  std::vector<double> values = samples::kEruptions;
  const SampleSpread spread = sampleSpread(values);
  for (const BandwidthRule rule : kSpreadRules)
  {
    const reference::Spread exact = reference::spread(values);
    long double s = exact.standardDeviation;
    if (rule == BandwidthRule::SilvermanRobust)
    {
      s = std::min(s, exact.interquartileRange / 1.34L);
    }
    double b = 0.0;
    ASSERT_EQ(univariateBandwidth(rule, spread, b), Status::Ok);
    EXPECT_NEAR(b / double(s * reference::bandwidthFactor(rule, 272, 1)), 1.0, 1e-12) << int(rule);
  }
}

TEST(UnivariateBandwidth, DegenerateSamplesHaveAStatusAndTheFallback)
{
  for (const BandwidthRule rule : kSpreadRules)
  {
    for (std::vector<double> values : { std::vector<double>{}, std::vector<double>{ 5 },
           std::vector<double>(10, 5.0), std::vector<double>{ 3, 3 } })
    {
      double b = 7.0;
      EXPECT_EQ(univariateBandwidth(rule, sampleSpread(values), b, 0.25), Status::DegenerateSample);
      EXPECT_EQ(b, 0.25);
      for (const double useless : { 0.0, -1.0, double(NAN), double(INFINITY) })
      {
        EXPECT_EQ(univariateBandwidth(rule, sampleSpread(values), b, useless), Status::DegenerateSample);
        EXPECT_EQ(b, kBandwidthWithoutSpread);
      }
    }
  }
}

TEST(UnivariateBandwidth, OfSheatherJonesNeedsTheValues)
{
  std::vector<double> values = samples::kEruptions;
  double b = 0.0;
  EXPECT_EQ(univariateBandwidth(BandwidthRule::SheatherJones, sampleSpread(values), b, 0.5),
    Status::InvalidParameter);
  EXPECT_EQ(b, 0.5);
}

TEST(UnivariateBandwidth, FallsBackToTheDeviationWhereTheQuartilesCoincide)
{
  std::vector<double> values(20, 1.0);
  values[0] = 3.0;
  const SampleSpread spread = sampleSpread(values);
  ASSERT_EQ(spread.interquartileRange, 0.0);
  double b = 0.0;
  ASSERT_EQ(univariateBandwidth(BandwidthRule::SilvermanRobust, spread, b), Status::Ok);
  EXPECT_NEAR(b, 0.9 * spread.standardDeviation * std::pow(20.0, -0.2), 1e-14);
}

TEST(Bandwidth, ScalesWithTheSampleAndShrinksWithItsSize)
{
  for (const BandwidthRule rule : kSpreadRules)
  {
    for (const int d : { 1, 2, 3 })
    {
      double b = 0.0;
      double scaled = 0.0;
      double larger = 0.0;
      ASSERT_EQ(bandwidth(rule, 0.25, 100, d, b), Status::Ok);
      ASSERT_EQ(bandwidth(rule, 0.5, 100, d, scaled), Status::Ok);
      ASSERT_EQ(bandwidth(rule, 0.25, 3200, d, larger), Status::Ok);
      EXPECT_NEAR(b / double(0.25L * reference::bandwidthFactor(rule, 100, d)), 1.0, 1e-13);
      EXPECT_NEAR(scaled, 2 * b, 1e-14);
      EXPECT_LT(larger, b);
    }
  }
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
      EXPECT_EQ(bandwidth(rule, s, 100, 2, b, 0.125), Status::DegenerateSample) << s;
      EXPECT_EQ(b, 0.125);
    }
    for (const double n : { 1.0, 0.0, double(NAN), double(INFINITY) })
    {
      double b = 7.0;
      EXPECT_EQ(bandwidth(rule, 1.0, n, 2, b), Status::DegenerateSample) << n;
      EXPECT_EQ(b, kBandwidthWithoutSpread);
    }
    for (const int d : { 0, 4, -1 })
    {
      double b = 7.0;
      EXPECT_EQ(bandwidth(rule, 1.0, 100, d, b), Status::InvalidParameter) << d;
      EXPECT_EQ(b, kBandwidthWithoutSpread);
    }
    double b = 7.0;
    (void)bandwidth(rule, 5e-324, 1e9, 1, b);
    EXPECT_GT(b, 0.0) << "even where the product underflows";
  }
}

TEST(SampleBandwidth, AgreesWithTheRulesThatTakeASpread)
{
  std::vector<double> values = samples::kWaiting;
  const SampleSpread spread = sampleSpread(values);
  for (const BandwidthRule rule : kSpreadRules)
  {
    double b = 0.0;
    ASSERT_EQ(univariateBandwidth(rule, spread, b), Status::Ok);
    EXPECT_EQ(bandwidthOf(rule, samples::kWaiting), b);
  }
}

TEST(SampleBandwidth, OfSheatherJonesMatchesR)
{
  for (const samples::Expected& expected : samples::kExpected)
  {
    if (expected.solveTheEquation > 0.0)
    {
      EXPECT_NEAR(
        bandwidthOf(BandwidthRule::SheatherJones, expected.sample) / expected.solveTheEquation, 1.0, 5e-10);
    }
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

TEST(SampleBandwidth, OfTwoValuesIsAPartOfTheirDistance)
{
  for (const BandwidthRule rule : kRules)
  {
    for (const double scale : { 1e-9, 1.0, 1e9 })
    {
      const double b = bandwidthOf(rule, { 5.0 * scale, 6.0 * scale });
      EXPECT_GT(b, 0.1 * scale) << int(rule);
      EXPECT_LT(b, scale) << int(rule);
    }
  }
}

TEST(SampleBandwidth, DegenerateSamplesHaveAStatusAndTheFallback)
{
  BandwidthScratch scratch;
  for (const BandwidthRule rule : kRules)
  {
    for (const std::vector<double>& sample : { std::vector<double>{}, std::vector<double>{ 5 },
           std::vector<double>(10, 5.0), std::vector<double>{ 3, 3 }, std::vector<double>{ -1e308, 1e308 } })
    {
      double b = 7.0;
      EXPECT_EQ(sampleBandwidth(rule, sample.data(), std::int64_t(sample.size()), scratch, b, 0.25),
        Status::DegenerateSample);
      EXPECT_EQ(b, 0.25);
    }
    for (const double bad : { double(NAN), double(INFINITY), -double(INFINITY) })
    {
      const double sample[] = { 1.0, bad, 2.0, 4.0, bad };
      double b = 7.0;
      EXPECT_EQ(sampleBandwidth(rule, sample, 5, scratch, b, 0.25), Status::InvalidParameter);
      EXPECT_EQ(b, 0.25);
      EXPECT_EQ(sampleBandwidth(rule, sample, 5, scratch, b), Status::InvalidParameter);
      EXPECT_EQ(b, kBandwidthWithoutSpread);
    }
  }
}

TEST(SampleBandwidth, IsUsableForEveryKindOfSample)
{
  BandwidthScratch scratch;
  trial::Random random(53);
  for (int trial = 0; trial < 300; ++trial)
  {
    const int kind = trial % trial::kNumberOfSampleKinds;
    const std::vector<double> sample = trial::randomSample(random.below(60), kind, std::uint64_t(trial),
      random.uniform(-1e3, 1e3), trial::randomMagnitude(random, 1e-12, 1e12));
    for (const BandwidthRule rule : kRules)
    {
      double b = 0.0;
      const Status status =
        sampleBandwidth(rule, sample.data(), std::int64_t(sample.size()), scratch, b, 1e-5);
      EXPECT_TRUE(b > 0.0 && std::isfinite(b)) << int(rule) << " kind " << kind;
      EXPECT_EQ(status == Status::Ok,
        sample.size() > 1 &&
          *std::min_element(sample.begin(), sample.end()) < *std::max_element(sample.begin(), sample.end()));
    }
  }
}

TEST(LocalBandwidthSettings, CheckFindsEveryMistake)
{
  const auto checked = [](auto change)
  {
    LocalBandwidthSettings settings;
    change(settings);
    return settings.check();
  };
  using S = LocalBandwidthSettings;
  EXPECT_EQ(checked([](S&) {}), Status::Ok);
  EXPECT_EQ(checked([](S& s) { s.numberOfNeighbors = 0; }), Status::InvalidNeighborhood);
  EXPECT_EQ(checked([](S& s) { s.numberOfNeighbors = -5; }), Status::InvalidNeighborhood);
  for (const double bad : { 0.0, -1.0, double(NAN), double(INFINITY) })
  {
    const auto fixed = [bad](S& s)
    {
      s.fixedRadius = true;
      s.radius = bad;
    };
    EXPECT_EQ(checked(fixed), Status::InvalidNeighborhood) << bad;
    EXPECT_NE(checked([bad](S& s) { s.radiusScale = bad; }), Status::Ok) << bad;
  }
  for (const double bad : { -1.0, double(NAN), double(INFINITY) })
  {
    EXPECT_EQ(checked([bad](S& s) { s.minimumRadius = bad; }), Status::InvalidRadiusBounds) << bad;
  }
  EXPECT_EQ(checked([](S& s) { s.maximumRadius = -1; }), Status::InvalidRadiusBounds);
  EXPECT_EQ(checked([](S& s) { s.maximumRadius = NAN; }), Status::InvalidRadiusBounds);
  const auto crossed = [](S& s)
  {
    s.minimumRadius = 2;
    s.maximumRadius = 1;
  };
  EXPECT_EQ(checked(crossed), Status::InvalidRadiusBounds);
}

TEST(LocalBandwidths, MatchTheDefinitionAtEveryPoint)
{
  const std::vector<Vec3> points = trial::randomBox(1500, 33, { 0, 0, 0 }, { 1, 1, 0.1 });
  for (const BandwidthRule rule : { BandwidthRule::NormalReference, BandwidthRule::ScottMultivariate,
         BandwidthRule::SilvermanMultivariate })
  {
    LocalBandwidthSettings settings;
    settings.rule = rule;
    settings.numberOfNeighbors = 12;
    settings.minimumRadius = 1e-9;
    const Local local = localOf(points, settings);
    for (std::size_t i = 0; i < points.size(); i += 7)
    {
      // The point itself is its own nearest neighbour: 13 in all.
      std::vector<std::int64_t> indices;
      for (const Neighbor& n : reference::nearest(view(points), points[i], 13))
      {
        indices.push_back(n.index);
      }
      const int d = rule == BandwidthRule::NormalReference ? 1 : 2;
      const double expected =
        double(reference::surfaceSpread(view(points), indices) * reference::bandwidthFactor(rule, 13, d));
      EXPECT_NEAR(local.bandwidths[i] / expected, 1.0, 1e-9) << "rule " << int(rule) << " point " << i;
      EXPECT_NEAR(local.radii[i], 4.0 * local.bandwidths[i], 1e-12);
    }
  }
}

TEST(LocalBandwidths, OfTheRulesForDistancesMatchTheDefinition)
{
  const std::vector<Vec3> points = trial::randomBox(900, 39, { 0, 0, 0 }, { 1, 1, 0.1 });
  for (const BandwidthRule rule : { BandwidthRule::SilvermanRobust, BandwidthRule::SheatherJones })
  {
    LocalBandwidthSettings settings;
    settings.rule = rule;
    settings.minimumRadius = 1e-9;
    const Local local = localOf(points, settings);
    for (std::size_t i = 0; i < points.size(); i += 61)
    {
      std::vector<double> distances;
      for (const Neighbor& n : reference::nearest(view(points), points[i], 17))
      {
        distances.push_back(std::sqrt(n.squaredDistance));
      }
      const reference::Spread spread = reference::spread(distances);
      const long double s = std::min(spread.standardDeviation, spread.interquartileRange / 1.34L);
      const double expected = double(rule == BandwidthRule::SheatherJones
          ? reference::SheatherJonesOracle(distances).solveTheEquation()
          : s * reference::bandwidthFactor(rule, 17, 1));
      EXPECT_NEAR(local.bandwidths[i] / expected, 1.0, 1e-9) << "rule " << int(rule) << " point " << i;
    }
  }
}

TEST(LocalBandwidths, MatchTheDefinitionInFixedBalls)
{
  const std::vector<Vec3> points = trial::randomBox(1500, 34, { 0, 0, 0 }, { 1, 1, 0.1 });
  LocalBandwidthSettings settings;
  settings.fixedRadius = true;
  settings.radius = 0.15;
  settings.minimumRadius = 1e-9;
  const Local local = localOf(points, settings);
  for (std::size_t i = 0; i < points.size(); i += 13)
  {
    std::vector<std::int64_t> indices;
    for (const Neighbor& n : reference::neighborsByDistance(view(points), points[i]))
    {
      if (n.squaredDistance <= settings.radius * settings.radius)
      {
        indices.push_back(n.index);
      }
    }
    const long double factor = reference::bandwidthFactor(settings.rule, (long double)(indices.size()), 1);
    EXPECT_NEAR(
      local.bandwidths[i] / double(reference::surfaceSpread(view(points), indices) * factor), 1.0, 1e-9);
  }
}

TEST(LocalBandwidths, ScaleWithTheCloud)
{
  const std::vector<Vec3> points = trial::randomBox(1000, 35, { 0, 0, 0 }, { 1, 1, 0 });
  for (const BandwidthRule rule : kRules)
  {
    LocalBandwidthSettings settings;
    settings.rule = rule;
    const Local local = localOf(points, settings);
    for (const double scale : { 1e-9, 0.125, 1e6 })
    {
      std::vector<Vec3> scaled = points;
      for (Vec3& p : scaled)
      {
        p *= scale;
      }
      const Local other = localOf(scaled, settings);
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        ASSERT_NEAR(other.bandwidths[i] / (scale * local.bandwidths[i]), 1.0, 1e-9) << scale;
        ASSERT_NEAR(other.radii[i] / (scale * local.radii[i]), 1.0, 1e-9) << scale;
      }
    }
  }
}

TEST(LocalBandwidths, FallAsDensityRises)
{
  // The misprinted rule of the paper grows here; sixteen times the density is a quarter of the spacing.
  const std::vector<Vec3> points = densityStep();
  for (const BandwidthRule rule : kRules)
  {
    LocalBandwidthSettings settings;
    settings.rule = rule;
    const Local local = localOf(points, settings);
    const double dense = median({ local.radii.begin(), local.radii.begin() + 16000 });
    const double sparse = median({ local.radii.begin() + 16000, local.radii.end() });
    EXPECT_NEAR(sparse / dense, 4.0, 0.6) << "rule " << int(rule);
    const double denseBandwidth = median({ local.bandwidths.begin(), local.bandwidths.begin() + 16000 });
    const double sparseBandwidth = median({ local.bandwidths.begin() + 16000, local.bandwidths.end() });
    EXPECT_NEAR(sparseBandwidth / denseBandwidth, 4.0, 0.6) << "rule " << int(rule);
  }
}

TEST(LocalBandwidths, AutomaticRadiusDoesNotSinkThroughTheWidestGap)
{
  const std::vector<Vec3> points = trial::randomBox(20000, 36, { 0, 0, 0 }, { 1, 1, 0 });
  LocalBandwidthSettings settings;
  settings.radiusScale = 1e-6;
  const Local local = localOf(points, settings);
  const double spacing = std::sqrt(1.0 / 20000);
  EXPECT_NEAR(median(local.radii) / (kNoSinkSpacings * spacing), 1.0, 0.1);
}

TEST(LocalBandwidths, RadiusIsClampedToItsBounds)
{
  const std::vector<Vec3> points = densityStep();
  LocalBandwidthSettings settings;
  settings.minimumRadius = 0.03;
  settings.maximumRadius = 0.06;
  const Local local = localOf(points, settings);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_DOUBLE_EQ(local.radii[i], std::min(0.06, std::max(0.03, 4.0 * local.bandwidths[i])));
  }
  EXPECT_EQ(*std::min_element(local.radii.begin(), local.radii.end()), 0.03);
  EXPECT_EQ(*std::max_element(local.radii.begin(), local.radii.end()), 0.06);
}

TEST(LocalBandwidths, DegenerateCloudsGetUsableRadii)
{
  for (const BandwidthRule rule : kRules)
  {
    for (const bool fixedRadius : { false, true })
    {
      for (const double r1 : { 0.0, 0.25 })
      {
        LocalBandwidthSettings settings;
        settings.rule = rule;
        settings.fixedRadius = fixedRadius;
        settings.minimumRadius = r1;
        const std::vector<std::vector<Vec3>> clouds{ { { 1, 2, 3 } }, { { 0, 0, 0 }, { 1, 0, 0 } },
          std::vector<Vec3>(100, Vec3(0.1, 0.1, 0.1)), { { 0, 0, 0 }, { 0, 0, 0 }, { 9, 9, 9 } } };
        for (const std::vector<Vec3>& cloud : clouds)
        {
          expectUsable(localOf(cloud, settings));
        }
        if (r1 > 0.0)
        {
          const Local lone = localOf({ { 1, 2, 3 } }, settings);
          EXPECT_EQ(lone.radii[0], r1);
          EXPECT_EQ(lone.bandwidths[0], r1 / settings.radiusScale);
        }
      }
    }
  }
}

TEST(LocalBandwidths, DuplicatesAmongSpreadPointsGetTheSmallestRadiusFound)
{
  std::vector<Vec3> points = trial::randomBox(500, 37, { 0, 0, 0 }, { 1, 1, 0 });
  points.insert(points.end(), 40, Vec3(3, 3, 0));
  const Local local = localOf(points, {});
  expectUsable(local);
  const double smallest = *std::min_element(local.radii.begin(), local.radii.begin() + 500);
  EXPECT_EQ(local.radii[510], smallest);
  EXPECT_DOUBLE_EQ(local.bandwidths[510], smallest / 4.0);
}

TEST(LocalBandwidths, PointsThatAreNotFiniteGetZero)
{
  std::vector<Vec3> points = trial::randomBox(300, 38, { 0, 0, 0 }, { 1, 1, 0 });
  const Local clean = localOf({ points.begin() + 2, points.end() }, {});
  points[0].x = NAN;
  points[1].z = INFINITY;
  const Local local = localOf(points, {});
  EXPECT_EQ(local.bandwidths[0], 0.0);
  EXPECT_EQ(local.radii[0], 0.0);
  EXPECT_EQ(local.bandwidths[1], 0.0);
  EXPECT_EQ(local.radii[1], 0.0);
  EXPECT_TRUE(std::equal(clean.radii.begin(), clean.radii.end(), local.radii.begin() + 2));
}

TEST(LocalBandwidths, OfAnEmptyCloudAreEmpty)
{
  const Local local = localOf({}, {});
  EXPECT_TRUE(local.radii.empty());
}

TEST(LocalBandwidths, DoNotDependOnTheExecutor)
{
  const std::vector<Vec3> points = densityStep();
  const Local expected = localOf(points, {});
  const trial::ThreadedExecutor three(3);
  const trial::BackwardExecutor pieces(501);
  for (const Executor* executor :
    { static_cast<const Executor*>(&three), static_cast<const Executor*>(&pieces) })
  {
    const Local local = localOf(points, {}, *executor);
    EXPECT_EQ(local.bandwidths, expected.bandwidths);
    EXPECT_EQ(local.radii, expected.radii);
  }
}
