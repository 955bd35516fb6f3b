#include "Core/Bandwidth/LocalBandwidth.h"
#include "Shapes/Shapes.h"

#include "LocalBandwidthFixtures.h"
#include "RandomClouds.h"

#include "Unit/VoxelMeans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

constexpr double kVoxel = 1e-3 / 3.0; ///< 300^3 in 10 cm.

/// Voxel means, and the number of points in each.
struct Means
{
  std::vector<Vec3> points;
  std::vector<double> counts;
};

Means meansOf(const std::vector<Vec3>& points, double voxel)
{
  LatticeSettings settings;
  settings.voxelSize = voxel;
  Lattice lattice;
  VoxelMeans means;
  EXPECT_EQ(makeLattice(settings, transformedBounds(view(points), {}), lattice), Status::Ok);
  EXPECT_EQ(voxelMeans(view(points), {}, lattice, false, means), Status::Ok);
  return { std::move(means.means), { means.counts.begin(), means.counts.end() } };
}

Local localOfMeans(
  const Means& means, const LocalBandwidthSettings& settings = {}, const Executor& executor = {})
{
  NeighborQuery query;
  query.build(view(means.points));
  Local result;
  EXPECT_EQ(localBandwidths(
              view(means.points), means.counts, query, settings, result.bandwidths, result.radii, executor),
    Status::Ok);
  return result;
}

double quantile(std::vector<double> values, double part)
{
  std::sort(values.begin(), values.end());
  return values[std::size_t(part * double(values.size() - 1))];
}

/// Two squares side by side, turned out of the lattice's axes; the spacings are as 1 to @p ratio.
std::vector<Vec3> patches(double ratio)
{
  const double spacing = 0.1e-3;
  std::vector<Vec3> points;
  for (const bool sparse : { false, true })
  {
    const double edge = 0.02;
    const double s = sparse ? ratio * spacing : spacing;
    const auto count = std::size_t(edge * edge / (s * s));
    for (const Vec3& p : randomBox(count, 71 + sparse, { 0, 0, 0 }, { edge, edge, 0 }))
    {
      const Vec3 q{ sparse ? p.x + 0.021 : p.x, p.y, 0.0 };
      points.emplace_back(0.8 * q.x, q.y, 0.6 * q.x);
    }
  }
  return points;
}

std::vector<Vec3> idol()
{
  std::vector<Vec3> points;
  EXPECT_EQ(generateShape(Shape::Idol, 543652, 7, 0.0, points), Status::Ok);
  return points;
}

/// The radius of each mean over the mean radius of the nine raw points nearest to it.
std::vector<double> overRaw(const std::vector<Vec3>& points, const Means& means, const Local& felt)
{
  NeighborQuery query;
  query.build(view(points));
  const Local raw = localOf(points, {});
  std::vector<double> ratios;
  for (std::size_t i = 0; i < means.points.size(); i += 7)
  {
    Neighbor near[9];
    const int found = query.nearest(means.points[i], 9, near);
    double sum = 0.0;
    for (int j = 0; j < found; ++j)
    {
      sum += raw.radii[std::size_t(near[j].index)];
    }
    ratios.push_back(felt.radii[i] * found / sum);
  }
  return ratios;
}

double medianDeviation(std::vector<double> ratios)
{
  for (double& ratio : ratios)
  {
    ratio = std::fabs(ratio - 1.0);
  }
  return median(std::move(ratios));
}

} // namespace

TEST(LocalBandwidthCounts, OfOneChangeNoBit)
{
  std::vector<Vec3> points = randomBox(1500, 70, { 0, 0, 0 }, { 1, 1, 0.1 });
  points.insert(points.end(), 40, points[5]);
  points[17].y = NAN;
  for (const BandwidthRule rule : kRules)
  {
    for (const bool fixedRadius : { false, true })
    {
      LocalBandwidthSettings settings;
      settings.rule = rule;
      settings.fixedRadius = fixedRadius;
      settings.radius = 0.06;
      const Local expected = localOf(points, settings);
      for (const double one : { 1.0, 0.0, -3.0, double(NAN) })
      {
        const Local local = localOfMeans({ points, std::vector<double>(points.size(), one) }, settings);
        EXPECT_EQ(local.bandwidths, expected.bandwidths) << int(rule) << ' ' << fixedRadius;
        EXPECT_EQ(local.radii, expected.radii) << int(rule) << ' ' << fixedRadius;
      }
      EXPECT_EQ(localOfMeans({ points, {} }, settings).radii, expected.radii);
    }
  }
}

TEST(LocalBandwidthCounts, AreLeftAloneOnRequest)
{
  const Means means = meansOf(patches(3.9), kVoxel);
  LocalBandwidthSettings settings;
  settings.usePointCounts = false;
  EXPECT_EQ(localOfMeans(means, settings).radii, localOf(means.points, {}).radii);
  EXPECT_NE(localOfMeans(means).radii, localOf(means.points, {}).radii);
}

TEST(LocalBandwidthCounts, OfFourHalveTheRadius)
{
  const std::vector<Vec3> points = randomBox(3000, 72, { 0, 0, 0 }, { 1, 1, 0 });
  const Local expected = localOf(points, {});
  const Local local = localOfMeans({ points, std::vector<double>(points.size(), 4.0) });
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    ASSERT_NEAR(local.radii[i] / expected.radii[i], 0.5, 1e-12);
    ASSERT_NEAR(local.bandwidths[i] / expected.bandwidths[i], 0.5, 1e-12);
  }
}

TEST(LocalBandwidthCounts, InABallAreTheSizeOfTheSample)
{
  const std::vector<Vec3> points = randomBox(1000, 73, { 0, 0, 0 }, { 1, 1, 0 });
  for (const BandwidthRule rule : kRules)
  {
    LocalBandwidthSettings settings;
    settings.fixedRadius = true;
    settings.radius = 0.1;
    settings.rule = rule;
    const Local expected = localOf(points, settings);
    const Local local = localOfMeans({ points, std::vector<double>(points.size(), 32.0) }, settings);
    const bool onSurface =
      rule == BandwidthRule::ScottMultivariate || rule == BandwidthRule::SilvermanMultivariate;
    const double factor = std::pow(32.0, onSurface ? -1.0 / 6.0 : -0.2);
    for (std::size_t i = 0; i < points.size(); i += 11)
    {
      ASSERT_NEAR(local.bandwidths[i] / expected.bandwidths[i], factor, 1e-9) << int(rule);
    }
  }
}

TEST(LocalBandwidthCounts, GiveTheSpacingOfThePointsBackThatTheMeansHaveLost)
{
  // A cloud of 3.9:1 in spacing.
  const std::vector<Vec3> points = patches(3.9);
  const Means means = meansOf(points, kVoxel);
  const auto ratioOf = [](const std::vector<Vec3>& places, const Local& local)
  {
    std::vector<double> side[2];
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      side[places[i].x > 0.8 * 0.0205].push_back(local.radii[i]);
    }
    return median(side[1]) / median(side[0]);
  };
  EXPECT_NEAR(ratioOf(points, localOf(points, {})), 3.9, 0.1);
  EXPECT_LT(ratioOf(means.points, localOf(means.points, {})), 2.0);
  EXPECT_GE(ratioOf(means.points, localOfMeans(means)), 3.5);
  EXPECT_LE(medianDeviation(overRaw(points, means, localOfMeans(means))), 0.1);
}

TEST(LocalBandwidthCounts, GiveTheRadiiOfTheRawPointsOnTheStatue)
{
  const std::vector<Vec3> points = idol();
  const Local raw = localOf(points, {});
  const double expected = quantile(raw.radii, 0.95) / quantile(raw.radii, 0.05);
  EXPECT_NEAR(expected, 3.9, 0.1);
  for (const double voxel : { 0.5 * kVoxel, kVoxel, 2.0 * kVoxel })
  {
    const Means means = meansOf(points, voxel);
    const Local local = localOfMeans(means);
    EXPECT_GE(quantile(local.radii, 0.95) / quantile(local.radii, 0.05), 3.5) << voxel;
    const std::vector<double> ratios = overRaw(points, means, local);
    EXPECT_NEAR(median(ratios), 1.05, 0.02) << voxel;
    EXPECT_LE(medianDeviation(ratios), 0.1) << voxel;
    EXPECT_LE(quantile(ratios, 0.99), 1.5) << voxel;
    EXPECT_GE(quantile(ratios, 0.01), 0.7) << voxel;
  }
  const Means means = meansOf(points, kVoxel);
  const Local alone = localOf(means.points, {});
  EXPECT_LT(quantile(alone.radii, 0.95) / quantile(alone.radii, 0.05), 1.7);
}

TEST(LocalBandwidthCounts, LeaveASparseRegionItsRadiusBesideAVeryDenseOne)
{
  // Three voxels in length of a million points, and one point a voxel beside them.
  std::vector<Vec3> points = randomBox(8000, 74, { -0.02, 0, 0 }, { 0, 0.04, 0 });
  const std::vector<Vec3> dense = randomBox(400000, 75, { 0, 0, 0 }, { 0.001, 0.04, 0 });
  points.insert(points.end(), dense.begin(), dense.end());
  const Means means = meansOf(points, kVoxel);
  const Local local = localOfMeans(means);
  const std::vector<double> ratios = overRaw(points, means, local);
  std::vector<double> beside;
  for (std::size_t i = 0; 7 * i < means.points.size(); ++i)
  {
    const double x = means.points[7 * i].x;
    if (x < -1.2 * kVoxel && x > -4.0 * kVoxel)
    {
      beside.push_back(ratios[i]);
    }
  }
  ASSERT_GT(beside.size(), 30u);
  EXPECT_GT(quantile(beside, 0.05), 0.4);
  EXPECT_GT(quantile(beside, 0.0), 0.2);
}

TEST(LocalBandwidthCounts, ChangeRadiiContinuously)
{
  Means means{ randomBox(500, 76, { 0, 0, 0 }, { 1, 1, 0 }), std::vector<double>(500, 3.0) };
  Local last = localOfMeans(means);
  for (int step = 0; step < 400; ++step)
  {
    means.counts[100] += 0.05;
    const Local next = localOfMeans(means);
    for (std::size_t i = 0; i < 500; ++i)
    {
      ASSERT_NEAR(next.radii[i] / last.radii[i], 1.0, 0.01) << step;
    }
    last = next;
  }
}

TEST(LocalBandwidthCounts, GiveTheSameBitsForAFewAndForAllAndOnEveryExecutor)
{
  Means means = meansOf(patches(3.9), kVoxel);
  means.points.insert(means.points.end(), 60, means.points[9]); // more than a neighbourhood at one place
  means.counts.resize(means.points.size(), 7.0);
  NeighborQuery query;
  query.build(view(means.points));
  std::vector<std::int64_t> slots;
  for (std::int64_t slot = 0; slot < query.size(); slot += 5)
  {
    slots.push_back(slot);
  }
  const Local whole = localOfMeans(means, {});
  EXPECT_EQ(localOfMeans(means, {}, ThreadedExecutor(3)).radii, whole.radii);
  std::vector<double> radii;
  ASSERT_EQ(localRadiiAt(view(means.points), means.counts, query, {}, slots, radii), Status::Ok);
  for (std::size_t i = 0; i < slots.size(); ++i)
  {
    ASSERT_EQ(radii[i], whole.radii[std::size_t(query.index(slots[i]))]);
  }
}

TEST(LocalBandwidthCounts, OfAnotherNumberAreRefusedAndOfAnySizeUsable)
{
  const std::vector<Vec3> points = randomBox(300, 77, { 0, 0, 0 }, { 1, 1, 0 });
  NeighborQuery query;
  query.build(view(points));
  std::vector<double> bandwidths;
  std::vector<double> radii;
  EXPECT_EQ(localBandwidths(view(points), { 2.0 }, query, {}, bandwidths, radii), Status::InvalidParameter);
  EXPECT_EQ(localRadiiAt(view(points), { 2.0 }, query, {}, { 0 }, radii), Status::InvalidParameter);
  expectUsable(localOfMeans({ points, std::vector<double>(300, 1e18) }));
  expectUsable(localOfMeans({ points, std::vector<double>(300, INFINITY) }));
  expectUsable(localOfMeans({ { { 1, 2, 3 } }, { 9.0 } }));
  expectUsable(localOfMeans({ { { 0, 0, 0 }, { 1, 0, 0 } }, { 9.0, 2.0 } }));
  expectUsable(localOfMeans({ std::vector<Vec3>(100, Vec3(1, 1, 1)), std::vector<double>(100, 5.0) }));
}

TEST(LocalBandwidthCounts, OfRepeatedMeansDoNotDependOnTheirOrder)
{
  Means means = { randomBox(400, 73, { 0, 0, 0 }, { 1, 1, 0 }), {} };
  for (std::size_t i = 0; i < 400; ++i)
  {
    means.counts.push_back(1.0 + double(i % 7));
  }
  for (std::size_t i = 0; i < 400; i += 2)
  {
    means.points.push_back(means.points[i]);
    means.counts.push_back(1.0 + double(i % 11));
  }
  const Local expected = localOfMeans(means);
  std::reverse(means.points.begin(), means.points.end());
  std::reverse(means.counts.begin(), means.counts.end());
  Local reversed = localOfMeans(means);
  std::reverse(reversed.radii.begin(), reversed.radii.end());
  std::reverse(reversed.bandwidths.begin(), reversed.bandwidths.end());
  EXPECT_EQ(reversed.radii, expected.radii);
  EXPECT_EQ(reversed.bandwidths, expected.bandwidths);
}
