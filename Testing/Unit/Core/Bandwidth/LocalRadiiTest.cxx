#include "Core/Bandwidth/LocalBandwidth.h"
#include "Shapes/Shapes.h"

#include "LocalBandwidthFixtures.h"
#include "RandomClouds.h"

#include <gtest/gtest.h>

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
      for (const int kind : { 0, 1 })
      {
        LocalBandwidthSettings settings;
        settings.rule = rule;
        settings.fixedRadius = kind == 1;
        settings.radius = 0.06;
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
