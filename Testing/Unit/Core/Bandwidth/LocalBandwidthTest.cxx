#include "Core/Bandwidth/LocalBandwidth.h"
#include "Core/Reference/ReferenceBandwidth.h"
#include "Core/Reference/ReferenceKernelSum.h"
#include "Shapes/Shapes.h"

#include "LocalBandwidthFixtures.h"
#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;
using namespace pointhaptics::trial;

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
  std::vector<Vec3> points = trial::randomBox(1500, 33, { 0, 0, 0 }, { 1, 1, 0.1 });
  const std::vector<Vec3> twins(points.begin(), points.begin() + 400);
  points.insert(points.end(), twins.begin(), twins.end());
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
  const Local lone = localOf({ { 1, 2, 3 } }, settings);
  EXPECT_EQ(lone.radii[0], 0.03);
  EXPECT_EQ(lone.bandwidths[0], 0.03 / settings.radiusScale);
}

TEST(LocalBandwidths, OfRepeatedPointsAreThoseOfTheirPlaces)
{
  const std::vector<Vec3> places = trial::randomBox(500, 37, { 0, 0, 0 }, { 1, 1, 0 });
  std::vector<Vec3> points = places;
  points.insert(points.end(), 700, places[3]);
  for (int i = 0; i < 3; ++i)
  {
    points.insert(points.end(), places.begin(), places.end());
  }
  for (const int kind : { 0, 1 })
  {
    LocalBandwidthSettings settings;
    settings.fixedRadius = kind == 1;
    settings.radius = 0.06;
    const Local expected = localOf(places, settings);
    const Local local = localOf(points, settings);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const std::size_t place = i < 500 ? i : i < 1200 ? 3 : (i - 1200) % 500;
      ASSERT_EQ(local.bandwidths[i], expected.bandwidths[place]) << i << " kind " << kind;
      ASSERT_EQ(local.radii[i], expected.radii[place]) << i << " kind " << kind;
    }
  }
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

TEST(LocalBandwidths, AreTheSameBitsForFloatsAndDoublesAndEveryNumberOfThreads)
{
  std::vector<Vec3> points = densityStep();
  std::vector<float> floats;
  for (Vec3& p : points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      floats.push_back(float(p[axis]));
      p[axis] = double(floats.back());
    }
  }
  for (const BandwidthRule rule : kRules)
  {
    LocalBandwidthSettings settings;
    settings.rule = rule;
    const Local expected = localOf(points, settings);
    for (const int threads : { 2, 8 })
    {
      const Local other = localOf(points, settings, trial::ThreadedExecutor(threads));
      ASSERT_EQ(other.bandwidths, expected.bandwidths) << threads;
      ASSERT_EQ(other.radii, expected.radii) << threads;
    }
    const PointView single(floats.data(), std::int64_t(points.size()));
    NeighborQuery query;
    query.build(single);
    Local other;
    ASSERT_EQ(localBandwidths(single, {}, query, settings, other.bandwidths, other.radii), Status::Ok);
    ASSERT_EQ(other.bandwidths, expected.bandwidths);
    ASSERT_EQ(other.radii, expected.radii);
  }
}
