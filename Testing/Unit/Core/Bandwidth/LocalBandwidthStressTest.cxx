#include "Core/Bandwidth/Density.h"
#include "Core/Bandwidth/LocalBandwidth.h"
#include "Shapes/Shapes.h"

#include "LocalBandwidthFixtures.h"
#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

using namespace pointhaptics;
using namespace pointhaptics::trial;

TEST(LocalBandwidths, OfDuplicatesTakeNoLongerThanOfOthers)
{
  // Searched for one by one, or their balls read one by one, these would take minutes.
  std::vector<Vec3> points = trial::randomBox(2000, 48, { 0, 0, 0 }, { 1, 1, 0 });
  points.insert(points.end(), 100000, points[3]);
  LocalBandwidthSettings settings;
  const Local nearest = localOf(points, settings);
  expectUsable(nearest);
  EXPECT_EQ(nearest.radii.back(), nearest.radii[3]);
  settings.fixedRadius = true;
  settings.radius = 0.001;
  expectUsable(localOf(points, settings));
  NeighborQuery query;
  query.build(view(points));
  std::vector<double> densities;
  surfaceDensities(view(points), {}, query, nearest.bandwidths, densities);
  EXPECT_EQ(densities.back(), densities[3]);
}

TEST(LocalBandwidths, ScaleWithTheCloudFromPicometresToTerametres)
{
  std::vector<Vec3> points;
  ASSERT_EQ(generateShape(Shape::DensityStep, 3000, 1, 0.0, points), Status::Ok);
  const Local local = localOf(points, {});
  for (double scale = 1e-12; scale < 2e12; scale *= 10)
  {
    std::vector<Vec3> scaled = points;
    for (Vec3& p : scaled)
    {
      p *= scale;
    }
    const Local other = localOf(scaled, {});
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      ASSERT_NEAR(other.bandwidths[i] / (scale * local.bandwidths[i]), 1.0, 1e-12) << scale;
      ASSERT_NEAR(other.radii[i] / (scale * local.radii[i]), 1.0, 1e-12) << scale;
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
  std::vector<Vec3> duplicates = trial::randomBox(300, 46, { 0, 0, 0 }, { 1, 1, 0 });
  duplicates.insert(duplicates.end(), 1500, duplicates[3]);
  const std::vector<std::vector<Vec3>> clouds{ line, apart, twice, denormal, far, tiny, wide, widest,
    duplicates, trial::randomBox(300, 47, { -9, -8, -7 }, { -3, -2, -1 }), { { 1, 2, 3 } },
    { { 0, 0, 0 }, { 1, 0, 0 } }, std::vector<Vec3>(40, Vec3(0.1, 0.2, 0.3)),
    trial::randomBox(11, 45, { 0, 0, 0 }, { 1, 1, 1 }) };
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
        expectUsable(localOf(clouds[c], settings));
        settings.fixedRadius = true;
        settings.minimumRadius = k == 1 ? 0.0 : 0.25;
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
