#include "ProgressiveOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
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
    std::vector<std::uint32_t> order =
      progressiveOrder({ points.data(), std::int64_t(points.size()) }).indices;
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order.size(), points.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      EXPECT_EQ(order[i], i);
    }
  }
}

TEST(ProgressiveOrder, EveryPointLiesInACellWithOneOfEachStep)
{
  const std::vector<Vec3> points = unevenCloud(60000);
  const ProgressiveOrder order = progressiveOrder({ points.data(), std::int64_t(points.size()) });
  Bounds bounds;
  for (const Vec3& p : points)
  {
    bounds.include(p);
  }
  const auto cellOf = [&](std::uint32_t index, double gap)
  {
    const Vec3 place = (1.0 / gap) * (points[index] - bounds.minimum);
    return std::array<int, 3>{ int(place.x), int(place.y), int(place.z) };
  };
  std::int64_t last = 0;
  for (const ProgressiveOrder::Step& step : order.steps)
  {
    EXPECT_GT(step.end, last);
    last = step.end;
    const double halvings = step.gap > 0.0 ? std::log2(order.edge / step.gap) : 0.5;
    if (std::abs(halvings - std::round(halvings)) > 1e-9 || halvings < 0.5)
    {
      continue; // between two lattices
    }
    std::map<std::array<int, 3>, int> drawn;
    for (std::int64_t i = 0; i < step.end; ++i)
    {
      ++drawn[cellOf(order.indices[std::size_t(i)], step.gap)];
    }
    int missed = 0;
    for (std::uint32_t i = 0; i < points.size(); ++i)
    {
      missed += drawn.count(cellOf(i, step.gap)) == 0;
    }
    // The last cell of an edge ends with the box; rounding moves others.
    EXPECT_LT(missed, 10) << step.end << " points";
    EXPECT_LT(step.end, std::int64_t(drawn.size()) + 10) << "more than one in a cell";
  }
  EXPECT_EQ(last, std::int64_t(points.size()));
}

TEST(ProgressiveOrder, TakesPointsThatAreNotFiniteAndPointsInOnePlace)
{
  const std::vector<Vec3> points = { { NAN, 0, 0 }, { 1, 1, 1 }, { 1, 1, 1 }, { INFINITY, 0, 2 } };
  EXPECT_EQ(progressiveOrder({ points.data(), 4 }).indices.size(), 4u);
}

} // namespace
