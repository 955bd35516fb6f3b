#include "Core/Neighbors/NeighborQuery.h"
#include "Core/Reference/ReferenceNeighbors.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pointhaptics;
using trial::view;

namespace
{

void expectNearest(const std::vector<Vec3>& points, const std::vector<Vec3>& centers, int k)
{
  NeighborQuery query;
  query.build(view(points));
  std::vector<Neighbor> found(std::size_t(k) + 1);
  for (const Vec3& center : centers)
  {
    const std::vector<Neighbor> expected = reference::nearest(view(points), center, std::size_t(k));
    found[std::size_t(k)].index = -77;
    ASSERT_EQ(query.nearest(center, k, found.data()), int(expected.size()));
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      ASSERT_EQ(found[i].index, expected[i].index) << "neighbour " << i << " of " << k;
      ASSERT_EQ(found[i].squaredDistance, expected[i].squaredDistance);
    }
    EXPECT_EQ(found[std::size_t(k)].index, -77) << "nothing may be written past k";
  }
}

void expectBall(const std::vector<Vec3>& points, const Vec3& center, double radius)
{
  NeighborQuery query;
  query.build(view(points));
  std::vector<std::int64_t> found;
  query.visitBall(center, radius,
    [&](const Vec3& p, double d2, std::int64_t index)
    {
      EXPECT_EQ(p, points[std::size_t(index)]);
      EXPECT_EQ(d2, norm2(p - center));
      found.push_back(index);
    });
  std::vector<std::int64_t> expected;
  for (const Neighbor& n : reference::neighborsByDistance(view(points), center))
  {
    if (n.squaredDistance <= radius * radius)
    {
      expected.push_back(n.index);
    }
  }
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(found, expected);
}

} // namespace

TEST(NeighborQuery, EqualsBruteForceOnRandomPoints)
{
  const std::vector<Vec3> points = trial::randomBox(3000, 1, { -1, -1, -1 }, { 1, 1, 1 });
  const std::vector<Vec3> centers = trial::randomBox(60, 2, { -1.5, -1.5, -1.5 }, { 1.5, 1.5, 1.5 });
  for (const int k : { 1, 2, 7, 16, 64, 72, 73, 100 })
  {
    expectNearest(points, centers, k);
  }
}

TEST(NeighborQuery, BreaksTiesByIndexOnAGrid)
{
  std::vector<Vec3> points;
  for (const std::size_t i : trial::randomOrder(1000, 3))
  {
    points.emplace_back(double(i % 10), double(i / 10 % 10), double(i / 100));
  }
  const std::vector<Vec3> centers{ { 4, 4, 4 }, { 4.5, 4.5, 4.5 }, { 0, 0, 0 }, { 4.5, 4, 4 },
    { 20, 20, 20 } };
  for (const int k : { 1, 4, 7, 8, 27, 32 })
  {
    expectNearest(points, centers, k);
  }
}

TEST(NeighborQuery, HoldsEachPlaceOnce)
{
  std::vector<Vec3> points(500, Vec3(1, 2, 3));
  expectNearest(points, { { 1, 2, 3 }, { 0, 0, 0 } }, 20);
  for (int i = 0; i < 500; i += 3)
  {
    points[std::size_t(i)] = { double(i % 7), 0, 0 };
  }
  expectNearest(points, { { 1, 2, 3 }, { 0, 0, 0 }, { 3, 0, 0 } }, 40);
  std::vector<Vec3> cloud = trial::randomBox(3000, 4, { 0, 0, 0 }, { 1, 1, 1 });
  cloud.insert(cloud.end(), 40, cloud[7]);
  cloud.insert(cloud.end(), cloud.begin(), cloud.begin() + 3000);
  expectNearest(cloud, trial::randomBox(20, 5, { 0, 0, 0 }, { 1, 1, 1 }), 16);
  NeighborQuery query;
  query.build(view(cloud), trial::ThreadedExecutor(3));
  EXPECT_EQ(query.size(), 3000);
  EXPECT_EQ(query.finitePoints(), 6040);
  std::vector<std::int64_t> firsts(6040, -1);
  for (std::int64_t slot = 0; slot < query.size(); ++slot)
  {
    firsts[std::size_t(query.index(slot))] = query.index(slot);
  }
  query.copyToRepeats(firsts);
  for (std::int64_t i = 0; i < 6040; ++i)
  {
    ASSERT_EQ(firsts[std::size_t(i)], i < 3000 ? i : i < 3040 ? 7 : i - 3040);
  }
}

TEST(NeighborQuery, HandlesLinesAndPlanes)
{
  std::vector<Vec3> line;
  std::vector<Vec3> plane;
  trial::Random random(5);
  for (int i = 0; i < 1000; ++i)
  {
    line.push_back(random.uniform() * Vec3(1, 2, 3));
    plane.emplace_back(random.uniform(), random.uniform(), 0.0);
  }
  expectNearest(line, { { 0.5, 1, 1.5 }, { 0, 0, 0 }, { 1, 0, 0 } }, 12);
  expectNearest(plane, { { 0.5, 0.5, 0 }, { 0.5, 0.5, 3 } }, 12);
}

TEST(NeighborQuery, GivesTheWholeCloudWhenAskedForMore)
{
  for (const std::size_t n : { 0, 1, 2, 8, 9, 11 })
  {
    expectNearest(trial::randomBox(n, 6, { 0, 0, 0 }, { 1, 1, 1 }), { { 0.5, 0.5, 0.5 } }, 20);
  }
}

TEST(NeighborQuery, LeavesOutPointsThatAreNotFiniteAndKeepsIndices)
{
  std::vector<Vec3> points = trial::randomBox(300, 7, { 0, 0, 0 }, { 1, 1, 1 });
  points[0].x = NAN;
  points[100].y = INFINITY;
  points[299].z = -INFINITY;
  NeighborQuery query;
  query.build(view(points));
  EXPECT_EQ(query.size(), 297);
  expectNearest(points, trial::randomBox(20, 8, { 0, 0, 0 }, { 1, 1, 1 }), 16);
}

TEST(NeighborQuery, FollowsSixteenToOneDensitySteps)
{
  std::vector<Vec3> points = trial::randomBox(4000, 9, { 0, 0, 0 }, { 1, 1, 0 });
  const std::vector<Vec3> sparse = trial::randomBox(250, 10, { 1, 0, 0 }, { 2, 1, 0 });
  points.insert(points.end(), sparse.begin(), sparse.end());
  expectNearest(points, { { 1, 0.5, 0 }, { 0.999, 0.2, 0 }, { 1.5, 0.5, 0 } }, 30);
}

TEST(NeighborQuery, BallEqualsBruteForce)
{
  const std::vector<Vec3> points = trial::randomBox(3000, 11, { -1, -1, -1 }, { 1, 1, 1 });
  for (const Vec3& center : trial::randomBox(30, 12, { -1.2, -1.2, -1.2 }, { 1.2, 1.2, 1.2 }))
  {
    for (const double radius : { 0.0, 0.05, 0.3, 5.0 })
    {
      expectBall(points, center, radius);
    }
  }
}

TEST(NeighborQuery, BallIsClosed)
{
  std::vector<Vec3> grid;
  for (int i = 0; i < 1000; ++i)
  {
    grid.emplace_back(double(i % 10), double(i / 10 % 10), double(i / 100));
  }
  expectBall(grid, { 4, 4, 4 }, 1.0);
  expectBall(grid, { 4, 4, 4 }, 2.0);
  expectBall(grid, { 4, 4, 4 }, 0.0);
}

TEST(NeighborQuery, OfPlacesThatAreNotFiniteOrFarAwayEnds)
{
  const std::vector<Vec3> points = trial::randomBox(3000, 23, { 0, 0, 0 }, { 1, 1, 1 });
  NeighborQuery query;
  query.build(view(points));
  Neighbor found[17];
  for (const double bad : { double(NAN), double(INFINITY), 1e200 })
  {
    EXPECT_LE(query.nearest({ bad, 0.0, 0.0 }, 17, found), 17);
  }
  expectNearest(points, { { 1e100, 0.0, 0.0 }, { -3e5, 7e5, 2e5 } }, 17);
}

TEST(NeighborQuery, EmptyQueryFindsNothing)
{
  NeighborQuery query;
  Neighbor n;
  EXPECT_EQ(query.nearest({ 0, 0, 0 }, 1, &n), 0);
  query.visitBall({ 0, 0, 0 }, 1.0, [](const Vec3&, double, std::int64_t) { ADD_FAILURE(); });
}
