#include "Core/Neighbors/SurfaceMidpoints.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

using namespace pointhaptics;

namespace
{

std::vector<Vec3> midpointsOf(
  const std::vector<Vec3>& points, double sparse = 0.0, const Executor& executor = {})
{
  return surfaceMidpoints({ points.data(), std::int64_t(points.size()) }, sparse, executor);
}

/// Adds a square grid of one point a unit square, @p edge points along, from @p corner.
void addGrid(std::vector<Vec3>& points, int edge, const Vec3& corner)
{
  for (int i = 0; i < edge * edge; ++i)
  {
    points.push_back(corner + Vec3(i % edge, i / edge, 0.0));
  }
}

/// Calls visit(distance to the nearest point) for places of the plane z = 0, a unit and more from the border.
template <typename Visitor>
void visitGaps(const std::vector<Vec3>& points, double edge, Visitor visit)
{
  for (double x = 1.0; x < edge - 1.0; x += 0.11)
  {
    for (double y = 1.0; y < edge - 1.0; y += 0.11)
    {
      double least = 1e300;
      for (const Vec3& p : points)
      {
        least = std::min(least, norm2(p - Vec3(x, y, 0.0)));
      }
      visit(std::sqrt(least));
    }
  }
}

double largestGap(const std::vector<Vec3>& points, double edge)
{
  double gap = 0.0;
  visitGaps(points, edge, [&](double distance) { gap = std::max(gap, distance); });
  return gap;
}

/// How many of a thousand places are further than @p far from all points.
double partFurther(const std::vector<Vec3>& points, double edge, double far)
{
  int all = 0;
  int further = 0;
  visitGaps(points, edge,
    [&](double distance)
    {
      ++all;
      further += distance > far;
    });
  return 1e3 * further / all;
}

TEST(SurfaceMidpoints, HalveTheSpacingOfAGrid)
{
  std::vector<Vec3> points;
  addGrid(points, 14, Vec3());
  const std::vector<Vec3> middles = midpointsOf(points);
  points.insert(points.end(), middles.begin(), middles.end());
  EXPECT_GT(largestGap(points, 13.0), 0.3);
  EXPECT_LT(largestGap(points, 13.0), 0.36);
  const auto offPlane = [](const Vec3& p) { return std::abs(p.z) > 1e-12; };
  EXPECT_TRUE(std::none_of(middles.begin(), middles.end(), offPlane));
}

/// A point anywhere in the middle of each unit square of the square [0, @p edge)^2, at the height @p z.
void addUneven(std::vector<Vec3>& points, trial::Random& random, int edge, double z)
{
  for (int i = 0; i < edge * edge; ++i)
  {
    points.emplace_back(i % edge + random.uniform(0.1, 0.9), i / edge + random.uniform(0.1, 0.9), z);
  }
}

TEST(SurfaceMidpoints, FillTheGapsOfUnevenPoints)
{
  constexpr int kEdge = 24;
  trial::Random random(11);
  std::vector<Vec3> points;
  addUneven(points, random, kEdge, 0.0);
  const double before = largestGap(points, kEdge);
  const std::vector<Vec3> middles = midpointsOf(points);
  EXPECT_GT(middles.size(), 2.5 * points.size());
  points.insert(points.end(), middles.begin(), middles.end());
  EXPECT_LT(largestGap(points, kEdge), 0.65 * before);
}

TEST(SurfaceMidpoints, OfPointsAtRandomAreNone)
{
  // Noise moves those apart that lie near each other, and voxels leave one of each.
  constexpr double kVoxel = 0.8;
  for (const double noise : { 0.0, 0.1, 0.3 })
  {
    trial::Random random(12);
    std::vector<Vec3> points;
    std::set<std::array<int, 3>> taken;
    for (int i = 0; i < 2000; ++i)
    {
      const Vec3 p(random.uniform(0.0, 45.0), random.uniform(0.0, 45.0), noise * random.uniform(-1.7, 1.7));
      if (taken.insert({ int(p.x / kVoxel), int(p.y / kVoxel), int(std::floor(p.z / kVoxel)) }).second)
      {
        points.push_back(p);
      }
    }
    EXPECT_TRUE(midpointsOf(points).empty()) << noise;
  }
}

TEST(SurfaceMidpoints, FillTheGapsOfUnevenPointsOnAThinPlate)
{
  constexpr int kEdge = 32;
  constexpr double kFar = 0.5;
  for (const double thickness : { 1.0, 1.5, 2.0 })
  {
    trial::Random random(5);
    std::vector<Vec3> points;
    addUneven(points, random, kEdge, 0.0);
    std::vector<Vec3> side = points;
    addUneven(points, random, kEdge, thickness);
    const double before = partFurther(side, kEdge, kFar);
    for (const Vec3& p : midpointsOf(points))
    {
      if (p.z < 0.1 * thickness)
      {
        side.push_back(p);
      }
    }
    EXPECT_GT(before, 100.0);
    EXPECT_EQ(partFurther(side, kEdge, kFar), 0.0) << thickness;
  }
}

TEST(SurfaceMidpoints, StayOnBothSidesOfAThinPlate)
{
  for (const double thickness : { 0.7, 1.0, 1.5 })
  {
    std::vector<Vec3> points;
    addGrid(points, 14, Vec3());
    addGrid(points, 14, Vec3(0.3, 0.4, thickness));
    int within = 0;
    for (const Vec3& p : midpointsOf(points))
    {
      const bool isInside = p.x > 2.0 && p.x < 11.0 && p.y > 2.0 && p.y < 11.0;
      within += isInside && p.z > 0.1 * thickness && p.z < 0.9 * thickness;
    }
    EXPECT_EQ(within, 0) << thickness;
  }
}

TEST(SurfaceMidpoints, LeaveAGapOpen)
{
  std::vector<Vec3> points;
  addGrid(points, 12, Vec3());
  addGrid(points, 12, Vec3(11.0 + 4.1, 0.0, 0.0));
  for (const Vec3& p : midpointsOf(points))
  {
    // At corners of a sheet the neighbours are twice as far away.
    const bool isAtCorner = p.y < 2.0 || p.y > 9.0;
    EXPECT_TRUE(isAtCorner || p.x < 11.0 + 1e-9 || p.x > 11.0 + 4.1 - 1e-9) << p.x;
  }
}

/// A tube of eighteen rows keeps its shape: midpoints of its chords, none through it.
TEST(SurfaceMidpoints, OfATubeLieOnIt)
{
  constexpr double kRadius = 2.6;
  constexpr double kPi = 3.14159265358979323846;
  std::vector<Vec3> points;
  for (int i = 0; i < 18 * 30; ++i)
  {
    const double angle = kPi * (i % 18) / 9.0;
    points.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle), 1.5 * (i / 18));
  }
  const std::vector<Vec3> middles = midpointsOf(points);
  EXPECT_GT(middles.size(), 2.5 * points.size());
  for (const Vec3& p : middles)
  {
    EXPECT_GT(std::hypot(p.x, p.y), kRadius * std::cos(kPi / 18.0) - 1e-9);
  }
}

TEST(SurfaceMidpoints, AreLeftOutWherePointsAreDense)
{
  std::vector<Vec3> points;
  addGrid(points, 14, Vec3());
  EXPECT_FALSE(midpointsOf(points, 0.9).empty());
  EXPECT_TRUE(midpointsOf(points, 3.0).empty());
}

TEST(SurfaceMidpoints, OfFewPointsAreNone)
{
  std::vector<Vec3> points;
  EXPECT_TRUE(midpointsOf(points).empty());
  addGrid(points, 2, Vec3());
  EXPECT_TRUE(midpointsOf(points).empty());
  points.assign(50, Vec3(1.0, 2.0, 3.0));
  EXPECT_TRUE(midpointsOf(points).empty());
}

TEST(SurfaceMidpoints, DoNotDependOnTheExecutor)
{
  trial::Random random(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i)
  {
    points.emplace_back(
      i % 50 + random.uniform(0.2, 0.8), i / 50 + random.uniform(0.2, 0.8), random.uniform(0.0, 0.2));
  }
  const std::vector<Vec3> one = midpointsOf(points);
  EXPECT_GT(one.size(), points.size());
  EXPECT_TRUE(one == midpointsOf(points, 0.0, trial::ThreadedExecutor(3)));
  EXPECT_TRUE(one == midpointsOf(points, 0.0, trial::BackwardExecutor(7)));
}

} // namespace
