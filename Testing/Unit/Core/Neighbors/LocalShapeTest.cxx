#include "Core/Neighbors/LocalShape.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace pointhaptics;

namespace
{

LocalShape measured(const std::vector<Vec3>& points, const LocalShapeSettings& settings = {})
{
  const PointView view(points.data(), std::int64_t(points.size()));
  NeighborQuery query;
  query.build(view);
  LocalShape shape;
  EXPECT_EQ(measureLocalShape(view, query, settings, shape), Status::Ok);
  return shape;
}

Vec3 normalOf(const PointShape& shape)
{
  return { double(shape.normal[0]), double(shape.normal[1]), double(shape.normal[2]) };
}

std::vector<Vec3> grid(int edge, double spacing)
{
  std::vector<Vec3> points;
  for (int i = 0; i < edge * edge; ++i)
  {
    points.emplace_back(spacing * (i % edge), spacing * (i / edge), 0.0);
  }
  return points;
}

std::vector<Vec3> sphere(int count, double radius)
{
  std::vector<Vec3> points;
  trial::Random random(5);
  while (int(points.size()) < count)
  {
    const Vec3 p{ random.uniform() * 2 - 1, random.uniform() * 2 - 1, random.uniform() * 2 - 1 };
    if (norm(p) > 0.1 && norm(p) < 1.0)
    {
      points.push_back(radius * normalized(p));
    }
  }
  return points;
}

TEST(LocalShape, OfAPlaneIsFlatWithItsNormal)
{
  const Vec3 normal = normalized({ 1.0, 2.0, 3.0 });
  const Vec3 u = anyPerpendicular(normal);
  std::vector<Vec3> points = grid(40, 0.5);
  for (Vec3& p : points)
  {
    p = p.x * u + p.y * cross(normal, u) + Vec3(500000.0, 5e6, 100.0);
  }
  const LocalShape shape = measured(points);
  for (int i = 0; i < 1600; ++i)
  {
    const PointShape& each = shape.points[std::size_t(i)];
    const bool isInside = i % 40 > 3 && i % 40 < 36 && i / 40 > 3 && i / 40 < 36;
    if (isInside)
    {
      EXPECT_NEAR(each.spacing, 0.5, 0.08);
      EXPECT_NEAR(each.flatness, 1.0, 1e-4);
      EXPECT_GT(std::abs(dot(normalOf(each), normal)), 1.0 - 1e-5);
    }
  }
  EXPECT_NEAR(shape.medianSpacing, 0.5, 0.08);
  EXPECT_LT(shape.noise, 1e-3);
}

TEST(LocalShape, ReachesTheCornersOfTheCellsOfAGrid)
{
  const LocalShape shape = measured(grid(30, 0.5));
  for (int i = 0; i < 900; ++i)
  {
    const bool isInside = i % 30 > 3 && i % 30 < 26 && i / 30 > 3 && i / 30 < 26;
    if (isInside)
    {
      EXPECT_NEAR(shape.points[std::size_t(i)].reach, 0.5 * std::sqrt(0.5), 1e-6) << i;
    }
  }
}

TEST(LocalShape, ReachClosesPointsAtRandom)
{
  trial::Random random(9);
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i)
  {
    points.emplace_back(random.uniform(), random.uniform(), 0.0);
  }
  const LocalShape shape = measured(points);
  int open[2] = { 0, 0 };
  constexpr int kPlaces = 4000;
  for (int i = 0; i < kPlaces; ++i)
  {
    const Vec3 place{ 0.1 + 0.8 * random.uniform(), 0.1 + 0.8 * random.uniform(), 0.0 };
    bool bySpacing = false;
    bool byReach = false;
    for (std::size_t p = 0; p < points.size(); ++p)
    {
      const double distance = norm(points[p] - place);
      bySpacing = bySpacing || distance <= 0.9 * double(shape.points[p].spacing);
      byReach = byReach || distance <= double(shape.points[p].reach);
    }
    open[0] += !bySpacing;
    open[1] += !byReach;
  }
  EXPECT_GT(open[0], kPlaces / 100) << "the mean spacing closes them already";
  EXPECT_LT(open[1], kPlaces / 400);
}

TEST(LocalShape, DoesNotReachIntoHoles)
{
  // A grid without its middle: what is at the edge of the hole has corners there, far away.
  std::vector<Vec3> points;
  for (const Vec3& p : grid(40, 0.5))
  {
    if (norm(p - Vec3(10.0, 10.0, 0.0)) > 3.0)
    {
      points.push_back(p);
    }
  }
  const LocalShape shape = measured(points);
  for (const PointShape& each : shape.points)
  {
    EXPECT_LT(each.reach, PointShape::kLargestReach * double(each.spacing));
    EXPECT_LE(each.reach, 0.8F) << "where the hole has a radius of 3";
  }
}

TEST(LocalShape, HasNoReachWhereNothingIsFlat)
{
  trial::Random random(4);
  std::vector<Vec3> line;
  for (int i = 0; i < 200; ++i)
  {
    line.emplace_back(0.01 * i + 0.002 * random.uniform(), 0.0, 0.0);
  }
  for (const PointShape& each : measured(line).points)
  {
    EXPECT_EQ(each.reach, 0.0F);
  }
}

TEST(LocalShape, OfASphereHasRadialNormals)
{
  const std::vector<Vec3> points = sphere(20000, 2.0);
  const LocalShape shape = measured(points);
  // The area over the points, for a random sample.
  EXPECT_NEAR(shape.medianSpacing, std::sqrt(4 * 3.14159265 * 4.0 / 20000), 0.1 * 0.05);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_GT(std::abs(dot(normalOf(shape.points[i]), normalized(points[i]))), 0.99);
  }
  EXPECT_GT(shape.meanFlatness, 0.9);
}

TEST(LocalShape, OfALineAndOfFoliageIsNotFlat)
{
  std::vector<Vec3> line;
  for (int i = 0; i < 300; ++i)
  {
    line.emplace_back(0.01 * i, 0.02 * i, 0.0);
  }
  EXPECT_LT(measured(line).meanFlatness, 1e-6);
  EXPECT_LT(measured(trial::randomBox(3000, 3, { 0, 0, 0 }, { 1, 1, 1 })).meanFlatness, 0.2);
}

TEST(LocalShape, SeesTheNoiseOfASurface)
{
  for (const double sigma : { 0.05, 0.15 })
  {
    std::vector<Vec3> points = grid(60, 1.0);
    trial::Random random(7);
    for (Vec3& p : points)
    {
      p.z = sigma * random.normal();
    }
    LocalShapeSettings settings;
    settings.pixel = 100.0; // 48 neighbours
    const LocalShape shape = measured(points, settings);
    EXPECT_NEAR(shape.noise * shape.medianSpacing, sigma, 0.2 * sigma);
  }
}

TEST(LocalShape, CountsPointsAtOnePlaceOnce)
{
  std::vector<Vec3> points = grid(30, 1.0);
  const LocalShape once = measured(points);
  const std::vector<Vec3> copy = points;
  for (int i = 0; i < 3; ++i)
  {
    points.insert(points.end(), copy.begin(), copy.end());
  }
  const LocalShape shape = measured(points);
  ASSERT_EQ(shape.points.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(shape.points[i].spacing, once.points[i % 900].spacing);
    EXPECT_EQ(shape.points[i].flatness, once.points[i % 900].flatness);
  }
  const LocalShape same = measured(std::vector<Vec3>(100, Vec3(1, 2, 3)));
  EXPECT_EQ(same.points[50].spacing, 0.0F);
  EXPECT_EQ(same.points[50].flatness, 0.0F);
}

TEST(LocalShape, TakesMoreNeighborsWhereAPixelHoldsMany)
{
  LocalShapeSettings settings;
  settings.pixel = 0.45; // a disc of 20
  EXPECT_EQ(measured(grid(30, 1.0), settings).numberOfNeighbors, 16);
  settings.pixel = 0.575; // a disc of 33
  EXPECT_NEAR(measured(grid(30, 1.0), settings).numberOfNeighbors, 33, 5);
  settings.pixel = 100.0;
  EXPECT_EQ(measured(grid(30, 1.0), settings).numberOfNeighbors, 48);
}

TEST(LocalShape, IsMeasuredAtPointsThatAreApartAndSharedByTheOthers)
{
  const std::vector<Vec3> points = sphere(60000, 1.0);
  const LocalShape all = measured(points);
  LocalShapeSettings settings;
  settings.apart = 4.0 * all.medianSpacing;
  const LocalShape some = measured(points, settings);
  ASSERT_EQ(some.points.size(), points.size());
  EXPECT_NEAR(some.medianSpacing, all.medianSpacing, 0.06 * all.medianSpacing) << "among all points";
  EXPECT_GT(some.meanFlatness, 0.95 * all.meanFlatness);
  std::set<float> spacings;
  double reach = 0.0;
  double reachOfAll = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_GT(std::abs(dot(normalOf(some.points[i]), points[i])), 0.99);
    spacings.insert(some.points[i].spacing);
    reach += double(some.points[i].reach);
    reachOfAll += double(all.points[i].reach);
  }
  EXPECT_LT(spacings.size(), points.size() / 8);
  EXPECT_NEAR(reach, reachOfAll, 0.05 * reachOfAll);
}

TEST(LocalShape, MeasuresAllWhereNoPointsAreNear)
{
  const std::vector<Vec3> points = grid(30, 1.0);
  LocalShapeSettings settings;
  settings.apart = 0.9;
  const LocalShape some = measured(points, settings);
  const LocalShape all = measured(points);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(some.points[i].spacing, all.points[i].spacing);
    EXPECT_EQ(some.points[i].flatness, all.points[i].flatness);
    EXPECT_EQ(some.points[i].reach, all.points[i].reach);
  }
}

TEST(LocalShape, OfFewOrNoPointsIsLeftOpen)
{
  const std::vector<Vec3> two = { { 0, 0, 0 }, { 3, 0, 0 }, { NAN, 0, 0 } };
  const LocalShape shape = measured(two);
  EXPECT_GT(shape.points[0].spacing, 0.0F);
  EXPECT_EQ(shape.points[0].flatness, 0.0F);
  EXPECT_EQ(shape.points[2].spacing, 0.0F);

  LocalShape none;
  EXPECT_EQ(measureLocalShape({}, NeighborQuery(), {}, none), Status::Empty);
  LocalShapeSettings settings;
  settings.apart = -1.0;
  EXPECT_EQ(measureLocalShape({}, NeighborQuery(), settings, none), Status::InvalidParameter);
}

/// Says no at its third question.
class ImpatientObserver : public ProgressObserver
{
public:
  bool report(double part) override
  {
    last_ = part;
    return ++reports_ < 3;
  }
  double last_ = 0.0;

private:
  int reports_ = 0;
};

TEST(LocalShape, EndsSoonWhereItIsAskedTo)
{
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i)
  {
    for (int j = 0; j < 600; ++j)
    {
      points.push_back({ double(i), double(j), 0.01 * (i % 7) });
    }
  }
  const PointView view{ points.data(), std::int64_t(points.size()) };
  NeighborQuery query;
  query.build(view);
  LocalShape shape;
  ImpatientObserver observer;
  EXPECT_EQ(measureLocalShape(view, query, {}, shape, {}, &observer), Status::Aborted);
  EXPECT_LT(observer.last_, 0.5);
}

/// Discs of the reach, grown by a tenth as SplatLook draws them, leave one place in 100,000 open at most.
TEST(LocalShape, ReachClosesTheWideGapsOfPointsAtRandom)
{
  trial::Random random(12);
  std::vector<Vec3> points;
  for (int i = 0; i < 20000; ++i)
  {
    points.emplace_back(random.uniform(), random.uniform(), 0.0);
  }
  const PointView view(points.data(), std::int64_t(points.size()));
  NeighborQuery query;
  query.build(view);
  const LocalShape shape = measured(points);
  int open = 0;
  for (int i = 0; i < 200000; ++i)
  {
    const Vec3 place{ 0.1 + 0.8 * random.uniform(), 0.1 + 0.8 * random.uniform(), 0.0 };
    Neighbor near[8];
    const int count = query.nearest(place, 8, near);
    open += std::none_of(near, near + count,
      [&](const Neighbor& each)
      {
        const PointShape& disc = shape.points[std::size_t(each.index)];
        return std::sqrt(each.squaredDistance) <= 1.1 * double(std::max(disc.spacing, disc.reach));
      });
  }
  EXPECT_LE(open, 2);
}

TEST(LocalShape, OfAFewPointsFarFromASurfaceIsThatOfTheSurface)
{
  std::vector<Vec3> points = grid(60, 0.5);
  const std::size_t first = points.size();
  points.emplace_back(15.0, 15.0, 20.0); // alone
  for (int i = 0; i < 9; ++i)
  {
    points.emplace_back(5.0 + 4.0 * (i % 3), 25.0, 10.0 + 4.0 * (i / 3)); // a sparse wall of a few
  }
  const LocalShape shape = measured(points);
  for (std::size_t i = first; i < points.size(); ++i)
  {
    EXPECT_LT(shape.points[i].spacing, 2.5F) << i;
    EXPECT_LT(shape.points[i].flatness * shape.points[i].reach, 1.5F) << i;
  }
  EXPECT_NEAR(shape.points[1830].spacing, 0.5, 0.08);
}

} // namespace
