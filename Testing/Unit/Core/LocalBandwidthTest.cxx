#include "Core/LocalBandwidth.h"
#include "Core/Density.h"
#include "Core/Reference/ReferenceBandwidth.h"
#include "Core/Reference/ReferenceKernelSum.h"
#include "Core/Shapes.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

using namespace pointhaptics;

namespace
{

const BandwidthRule kRules[] = { BandwidthRule::NormalReference, BandwidthRule::SilvermanRobust,
  BandwidthRule::ScottMultivariate, BandwidthRule::SilvermanMultivariate, BandwidthRule::SheatherJones };

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
    settings.smoothRadius = true;
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
    ASSERT_EQ(localBandwidths(single, query, settings, other.bandwidths, other.radii), Status::Ok);
    ASSERT_EQ(other.bandwidths, expected.bandwidths);
    ASSERT_EQ(other.radii, expected.radii);
  }
}

TEST(LocalBandwidths, OfACrowdAtOnePlaceTakeNoLongerThanOfOthers)
{
  // Searched for one by one, or their balls read one by one, these would take minutes.
  std::vector<Vec3> points = trial::randomBox(2000, 48, { 0, 0, 0 }, { 1, 1, 0 });
  points.insert(points.end(), 100000, points[3]);
  LocalBandwidthSettings settings;
  const Local nearest = localOf(points, settings);
  expectUsable(nearest);
  EXPECT_EQ(nearest.radii.back(), *std::min_element(nearest.radii.begin(), nearest.radii.end()));
  settings.fixedRadius = true;
  settings.radius = 0.001;
  expectUsable(localOf(points, settings));
  NeighborQuery query;
  query.build(view(points));
  std::vector<double> densities;
  surfaceDensities(view(points), query, nearest.bandwidths, densities);
  EXPECT_EQ(densities.back(), densities[3]);
}

TEST(LocalBandwidths, ScaleWithTheCloudFromPicometresToTerametres)
{
  std::vector<Vec3> points;
  ASSERT_EQ(generateShape(Shape::DensityStep, 3000, 1, 0.0, points), Status::Ok);
  for (const bool smooth : { false, true })
  {
    LocalBandwidthSettings settings;
    settings.smoothRadius = smooth;
    const Local local = localOf(points, settings);
    for (double scale = 1e-12; scale < 2e12; scale *= 10)
    {
      std::vector<Vec3> scaled = points;
      for (Vec3& p : scaled)
      {
        p *= scale;
      }
      const Local other = localOf(scaled, settings);
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        ASSERT_NEAR(other.bandwidths[i] / (scale * local.bandwidths[i]), 1.0, 1e-12) << scale;
        ASSERT_NEAR(other.radii[i] / (scale * local.radii[i]), 1.0, 1e-12) << scale;
      }
    }
  }
}

TEST(LocalBandwidths, FallAsTheDensityOfTheShapesRises)
{
  // Of the density step 16 times as many points per area on one side; of the idol, the density falls from its
  // face to behind its foot, and the median radius with it rises from each sixth of the spacings to the next.
  LocalBandwidthSettings settings;
  for (const Shape shape : { Shape::DensityStep, Shape::Idol })
  {
    std::vector<Vec3> points;
    ASSERT_EQ(generateShape(shape, 20000, 2, 0.0, points), Status::Ok);
    const Local local = localOf(points, settings);
    NeighborQuery query;
    query.build(view(points));
    // An independent measure of density: points in a ball of 3 mm.
    std::vector<std::pair<int, double>> byCount;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      int count = 0;
      query.visitBall(points[i], 0.003, [&](const Vec3&, double, std::int64_t) { ++count; });
      byCount.emplace_back(count, local.radii[i]);
    }
    std::sort(byCount.begin(), byCount.end());
    double before = INFINITY;
    const std::size_t parts = shape == Shape::Idol ? 6 : 2;
    for (std::size_t part = 0; part < parts; ++part)
    {
      const std::size_t begin = part == 1 && parts == 2 ? points.size() / 4 : part * points.size() / parts;
      const std::size_t end =
        parts == 2 && part == 0 ? points.size() / 20 : (part + 1) * points.size() / parts;
      std::vector<double> radii;
      for (std::size_t i = begin; i < end; ++i)
      {
        radii.push_back(byCount[i].second);
      }
      const double now = median(radii);
      EXPECT_LT(now, parts == 2 ? 0.35 * before : 0.97 * before) << shapeName(shape) << " part " << part;
      before = now;
    }
  }
}

TEST(LocalBandwidths, SurviveEveryCloudWithUsableRadii)
{
  trial::Random random(41);
  std::vector<Vec3> line;
  for (int i = 0; i < 300; ++i)
  {
    line.push_back(random.uniform() * Vec3(1, 2, 3));
  }
  std::vector<Vec3> apart = trial::randomBox(300, 42, { 0, 0, 0 }, { 1, 1, 0 });
  apart.emplace_back(1e9, 0, 0);
  apart.emplace_back(0, -1e15, 0);
  std::vector<Vec3> twice = trial::randomBox(300, 43, { 0, 0, 0 }, { 1, 1, 0 });
  twice.insert(twice.end(), twice.begin(), twice.begin() + 300);
  std::vector<Vec3> denormal = trial::randomBox(300, 44, { 0, 0, 0 }, { 1, 1, 0 });
  std::vector<Vec3> far = denormal;
  std::vector<Vec3> tiny = denormal;
  std::vector<Vec3> wide = denormal;
  std::vector<Vec3> widest = denormal;
  for (std::size_t i = 0; i < denormal.size(); ++i)
  {
    denormal[i] *= 1e-312;
    far[i] = Vec3(5e5, 4.6e6, 100) + 0.01 * far[i];
    tiny[i] *= 1e-170;
    wide[i] *= 1e170;
    widest[i] = 3.4e307 * (10.0 * widest[i] - Vec3(5, 5, 5)); // to the end of double numbers
  }
  std::vector<Vec3> crowd = trial::randomBox(300, 46, { 0, 0, 0 }, { 1, 1, 0 });
  crowd.insert(crowd.end(), 1500, crowd[3]);
  const std::vector<std::vector<Vec3>> clouds{ line, apart, twice, denormal, far, tiny, wide, widest, crowd,
    trial::randomBox(300, 47, { -9, -8, -7 }, { -3, -2, -1 }), { { 1, 2, 3 } }, { { 0, 0, 0 }, { 1, 0, 0 } },
    std::vector<Vec3>(40, Vec3(0.1, 0.2, 0.3)), trial::randomBox(11, 45, { 0, 0, 0 }, { 1, 1, 1 }) };
  for (std::size_t c = 0; c < clouds.size(); ++c)
  {
    for (const BandwidthRule rule : kRules)
    {
      for (const int k : { 1, 16, 1000 })
      {
        SCOPED_TRACE(
          "cloud " + std::to_string(c) + " rule " + std::to_string(int(rule)) + " k " + std::to_string(k));
        if (rule == BandwidthRule::SheatherJones && k == 1000)
        {
          continue;
        }
        LocalBandwidthSettings settings;
        settings.rule = rule;
        settings.numberOfNeighbors = k;
        settings.smoothRadius = k == 16;
        expectUsable(localOf(clouds[c], settings));
      }
    }
  }
}

TEST(LocalBandwidths, OfHugeNumbersOfNeighborsAreThoseOfTheWholeCloud)
{
  const std::vector<Vec3> points = trial::randomBox(100, 46, { 0, 0, 0 }, { 1, 1, 0 });
  LocalBandwidthSettings all;
  all.numberOfNeighbors = 99;
  LocalBandwidthSettings more;
  more.numberOfNeighbors = std::numeric_limits<int>::max();
  EXPECT_EQ(localOf(points, more).bandwidths, localOf(points, all).bandwidths);
}

TEST(LocalRadiiAt, AreTheBitsOfTheWholeArray)
{
  std::vector<Vec3> points = trial::randomBox(1500, 61, { 0, 0, 0 }, { 1, 1, 0.1 });
  points[40].y = NAN;
  points.insert(points.end(), 5, points[7]);
  const std::vector<Vec3> spread = points;
  points.insert(points.end(), 60, points[9]); // more than a neighbourhood at one place
  for (const std::vector<Vec3>& cloud : { spread, points })
  {
    NeighborQuery query;
    query.build(view(cloud));
    std::vector<std::int64_t> slots;
    for (std::int64_t slot = query.size() - 1; slot >= 0; slot -= 7)
    {
      slots.push_back(slot);
    }
    for (const BandwidthRule rule : kRules)
    {
      for (const int kind : { 0, 1, 2 })
      {
        LocalBandwidthSettings settings;
        settings.rule = rule;
        settings.fixedRadius = kind == 1;
        settings.radius = 0.06;
        settings.smoothRadius = kind == 2;
        const Local whole = localOf(cloud, settings);
        std::vector<double> radii;
        ASSERT_EQ(
          localRadiiAt(view(cloud), query, settings, slots, radii, trial::ThreadedExecutor(3)), Status::Ok);
        ASSERT_EQ(radii.size(), slots.size());
        for (std::size_t i = 0; i < slots.size(); ++i)
        {
          ASSERT_EQ(radii[i], whole.radii[std::size_t(query.index(slots[i]))])
            << int(rule) << " kind " << kind;
        }
      }
    }
  }
}

TEST(LocalRadiiAt, RefuseBadSettings)
{
  const std::vector<Vec3> points = trial::randomBox(50, 62, { 0, 0, 0 }, { 1, 1, 1 });
  NeighborQuery query;
  query.build(view(points));
  LocalBandwidthSettings settings;
  settings.numberOfNeighbors = 0;
  std::vector<double> radii;
  EXPECT_EQ(localRadiiAt(view(points), query, settings, { 0 }, radii), Status::InvalidNeighborhood);
}

TEST(LimitSlope, GivesTheLargestRadiiWithinTheSlope)
{
  std::vector<Vec3> points = densityStep();
  points.resize(17000 - 400);
  points.emplace_back(5, 5, 5);
  NeighborQuery query;
  query.build(view(points));
  trial::Random random(47);
  std::vector<double> given;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    given.push_back(random.uniform(0.01, i % 50 == 0 ? 2.0 : 0.2));
  }
  std::vector<double> cut = given;
  limitSlope(query, 0.5, cut);
  for (std::size_t i = 0; i < points.size(); i += 97)
  {
    double expected = given[i];
    for (std::size_t j = 0; j < points.size(); ++j)
    {
      const double distance = std::sqrt(norm2(points[j] - points[i]));
      expected = std::min(expected, given[j] + 0.5 * distance);
      ASSERT_LE(std::fabs(cut[i] - cut[j]), 0.5 * distance + 1e-12);
    }
    ASSERT_EQ(cut[i], expected);
  }
  std::vector<double> other = given;
  limitSlope(query, 0.5, other, trial::ThreadedExecutor(8));
  EXPECT_EQ(other, cut);
}

TEST(LimitSlope, KeepsWhatIsSmoothAndWhatTakesNoPart)
{
  std::vector<Vec3> points = trial::randomBox(500, 48, { 0, 0, 0 }, { 1, 1, 0 });
  points[3].x = NAN;
  NeighborQuery query;
  query.build(view(points));
  std::vector<double> radii;
  for (const Vec3& p : points)
  {
    radii.push_back(1.0 + 0.3 * p.y);
  }
  radii[3] = 0.0;
  const std::vector<double> given = radii;
  limitSlope(query, 0.5, radii);
  EXPECT_EQ(radii, given);
  NeighborQuery none;
  std::vector<double> nothing;
  limitSlope(none, 0.5, nothing);
}

TEST(LocalBandwidths, SmoothRadiiKeepTheirBoundsAndStepGently)
{
  const std::vector<Vec3> points = densityStep();
  LocalBandwidthSettings settings;
  settings.smoothRadius = true;
  settings.minimumRadius = 0.02;
  settings.maximumRadius = 0.08;
  const Local smooth = localOf(points, settings);
  settings.smoothRadius = false;
  const Local rough = localOf(points, settings);
  EXPECT_EQ(smooth.bandwidths, rough.bandwidths);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    ASSERT_LE(smooth.radii[i], rough.radii[i]);
    ASSERT_GE(smooth.radii[i], 0.02);
  }
  for (std::size_t i = 0; i < points.size(); i += 311)
  {
    for (std::size_t j = 0; j < points.size(); ++j)
    {
      ASSERT_LE(std::fabs(smooth.radii[i] - smooth.radii[j]), 0.5 * norm(points[i] - points[j]) + 1e-15);
    }
  }
}
