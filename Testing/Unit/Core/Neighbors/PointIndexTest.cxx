#include "Core/Neighbors/PointIndex.h"

#include "CountingObserver.h"
#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include <gtest/gtest.h>

#include <cfloat>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

PointIndex indexOf(const std::vector<Vec3>& points, const Executor& executor = {})
{
  PointIndex index;
  EXPECT_EQ(index.build({ points.data(), std::int64_t(points.size()) }, executor), Status::Ok);
  return index;
}

/// Every finite point is there once, as it is in the cloud.
void expectHoldsFinitePoints(const PointIndex& index, const PointView& cloud)
{
  std::vector<bool> seen(std::size_t(cloud.size()), false);
  const PointView sorted = index.points();
  for (std::int64_t i = 0; i < sorted.size(); ++i)
  {
    const std::int64_t original = index.originals()[i];
    ASSERT_TRUE(original >= 0 && original < cloud.size());
    ASSERT_FALSE(seen[std::size_t(original)]);
    seen[std::size_t(original)] = true;
    ASSERT_EQ(sorted[i], cloud[original]);
  }
  std::int64_t finite = 0;
  for (std::int64_t i = 0; i < cloud.size(); ++i)
  {
    ASSERT_EQ(seen[std::size_t(i)], isFinite(cloud[i]));
    finite += isFinite(cloud[i]);
  }
  EXPECT_EQ(sorted.size(), finite);
  EXPECT_EQ(index.cloudSize(), cloud.size());
  EXPECT_EQ(index.invalidPoints(), cloud.size() - finite);
}

/// Points in the ranges, which ascend and do not touch. All points inside are among them.
std::int64_t expectCovers(const PointIndex& index, const AffineTransform& transform, const Lattice& lattice)
{
  const PointView points = index.points();
  std::vector<bool> inRange(std::size_t(points.size()), false);
  std::int64_t end = -1;
  std::int64_t sum = 0;
  for (const PointRange& range : index.rangesInside(transform, lattice))
  {
    EXPECT_TRUE(range.begin > end && range.begin < range.end && range.end <= points.size());
    end = range.end;
    sum += range.end - range.begin;
    std::fill(inRange.begin() + range.begin, inRange.begin() + range.end, true);
  }
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const bool inside = lattice.contains(lattice.continuousIndex(transform.apply(points[i])));
    EXPECT_TRUE(inRange[std::size_t(i)] || !inside) << "point " << i;
  }
  return sum;
}

AffineTransform randomTransform(Random& random, double scale)
{
  AffineTransform shear;
  shear.m[0][1] = random.uniform(-2, 2);
  shear.m[1][2] = random.uniform(-2, 2);
  const double mirror = random.below(2) == 0 ? -1.0 : 1.0;
  return AffineTransform::translation(scale * random.inBox({ -9, -9, -9 }, { 9, 9, 9 })) *
    AffineTransform::rotation(random.uniform(0, 360), random.direction()) * shear *
    AffineTransform::scaling(scale * Vec3(mirror, random.uniform(0.1, 2), 1));
}

/// A lattice about where @p center goes, whose end may cut through it.
Lattice latticeAbout(Random& random, const Vec3& center, double extent)
{
  Lattice lattice;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto n = std::int64_t(1 + random.below(60));
    lattice.dimensions[std::size_t(axis)] = n;
    lattice.spacing[axis] = extent * random.uniform(0.1, 1) / double(n);
    lattice.origin[axis] = center[axis] - 0.5 * double(n) * lattice.spacing[axis];
    lattice.end[axis] = random.below(2) == 0 ? double(n) * random.uniform(0.3, 1) : INFINITY;
  }
  return lattice;
}

} // namespace

TEST(PointIndex, HoldsTheFinitePointsOfCloudsOfBothPrecisions)
{
  std::vector<Vec3> points = randomBox(30000, 1, { -1, 2, 3 }, { 1, 4, 9 });
  for (std::size_t i = 0; i < 30000; i += 97)
  {
    points[i][int(i % 3)] = i % 2 == 0 ? double(NAN) : -INFINITY;
  }
  std::vector<float> floats;
  for (const Vec3& p : points)
  {
    floats.insert(floats.end(), { float(p.x), float(p.y), float(p.z) });
  }
  for (const int threads : { 1, 2, 5 })
  {
    const ThreadedExecutor executor(threads);
    expectHoldsFinitePoints(indexOf(points, executor), { points.data(), 30000 });
    PointIndex index;
    ASSERT_EQ(index.build({ floats.data(), 30000 }, executor), Status::Ok);
    expectHoldsFinitePoints(index, { floats.data(), 30000 });
    EXPECT_NE(index.points().floats(), nullptr);
  }
}

TEST(PointIndex, HoldsDegenerateClouds)
{
  std::vector<std::vector<Vec3>> clouds{ { { 1, 2, 3 } }, std::vector<Vec3>(5000, Vec3(0.1, -7, 1e9)),
    randomBox(5000, 2, { 3, 0, -1 }, { 3, 1, -1 }), randomBox(5000, 3, { 0, 5, 5 }, { 0, 5, 6 }),
    randomBox(5000, 4, { -1e308, -1e308, -1e308 }, { 0.7e308, 1e307, 0.5e308 }),
    randomBox(5000, 5, { 1e300, 0, 1e-300 }, { 1.01e300, DBL_TRUE_MIN, 2e-300 }),
    { { -DBL_MAX, 0, 0 }, { DBL_MAX, 0, 0 }, { 0, 0, 0 } } };
  clouds.push_back({});
  for (int i = 0; i < 3000; ++i)
  {
    clouds.back().push_back({ DBL_TRUE_MIN * i, -DBL_MIN * i, i % 2 == 0 ? -DBL_MAX : DBL_MAX });
  }
  for (const std::vector<Vec3>& points : clouds)
  {
    const PointIndex index = indexOf(points, ThreadedExecutor(3));
    expectHoldsFinitePoints(index, { points.data(), std::int64_t(points.size()) });
    Lattice lattice;
    lattice.origin = points[0] - Vec3(0.5, 0.5, 0.5);
    expectCovers(index, {}, lattice);
  }
}

TEST(PointIndex, IsEmptyWithoutAFinitePoint)
{
  const std::vector<Vec3> points(10, Vec3(0, NAN, 1));
  PointIndex index = indexOf({ { 1, 1, 1 } });
  for (const std::int64_t n : { 0, 10 })
  {
    EXPECT_EQ(index.build({ points.data(), n }), Status::Empty);
    EXPECT_EQ(index.points().size(), 0);
    EXPECT_EQ(index.invalidPoints(), n);
    EXPECT_TRUE(index.rangesInside({}, {}).empty());
  }
  EXPECT_EQ(PointIndex().points().size(), 0);
  EXPECT_TRUE(PointIndex().rangesInside({}, {}).empty());
}

TEST(PointIndex, DoesNotDependOnTheExecutor)
{
  // Bricks for several pieces of the search too.
  const std::vector<Vec3> points = randomBox(200000, 6, { 0, 0, 0 }, { 1, 1, 1 });
  const ThreadedExecutor threads(3);
  const PointIndex one = indexOf(points);
  const PointIndex other = indexOf(points, threads);
  Random random(7);
  for (int i = 0; i < 20; ++i)
  {
    const AffineTransform transform = randomTransform(random, 1.0);
    const Lattice lattice = latticeAbout(random, transform.apply({ 0.5, 0.5, 0.5 }), 0.5);
    const std::vector<PointRange> a = one.rangesInside(transform, lattice);
    const std::vector<PointRange> b = other.rangesInside(transform, lattice, threads);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t r = 0; r < a.size(); ++r)
    {
      EXPECT_TRUE(a[r].begin == b[r].begin && a[r].end == b[r].end);
    }
  }
}

TEST(PointIndex, CoversEveryPointInsideUnderAnyTransform)
{
  for (const double offset : { 0.0, 4.6e6 })
  {
    const Vec3 low(offset, -offset, offset);
    const std::vector<Vec3> points = randomBox(8000, 8, low, low + Vec3(1, 2, 1));
    const PointIndex index = indexOf(points);
    Random random(9);
    for (int i = 0; i < 120; ++i)
    {
      const double scale = std::pow(10.0, random.uniform(-6, 6));
      const AffineTransform transform = randomTransform(random, scale);
      const Vec3 center = transform.apply(points[random.below(points.size())]);
      const Lattice lattice = latticeAbout(random, center, scale * std::pow(10.0, random.uniform(-3, 1)));
      expectCovers(index, transform, lattice);
    }
  }
}

TEST(PointIndex, CoversPointsOnTheBordersOfTheLattice)
{
  std::vector<Vec3> points;
  for (int i = 0; i < 20 * 20 * 20; ++i)
  {
    points.emplace_back(0.1 * (i % 20), 0.1 * (i / 20 % 20), 0.1 * (i / 400));
  }
  const PointIndex index = indexOf(points);
  for (int i = 1; i < 10; ++i)
  {
    Lattice lattice;
    lattice.origin = 0.1 * Vec3(i, 19 - i, 1);
    lattice.spacing = { 0.1, 0.1, 0.1 };
    lattice.dimensions = { i, i, 1 };
    EXPECT_GE(expectCovers(index, {}, lattice), i * i);
  }
}

TEST(PointIndex, LeavesOutMostOfWhatASmallViewDoesNotShow)
{
  const std::vector<Vec3> points = randomBox(200000, 10, { 0, 0, 0 }, { 1, 1, 1 });
  const PointIndex index = indexOf(points);
  Random random(11);
  for (int i = 0; i < 20; ++i)
  {
    const Vec3 center = random.inBox({ 0.2, 0.2, 0.2 }, { 0.8, 0.8, 0.8 });
    Lattice lattice = latticeOf(10, 10, 10);
    lattice.spacing = Vec3(1, 1, 1) * (std::cbrt(0.01) / 10.0);
    lattice.origin = { -0.5 * std::cbrt(0.01), -0.5 * std::cbrt(0.01), -0.5 * std::cbrt(0.01) };
    const AffineTransform transform =
      AffineTransform::rotation(i * 18.0, random.direction()) * AffineTransform::translation(-center);
    EXPECT_LT(expectCovers(index, transform, lattice), 200000 / 15);
  }
  Lattice away;
  away.origin = { 2, 0, 0 };
  EXPECT_TRUE(index.rangesInside({}, away).empty());
  Lattice all = latticeOf(1, 1, 1);
  ASSERT_EQ(index.rangesInside({}, all).size(), 1u) << "neighbouring bricks join";
}

TEST(PointIndex, TellsHowFarItIsAndCanBeStoppedThere)
{
  // More than are looked at between two events.
  const std::vector<Vec3> points = randomBox(int(kPointsPerReport) + 1000, 8, { 0, 0, 0 }, { 1, 1, 1 });
  const PointView view(points.data(), std::int64_t(points.size()));
  const PointIndex expected = indexOf(points);
  for (const int threads : { 1, 3 })
  {
    SCOPED_TRACE(threads);
    const ThreadedExecutor executor(threads);
    PointIndex index;
    CountingObserver all;
    ASSERT_EQ(index.build(view, executor, &all), Status::Ok);
    expectAscendToOne(all.fractions, 3); // the order, then two slices
    EXPECT_GT(all.fractions.front(), 0.0);
    EXPECT_EQ(index.rangesInside({}, {}).size(), expected.rangesInside({}, {}).size());
    expectHoldsFinitePoints(index, view);
    for (std::size_t last = 1; last <= all.fractions.size(); ++last)
    {
      CountingObserver stopping(last);
      ASSERT_EQ(index.build(view, executor, &stopping), Status::Aborted) << last;
      EXPECT_EQ(stopping.fractions.size(), last);
      EXPECT_EQ(index.points().size(), 0);
      EXPECT_TRUE(index.rangesInside({}, {}).empty());
    }
  }
}
