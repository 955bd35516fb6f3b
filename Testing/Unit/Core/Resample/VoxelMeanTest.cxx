#include "Core/Reference/ReferenceVoxelMean.h"

#include "RandomClouds.h"

#include "Unit/VoxelMeans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

using namespace pointhaptics;
using trial::view;

namespace
{

Lattice unitLattice(std::int64_t n)
{
  Lattice lattice;
  lattice.spacing = { 1.0 / n, 1.0 / n, 1.0 / n };
  lattice.dimensions = { n, n, n };
  return lattice;
}

VoxelMeans meansOf(const PointView& points, const Lattice& lattice, const AffineTransform& transform = {},
  const Executor& executor = {})
{
  VoxelMeans result;
  EXPECT_EQ(voxelMeans(points, transform, lattice, true, result, executor), Status::Ok);
  return result;
}

/// Largest rounding of one coordinate on its way: of the products of the transform, or of the coordinate
/// itself.
double coordinateRounding(const PointView& points, const AffineTransform& transform)
{
  double largest = 0.0;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    if (!isFinite(points[i]))
    {
      continue;
    }
    for (const auto& row : transform.m)
    {
      const Vec3 p = points[i];
      const double sum = std::fabs(row[0] * p.x) + std::fabs(row[1] * p.y) + std::fabs(row[2] * p.z);
      largest = std::max(largest, sum + std::fabs(row[3]));
    }
  }
  return 4.0 * DBL_EPSILON * largest;
}

/// The promise of the header: same voxels and counts as the definition, means to 2^-31 voxel and the
/// rounding of a coordinate, covariances to the same in squared voxels.
void expectAgrees(const PointView& points, const AffineTransform& transform, const Lattice& lattice)
{
  const VoxelMeans result = meansOf(points, lattice, transform);
  const reference::VoxelMap expected = reference::voxelMeans(points, transform, lattice);
  EXPECT_EQ(result.clippedPoints, expected.clippedPoints);
  EXPECT_EQ(result.invalidPoints, expected.invalidPoints);
  ASSERT_EQ(result.keys.size(), expected.voxels.size());
  ASSERT_EQ(result.means.size(), result.keys.size());
  ASSERT_EQ(result.covariances.size(), result.keys.size());
  ASSERT_EQ(result.counts.size(), result.keys.size());
  const double rounding = coordinateRounding(points, transform);
  std::size_t v = 0;
  for (const auto& entry : expected.voxels)
  {
    const reference::Voxel& voxel = entry.second;
    ASSERT_EQ(result.keys[v], entry.first);
    ASSERT_EQ(result.counts[v], std::int64_t(voxel.members.size()));
    for (int axis = 0; axis < 3; ++axis)
    {
      const double error = double(std::fabs(voxel.mean[axis] - result.means[v][axis]));
      ASSERT_LE(error, 0x1p-31 * lattice.spacing[axis] + rounding) << "voxel " << v << " axis " << axis;
    }
    const SymMat3& c = result.covariances[v];
    const double got[6] = { c.xx, c.yy, c.zz, c.xy, c.yz, c.xz };
    const int axes[6][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 1, 2 }, { 0, 2 } };
    for (int m = 0; m < 6; ++m)
    {
      const double a = lattice.spacing[axes[m][0]];
      const double b = lattice.spacing[axes[m][1]];
      const double error = double(std::fabs(voxel.covariance[m] - got[m]));
      ASSERT_LE(error, 0x1p-30 * a * b + rounding * (a + b)) << "voxel " << v << " moment " << m;
    }
    ++v;
  }
}

AffineTransform generalTransform()
{
  return AffineTransform::translation({ 0.3, 0.2, 0.25 }) * AffineTransform::rotation(33, { 1, 2, -1 }) *
    AffineTransform::scaling({ 0.5, -0.7, 0.6 });
}

} // namespace

TEST(VoxelMean, AgreesWithTheDefinitionOnRandomPoints)
{
  const std::vector<Vec3> points = trial::randomBox(50000, 1, { -0.1, -0.1, -0.1 }, { 1.1, 1.1, 1.1 });
  Lattice unequal;
  unequal.origin = { 0.1, 0, -0.1 };
  unequal.spacing = { 0.25, 5e-4, 2 };
  unequal.dimensions = { 5, 2001, 1 };
  for (const Lattice& lattice : { unitLattice(7), unitLattice(32), unitLattice(1), unequal })
  {
    expectAgrees(view(points), {}, lattice);
    expectAgrees(view(points), generalTransform(), lattice);
  }
}

/// Shears of condition numbers up to 10^6, whose products a double cannot hold: the promise stands without
/// room for their rounding. The points are the way back from places in the lattice.
TEST(VoxelMean, AgreesUnderTransformsOfEveryConditionNumber)
{
  trial::Random random(3);
  const Lattice lattice = unitLattice(300);
  for (int i = 0; i < 60; ++i)
  {
    AffineTransform shear;
    shear.m[0][1] = std::pow(10.0, random.uniform(0, 3));
    const AffineTransform transform = AffineTransform::rotation(random.uniform(0, 360), random.direction()) *
      shear * AffineTransform::rotation(random.uniform(0, 360), random.direction());
    std::vector<Vec3> points;
    for (int j = 0; j < 200; ++j)
    {
      points.push_back(transform.inverse().apply(random.inBox({ 0.1, 0.1, 0.1 }, { 0.9, 0.9, 0.9 })));
    }
    const VoxelMeans result = meansOf(view(points), lattice, transform);
    const reference::VoxelMap expected = reference::voxelMeans(view(points), transform, lattice);
    ASSERT_EQ(result.keys.size(), expected.voxels.size());
    std::size_t v = 0;
    for (const auto& [key, voxel] : expected.voxels)
    {
      ASSERT_EQ(result.keys[v], key);
      for (int axis = 0; axis < 3; ++axis)
      {
        const double error = double(std::fabs(voxel.mean[axis] - result.means[v][axis]));
        ASSERT_LE(error, 0x1.1p-31 * lattice.spacing[axis]) << "shear " << shear.m[0][1];
      }
      ++v;
    }
  }
}

TEST(VoxelMean, AgreesOnSheetsWhoseCovarianceIsNearlySingular)
{
  trial::Random random(4);
  std::vector<Vec3> points;
  for (int i = 0; i < 20000; ++i)
  {
    const double x = random.uniform();
    const double y = random.uniform();
    points.emplace_back(x, y, 0.5 + 0.01 * x * x - 1e-7 * random.uniform());
  }
  expectAgrees(view(points), {}, unitLattice(10));
}

TEST(VoxelMean, AgreesAtEveryScale)
{
  for (const double scale : { 1e-12, 1e-6, 1e6, 1e12 })
  {
    const std::vector<Vec3> points =
      trial::randomBox(5000, 5, scale * Vec3(-1, -1, -1), scale * Vec3(1, 1, 1));
    Lattice lattice;
    ASSERT_EQ(makeLattice({}, transformedBounds(view(points), {}), lattice), Status::Ok);
    expectAgrees(view(points), {}, lattice);
  }
}

TEST(VoxelMean, AgreesOnMapCoordinatesInDouble)
{
  const std::vector<Vec3> points =
    trial::randomBox(20000, 6, { 512700, 4600000, 300 }, { 512701, 4600001, 301 });
  Lattice lattice;
  lattice.origin = { 512700, 4600000, 300 };
  lattice.spacing = { 0.1, 0.1, 0.1 };
  lattice.dimensions = { 10, 10, 10 };
  expectAgrees(view(points), {}, lattice);
}

TEST(VoxelMean, AgreesOnMapCoordinatesInFloat)
{
  trial::Random random(7);
  std::vector<float> points;
  for (int i = 0; i < 3 * 20000; ++i)
  {
    points.push_back(float((i % 3 == 0      ? 512700.0
                               : i % 3 == 1 ? 4600000.0
                                            : 300.0) +
      random.uniform(0, 100)));
  }
  const PointView floats(points.data(), 20000);
  Lattice lattice;
  ASSERT_EQ(makeLattice({}, transformedBounds(floats, {}), lattice), Status::Ok);
  expectAgrees(floats, {}, lattice);
}

TEST(VoxelMean, AMillionMapPointsInOneVoxelKeepTheirMean)
{
  // Sums of float coordinates are wrong by kilometres here, sums of doubles by 2.5e-7 m.
  const std::vector<Vec3> points =
    trial::randomBox(1000000, 8, { 512700, 4600000, 300 }, { 512700.1, 4600000.1, 300.1 });
  Lattice lattice;
  lattice.origin = { 512700, 4600000, 300 };
  lattice.spacing = { 0.125, 0.125, 0.125 };
  const VoxelMeans result = meansOf(view(points), lattice);
  ASSERT_EQ(result.keys.size(), 1u);
  EXPECT_EQ(result.counts[0], 1000000);
  long double sum[3] = { 0, 0, 0 };
  for (const Vec3& p : points)
  {
    sum[0] += p.x - 512700.0L;
    sum[1] += p.y - 4600000.0L;
    sum[2] += p.z - 300.0L;
  }
  EXPECT_NEAR(double(result.means[0].x - 512700.0L), double(sum[0] / 1e6L), 1.2e-10);
  EXPECT_NEAR(double(result.means[0].y - 4600000.0L), double(sum[1] / 1e6L), 1e-9);
  EXPECT_NEAR(double(result.means[0].z - 300.0L), double(sum[2] / 1e6L), 1e-10);
}

TEST(VoxelMean, FloorsNegativeCoordinates)
{
  Lattice lattice;
  lattice.origin = { -2, -2, -2 };
  lattice.dimensions = { 4, 4, 4 };
  const std::vector<Vec3> points{ { -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 }, { -1.5, -0.5, -0.5 } };
  const VoxelMeans result = meansOf(view(points), lattice);
  EXPECT_EQ(result.keys,
    (std::vector<std::uint64_t>{ lattice.key(0, 1, 1), lattice.key(1, 1, 1), lattice.key(2, 2, 2) }));
}

TEST(VoxelMean, PointsOnAFaceBelongToTheVoxelAbove)
{
  std::vector<Vec3> points;
  for (int i = 0; i <= 8; ++i)
  {
    for (int j = 0; j <= 8; ++j)
    {
      points.emplace_back(i / 8.0, j / 8.0, 0.25);
    }
  }
  const VoxelMeans result = meansOf(view(points), unitLattice(8));
  ASSERT_EQ(result.keys.size(), 64u);
  EXPECT_EQ(result.clippedPoints, 17);
  for (std::size_t v = 0; v < 64; ++v)
  {
    EXPECT_EQ(result.counts[v], 1);
    const Vec3 expected(double(v % 8) / 8.0, double(v / 8) / 8.0, 0.25);
    EXPECT_EQ(result.means[v], expected);
  }
}

TEST(VoxelMean, PointsAtOnePlaceKeepItToTheQuantumAndHaveNoSpread)
{
  for (const std::size_t n : { 1, 1000 })
  {
    const std::vector<Vec3> points(n, Vec3(0.1234567, 0.7654321, 0.5));
    const VoxelMeans result = meansOf(view(points), unitLattice(300));
    ASSERT_EQ(result.means.size(), 1u);
    EXPECT_EQ(result.counts[0], std::int64_t(n));
    EXPECT_LE(norm(result.means[0] - points[0]), 2 * 0x1p-33 / 300 + 1e-16);
    const SymMat3& c = result.covariances[0];
    EXPECT_TRUE(c.trace() == 0.0 && c.xy == 0.0 && c.yz == 0.0 && c.xz == 0.0);
  }
}

TEST(VoxelMean, SmallCloudsAgree)
{
  for (const std::size_t n : { 0, 1, 2, 11 })
  {
    const std::vector<Vec3> points = trial::randomBox(n, 14, { 0, 0, 0 }, { 1, 1, 1 });
    expectAgrees(view(points), {}, unitLattice(3));
  }
  const VoxelMeans none = meansOf({}, unitLattice(3));
  EXPECT_TRUE(none.keys.empty());
  EXPECT_TRUE(none.counts.empty());
}

TEST(VoxelMean, CountsWhatIsNotFinite)
{
  std::vector<Vec3> points = trial::randomBox(100, 15, { 0, 0, 0 }, { 1, 1, 1 });
  points[3].x = NAN;
  points[50].y = INFINITY;
  points[99].z = -INFINITY;
  points[7] = { 2, 2, 2 };
  const VoxelMeans result = meansOf(view(points), unitLattice(3));
  EXPECT_EQ(result.invalidPoints, 3);
  EXPECT_EQ(result.clippedPoints, 1);
  EXPECT_EQ(std::accumulate(result.counts.begin(), result.counts.end(), std::int64_t(0)), 96);
  expectAgrees(view(points), {}, unitLattice(3));
}

TEST(VoxelMean, HugeAndTinyNumbersAreClippedOrKept)
{
  const std::vector<Vec3> points{ { DBL_MAX, 0, 0 }, { -DBL_MAX, 0, 0 }, { DBL_TRUE_MIN, 0, 0 },
    { -DBL_TRUE_MIN, 0, 0 }, { -0.0, -0.0, -0.0 } };
  const VoxelMeans result = meansOf(view(points), unitLattice(4));
  EXPECT_EQ(result.invalidPoints, 0);
  EXPECT_EQ(
    result.clippedPoints + std::accumulate(result.counts.begin(), result.counts.end(), std::int64_t(0)), 5);
  ASSERT_EQ(result.keys.size(), 1u);
  EXPECT_LE(norm(result.means[0]), 0x1p-32);
}

TEST(VoxelMean, KeepsAMeanBelowTheUpperFaceOfItsVoxel)
{
  const Vec3 point{ std::nextafter(1.0, 0.0), 0.5, std::nextafter(0.5, 0.0) };
  Lattice lattice;
  lattice.spacing = { 0.5, 0.5, 0.5 };
  lattice.dimensions = { 2, 2, 2 };
  VoxelMeans once;
  ASSERT_EQ(voxelMeans(PointView(&point, 1), {}, lattice, false, once), Status::Ok);
  ASSERT_EQ(once.means.size(), 1u);
  VoxelMeans twice;
  ASSERT_EQ(voxelMeans(PointView(once.means.data(), 1), {}, lattice, false, twice), Status::Ok);
  EXPECT_EQ(twice.clippedPoints, 0);
  EXPECT_EQ(twice.keys, once.keys);
}

TEST(VoxelMean, ClipsAtTheWorkspaceWhereItCutsThroughAVoxel)
{
  LatticeSettings settings;
  settings.voxelSize = 0.3;
  settings.automaticWorkspace = false;
  settings.workspace.include({ 0, 0, 0 });
  settings.workspace.include({ 1, 1, 1 });
  Lattice lattice;
  ASSERT_EQ(makeLattice(settings, {}, lattice), Status::Ok);
  const Vec3 points[] = { { 1.1, 0.5, 0.5 }, { 1.0, 0.5, 0.5 }, { 0.95, 0.5, 0.5 } };
  VoxelMeans means;
  ASSERT_EQ(voxelMeans(PointView(points, 3), {}, lattice, false, means), Status::Ok);
  EXPECT_EQ(means.clippedPoints, 2);
  EXPECT_EQ(means.means.size(), 1u);
}

TEST(VoxelMean, FillsTheLargestLattice)
{
  Lattice lattice = unitLattice(kMaximumLatticeDimension);
  const std::vector<Vec3> points{ { 0, 0, 0 }, { 1 - 1e-9, 1 - 1e-9, 1 - 1e-9 }, { 0.5, 0.25, 0.125 } };
  expectAgrees(view(points), {}, lattice);
}

TEST(TransformedBounds, AreThoseOfTheFinitePoints)
{
  std::vector<Vec3> points = trial::randomBox(5000, 20, { -1, 2, 3 }, { 1, 4, 9 });
  points[17] = { NAN, 100, 100 };
  points[18] = { 100, INFINITY, 100 };
  const AffineTransform t = generalTransform();
  Bounds expected;
  for (const Vec3& p : points)
  {
    if (isFinite(p))
    {
      expected.include(t.apply(p));
    }
  }
  for (const int threads : { 1, 3 })
  {
    const Bounds box = transformedBounds(view(points), t, trial::ThreadedExecutor(threads));
    EXPECT_EQ(box.minimum, expected.minimum);
    EXPECT_EQ(box.maximum, expected.maximum);
  }
  EXPECT_TRUE(transformedBounds({}, {}).empty());
}

TEST(TransformedBounds, LeaveOutPointsThatOverflowInTheTransform)
{
  const std::vector<Vec3> points{ { 1, 1, 1 }, { 1e300, 0, 0 } };
  const Bounds box = transformedBounds(view(points), AffineTransform::scaling({ 1e20, 1, 1 }));
  EXPECT_EQ(box.maximum, Vec3(1e20, 1, 1));
}
