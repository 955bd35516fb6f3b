#include "Core/Neighbors/SpatialOrder.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;
using trial::view;

namespace
{

using Order = std::vector<std::uint32_t>;

void expectEachOnce(Order order, std::size_t n)
{
  std::sort(order.begin(), order.end());
  ASSERT_EQ(order.size(), n);
  for (std::size_t i = 0; i < n; ++i)
  {
    ASSERT_EQ(order[i], i);
  }
}

double lengthOfPath(const std::vector<Vec3>& points, const Order& order)
{
  double length = 0.0;
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    length += norm(points[order[i]] - points[order[i - 1]]);
  }
  return length;
}

} // namespace

TEST(SpatialOrder, HasEveryPointOnce)
{
  for (const std::size_t n : { 0, 1, 2, 15, 16, 17, 5000 })
  {
    expectEachOnce(spatialOrder(view(trial::randomBox(n, 1, { 0, 0, 0 }, { 1, 2, 3 })), 16), n);
  }
  expectEachOnce(spatialOrder(view(std::vector<Vec3>(5000, Vec3(1, 2, 3))), 16), 5000);
}

TEST(SpatialOrder, LeavesOutPointsThatAreNotFinite)
{
  std::vector<Vec3> points = trial::randomBox(100, 2, { 0, 0, 0 }, { 1, 1, 1 });
  points[7].x = NAN;
  points[99].z = -INFINITY;
  const Order order = spatialOrder(view(points), 16);
  EXPECT_EQ(order.size(), 98u);
  EXPECT_EQ(std::count(order.begin(), order.end(), 7u) + std::count(order.begin(), order.end(), 99u), 0);
  EXPECT_TRUE(spatialOrder(view({ { NAN, 0, 0 } }), 16).empty());
}

TEST(SpatialOrder, OfACompleteGridStepsFromCellToCell)
{
  std::vector<Vec3> points;
  for (const std::size_t i : trial::randomOrder(32 * 32 * 32, 3))
  {
    points.emplace_back(double(i % 32), double(i / 32 % 32), double(i / 1024));
  }
  EXPECT_DOUBLE_EQ(lengthOfPath(points, spatialOrder(view(points), 16)), 32.0 * 32.0 * 32.0 - 1.0)
    << "Hilbert's curve never jumps";
}

TEST(SpatialOrder, IsCompactWhereAFewPointsAreFarAway)
{
  std::vector<Vec3> points = trial::randomBox(5000, 4, { 0, 0, 0 }, { 1, 1, 0 });
  const double alone = lengthOfPath(points, spatialOrder(view(points), 16));
  points.emplace_back(1e12, 0, 0);
  points.emplace_back(0, -1e6, 0);
  const Order order = spatialOrder(view(points), 16);
  Order near;
  std::copy_if(
    order.begin(), order.end(), std::back_inserter(near), [](std::uint32_t i) { return i < 5000; });
  EXPECT_LT(lengthOfPath(points, near), 1.5 * alone);
}

TEST(SpatialOrder, KeepsEqualPointsInTheOrderOfTheirIndices)
{
  std::vector<Vec3> points;
  trial::Random random(5);
  for (int i = 0; i < 4000; ++i)
  {
    points.emplace_back(double(random.below(5)), double(random.below(5)), 0.0);
  }
  const Order order = spatialOrder(view(points), 16);
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    if (points[order[i]] == points[order[i - 1]])
    {
      ASSERT_LT(order[i - 1], order[i]);
    }
  }
}

TEST(SpatialOrder, SurvivesEveryExtent)
{
  for (const double scale : { 5e-324, 1e-310, 1e-200, 1e9, 1.7e308 })
  {
    std::vector<Vec3> points = trial::randomBox(1000, 6, { -1, -1, -1 }, { 1, 1, 1 });
    for (Vec3& p : points)
    {
      p *= scale;
    }
    expectEachOnce(spatialOrder(view(points), 16), 1000);
  }
  std::vector<Vec3> shrinking;
  for (int i = 0; i < 2000; ++i)
  {
    shrinking.emplace_back(std::ldexp(1.0, -i / 2), std::ldexp(1.0, -i), 0.0);
  }
  expectEachOnce(spatialOrder(view(shrinking), 16), 2000);
}

TEST(SpatialOrder, DoesNotDependOnThreadsNorOnTheTypeOfNumber)
{
  std::vector<Vec3> points = trial::randomBox(20000, 7, { 0, 0, 0 }, { 1, 1, 0.1 });
  std::vector<float> floats;
  for (Vec3& p : points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      floats.push_back(float(p[axis]));
      p[axis] = double(floats.back());
    }
  }
  const Order order = spatialOrder(view(points), 16);
  EXPECT_EQ(spatialOrder({ floats.data(), 20000 }, 16), order);
  EXPECT_EQ(spatialOrder(view(points), 16, trial::BackwardExecutor(1)), order);
  for (const int threads : { 2, 8 })
  {
    EXPECT_EQ(spatialOrder(view(points), 16, trial::ThreadedExecutor(threads)), order);
  }
}
