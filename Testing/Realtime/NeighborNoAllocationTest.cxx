#include "CountedCalls.h"

#include "Core/Neighbors/NeighborSweep.h"
#include "Shapes/Shapes.h"

#include <gtest/gtest.h>

using namespace pointhaptics;

TEST(NoAllocation, InQueriesForNeighbors)
{
  std::vector<Vec3> points;
  ASSERT_EQ(generateShape(Shape::DensityStep, 20000, 1, 0.0, points), Status::Ok);
  points.insert(points.end(), 3000, points[7]);
  points.emplace_back(5.0, 5.0, 5.0);
  NeighborQuery query;
  query.build({ points.data(), std::int64_t(points.size()) });
  std::vector<Neighbor> found(100);
  NeighborSweep sweep(query, 17);
  const long before = countedcalls::count();
  std::int64_t visited = 0;
  {
    const countedcalls::Watch watch;
    for (std::size_t i = 0; i < points.size(); i += 7)
    {
      visited += query.nearest(points[i] + Vec3(1e-4, 0, 1e-3), i % 2 ? 17 : 100, found.data()) > 0;
      query.visitBall(points[i], 1e-3, [&](const Vec3&, double, std::int64_t) { ++visited; });
    }
    sweep.run(0, NeighborSweep::leaves(query), [&](const NeighborList& list) { visited += list.count; });
  }
  EXPECT_EQ(countedcalls::count() - before, 0) << countedcalls::firstFunction();
  EXPECT_GT(visited, 400000);
}
