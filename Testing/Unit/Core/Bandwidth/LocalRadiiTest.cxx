#include "Core/Bandwidth/LocalBandwidth.h"
#include "Shapes/Shapes.h"

#include "LocalBandwidthFixtures.h"
#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;
using namespace pointhaptics::trial;

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
        ASSERT_EQ(localRadiiAt(view(cloud), {}, query, settings, slots, radii, trial::ThreadedExecutor(3)),
          Status::Ok);
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
  EXPECT_EQ(localRadiiAt(view(points), {}, query, settings, { 0 }, radii), Status::InvalidNeighborhood);
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
