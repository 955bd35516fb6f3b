#include "ProgressiveOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace pointhaptics;

namespace
{

/// Points of a scan: row by row, and ten times as dense in one eighth of the cube.
std::vector<Vec3> unevenCloud(int count)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0.0, 1.0);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i)
  {
    const double size = i % 17 < 10 ? 0.5 : 1.0;
    points.push_back({ size * anywhere(random), size * anywhere(random), size * anywhere(random) });
  }
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
  return points;
}

TEST(ProgressiveOrder, IsAPermutation)
{
  for (const int count : { 0, 1, 2, 1000, 1024, 1025 })
  {
    const std::vector<Vec3> points = unevenCloud(count);
    std::vector<std::uint32_t> order = progressiveOrder({ points.data(), std::int64_t(points.size()) });
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order.size(), points.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      EXPECT_EQ(order[i], i);
    }
  }
}

TEST(ProgressiveOrder, EveryBeginningTakesFromEveryCubeItsShare)
{
  constexpr int kCubes = 4; // per edge
  const std::vector<Vec3> points = unevenCloud(60000);
  const std::vector<std::uint32_t> order = progressiveOrder({ points.data(), std::int64_t(points.size()) });
  // Box of the order.
  Bounds bounds;
  for (const Vec3& p : points)
  {
    bounds.include(p);
  }
  const Vec3 extent = bounds.extent();
  const double edge = std::max({ extent.x, extent.y, extent.z });
  const auto cubeOf = [&](const Vec3& p)
  {
    std::size_t cube = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double cell = kCubes * (p[axis] - bounds.minimum[axis]) / edge;
      cube = kCubes * cube + std::size_t(std::min(kCubes - 1, int(cell)));
    }
    return cube;
  };
  std::array<double, kCubes * kCubes * kCubes> all{};
  for (const Vec3& p : points)
  {
    all[cubeOf(p)] += 1.0;
  }
  for (const std::size_t taken : { 500u, 4000u, 5657u, 32768u, 50001u })
  {
    std::array<double, all.size()> some{};
    for (std::size_t i = 0; i < taken; ++i)
    {
      some[cubeOf(points[std::size_t(order[i])])] += 1.0;
    }
    const double share = double(taken) / double(points.size());
    for (std::size_t cube = 0; cube < all.size(); ++cube)
    {
      EXPECT_NEAR(some[cube], share * all[cube], 8.0) << taken << " points, cube " << cube;
    }
  }
}

TEST(ProgressiveOrder, TakesPointsThatAreNotFiniteAndPointsInOnePlace)
{
  const std::vector<Vec3> points = { { NAN, 0, 0 }, { 1, 1, 1 }, { 1, 1, 1 }, { INFINITY, 0, 2 } };
  EXPECT_EQ(progressiveOrder({ points.data(), 4 }).size(), 4u);
}

} // namespace
