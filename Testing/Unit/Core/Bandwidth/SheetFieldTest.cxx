#include "Core/Bandwidth/SheetField.h"

#include "Unit/Core/RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;

namespace
{

constexpr double kSpacing = 1e-3;

/// Random points of a square about the origin, one in kSpacing^2 times @p ratio^2.
void addSquare(
  std::vector<Vec3>& points, trial::Random& random, const Vec3& low, const Vec3& high, double ratio)
{
  const double area = (high.x - low.x) * (high.y - low.y);
  const auto count = std::size_t(area / (kSpacing * kSpacing * ratio * ratio));
  for (std::size_t i = 0; i < count; ++i)
  {
    points.push_back(random.inBox(low, high));
  }
}

std::vector<SheetPoint> fieldOf(const std::vector<Vec3>& points, const Executor& executor = {})
{
  return sheetField({ points.data(), std::int64_t(points.size()) }, { 1e-5, 0.0 }, executor);
}

} // namespace

TEST(SheetField, FindsTheSpacingOfAPlaneAndOfItsRim)
{
  trial::Random random(1);
  std::vector<Vec3> points;
  addSquare(points, random, { -0.05, -0.05, 0 }, { 0.05, 0.05, 0 }, 1.0);
  double inner = 0.0;
  double innerCount = 0.0;
  double rim = 0.0;
  double rimCount = 0.0;
  const std::vector<SheetPoint> field = fieldOf(points);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_NEAR(std::abs(double(field[i].normal[2])), 1.0, 1e-6);
    EXPECT_GE(double(field[i].radius), 1.5 * kSpacing) << i;
    const double edge = 0.05 - std::max(std::abs(points[i].x), std::abs(points[i].y));
    inner += edge > 3.0 * kSpacing ? double(field[i].spacing) : 0.0;
    innerCount += edge > 3.0 * kSpacing;
    rim += edge < 0.5 * kSpacing ? double(field[i].spacing) : 0.0;
    rimCount += edge < 0.5 * kSpacing;
  }
  EXPECT_NEAR(inner / innerCount, kSpacing, 0.1 * kSpacing);
  EXPECT_NEAR(rim / rimCount, kSpacing, 0.35 * kSpacing) << "a rim is no sparser";
}

TEST(SheetField, SeesOneFaceBesideAnEdge)
{
  trial::Random random(2);
  std::vector<Vec3> points;
  addSquare(points, random, { -0.03, -0.03, 0 }, { 0.0, 0.03, 0 }, 1.0);
  const std::size_t onTop = points.size();
  std::vector<Vec3> side;
  addSquare(side, random, { -0.03, -0.03, 0 }, { 0.0, 0.03, 0 }, 1.0);
  for (const Vec3& p : side)
  {
    points.emplace_back(0.0, p.y, p.x);
  }
  const std::vector<SheetPoint> field = fieldOf(points);
  int turned = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    turned += std::abs(double(field[i].normal[i < onTop ? 2 : 0])) < 0.9;
    EXPECT_LT(double(field[i].radius), 5.0 * kSpacing) << i;
  }
  EXPECT_LT(turned, int(points.size()) / 30) << "of " << points.size();
}

TEST(SheetField, LetsTheSparserSideOfAStepReachIntoTheDenserOne)
{
  constexpr double kRatio = 8.0;
  trial::Random random(3);
  std::vector<Vec3> points;
  addSquare(points, random, { -0.1, -0.1, 0 }, { 0.0, 0.1, 0 }, 1.0);
  addSquare(points, random, { 0.0, -0.1, 0 }, { 0.1, 0.1, 0 }, kRatio);
  const std::vector<SheetPoint> field = fieldOf(points);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const bool isInside = std::abs(points[i].y) < 0.05 && std::abs(points[i].x) < 0.06;
    if (isInside && points[i].x > -kSpacing)
    {
      EXPECT_GT(double(field[i].radius), 1.6 * kRatio * kSpacing) << points[i].x;
    }
    for (std::size_t j = 0; isInside && j < points.size(); j += 997)
    {
      // Twice the slope: from point to point the way is longer than straight.
      EXPECT_GE(double(field[i].radius),
        double(field[j].radius) - 0.5 * norm(points[i] - points[j]) - 3.0 * kRatio * kSpacing);
    }
  }
}

TEST(SheetField, TakesStraysRowsAndScatterForNoSheet)
{
  trial::Random random(4);
  std::vector<Vec3> points;
  addSquare(points, random, { -0.05, -0.05, 0 }, { 0.05, 0.05, 0 }, 1.0);
  const std::size_t sheet = points.size();
  for (int i = 0; i < 40; ++i)
  {
    points.push_back(random.inBox({ -0.05, -0.05, 0.02 }, { 0.05, 0.05, 0.06 }));
  }
  for (int i = 0; i < 40; ++i)
  {
    points.emplace_back(0.002 * i, 0.0, 0.2);
  }
  points.emplace_back(0.3, 0.0, 0.0);
  points.emplace_back(0.055, 0.0, 0.0); // a few spacings beyond the rim
  const std::vector<SheetPoint> field = fieldOf(points);
  for (std::size_t i = sheet; i < points.size(); ++i)
  {
    EXPECT_EQ(field[i].spacing, 0.0F) << i;
    EXPECT_FLOAT_EQ(field[i].radius, 1e-5F) << i;
  }
}

TEST(SheetField, IsTheSameWithAnyNumberOfThreadsAndOrderOfPoints)
{
  trial::Random random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < 20000; ++i)
  {
    points.push_back((0.02 + 2e-4 * random.uniform(-1, 1)) * random.direction());
  }
  const std::vector<SheetPoint> one = fieldOf(points);
  const std::vector<SheetPoint> four = fieldOf(points, trial::ThreadedExecutor(4));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    ASSERT_EQ(one[i].radius, four[i].radius) << i;
    ASSERT_EQ(one[i].spacing, four[i].spacing) << i;
  }
}

TEST(SheetField, HasLeastRadiiWhereThereAreFewPoints)
{
  EXPECT_TRUE(fieldOf({}).empty());
  for (const std::size_t count : { 1, 2, 3, 5 })
  {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i)
    {
      points.emplace_back(0.01 * double(i), 0.001 * double(i * i), 0.0);
    }
    for (const SheetPoint& point : fieldOf(points))
    {
      EXPECT_GE(point.radius, 1e-5F);
      EXPECT_TRUE(std::isfinite(point.radius));
    }
  }
}
