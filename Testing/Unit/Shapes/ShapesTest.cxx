#include "Shapes/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace
{

using namespace pointhaptics;

class EachShape : public testing::TestWithParam<int>
{
protected:
  Shape shape() const { return static_cast<Shape>(this->GetParam()); }
};

std::uint64_t hashOf(const std::vector<Vec3>& points)
{
  std::uint64_t hash = 0xcbf29ce484222325u; // FNV-1a over the bits
  for (const Vec3& p : points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      std::uint64_t bits = 0;
      const double value = p[axis];
      std::memcpy(&bits, &value, sizeof bits);
      for (int byte = 0; byte < 8; ++byte)
      {
        hash = (hash ^ ((bits >> (8 * byte)) & 0xff)) * 0x100000001b3u;
      }
    }
  }
  return hash;
}

std::vector<Vec3> pointsOf(Shape shape, std::int64_t count, std::uint64_t seed, double noise = 0.0)
{
  std::vector<Vec3> points;
  EXPECT_EQ(generateShape(shape, count, seed, noise, points), Status::Ok);
  return points;
}

TEST_P(EachShape, HasANameThatLeadsBack)
{
  Shape found = Shape::Plane;
  ASSERT_TRUE(shapeFromName(shapeName(this->shape()), found));
  EXPECT_EQ(found, this->shape());
}

TEST_P(EachShape, PutsItsPointsOnItsSurface)
{
  std::vector<Vec3> points, normals;
  ASSERT_EQ(generateShape(this->shape(), 3000, 7, 0.0, points, &normals), Status::Ok);
  ASSERT_EQ(normals.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const SurfacePoint foot = closestPoint(this->shape(), points[i]);
    ASSERT_NEAR(foot.distance, 0.0, 1e-15) << i;
    ASSERT_NEAR(norm(normals[i]), 1.0, 1e-15);
    ASSERT_NEAR(norm(foot.normal - normals[i]), 0.0, 1e-12) << i;
    ASSERT_LE(std::max({ std::abs(points[i].x), std::abs(points[i].y), std::abs(points[i].z) }), 0.05);
  }
}

TEST_P(EachShape, FindsItsWayBackFromASmallOffsetAlongTheNormal)
{
  std::vector<Vec3> points, normals;
  ASSERT_EQ(generateShape(this->shape(), 500, 8, 0.0, points, &normals), Status::Ok);
  double worst = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (const double offset : { -1e-4, 1e-4 })
    {
      const SurfacePoint foot = closestPoint(this->shape(), points[i] + offset * normals[i]);
      if (norm(foot.point - points[i]) < 1e-6) // elsewhere another face or the far side is nearer
      {
        worst = std::max(worst, norm(foot.point - points[i]));
        EXPECT_NEAR(foot.distance, offset, 1e-15);
      }
      else
      {
        EXPECT_LT(std::abs(foot.distance), 1e-4);
        EXPECT_TRUE(
          this->shape() == Shape::Box || this->shape() == Shape::Edge || this->shape() == Shape::Idol)
          << i;
      }
    }
  }
  EXPECT_LE(worst, 1e-14);
}

TEST_P(EachShape, ClosestPointIsNoFurtherThanAnySample)
{
  const std::vector<Vec3> samples = pointsOf(this->shape(), 20000, 9);
  const bool idol = this->shape() == Shape::Idol;
  std::mt19937 random(10);
  std::uniform_real_distribution<double> inCube(-0.05, 0.05), nearby(-0.003, 0.003);
  for (int trial = 0; trial < 300; ++trial)
  {
    Vec3 p{ inCube(random), inCube(random), inCube(random) };
    if (idol)
    {
      p = samples[static_cast<std::size_t>(trial)] + Vec3{ nearby(random), nearby(random), nearby(random) };
    }
    const SurfacePoint foot = closestPoint(this->shape(), p);
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const Vec3& sample : samples)
    {
      nearest2 = std::min(nearest2, norm2(sample - p));
    }
    ASSERT_LE(std::abs(foot.distance), std::sqrt(nearest2) + 1e-16) << trial;
    ASSERT_NEAR(norm(foot.point - p), std::abs(foot.distance), 1e-15);
    ASSERT_NEAR(norm(foot.normal), 1.0, 1e-14);
    // The samples' spacing bounds how much nearer the true foot can be.
    ASSERT_GE(std::abs(foot.distance), std::sqrt(nearest2) - 0.003) << trial;
    // The foot is a point of the surface.
    ASSERT_NEAR(closestPoint(this->shape(), foot.point).distance, 0.0, 2e-15) << trial;
  }
}

TEST_P(EachShape, IsTheSameForTheSameSeedAndOnEveryMachine)
{
  static const std::uint64_t known[kNumberOfShapes] = { 0xe293c8ea0d457e2du, 0x9ba4330520dfaa9cu,
    0xd75cc164fb13b42fu, 0xc4fde0e61a70e55u, 0x4031b326c6f91f76u, 0xf52240169cd31e35u, 0x542e6cda3828a449u,
    0x7fb6dae433b725d3u, 0x7915466c911f14ceu, 0xe20df6ad94a0c378u, 0x7661994775b42c26u };
  const std::vector<Vec3> points = pointsOf(this->shape(), 1000, 42, 1e-5);
  EXPECT_EQ(hashOf(points), known[this->GetParam()]) << "0x" << std::hex << hashOf(points);
  EXPECT_EQ(pointsOf(this->shape(), 1000, 42, 1e-5), points);
  EXPECT_NE(pointsOf(this->shape(), 1000, 43, 1e-5), points);
  // A longer cloud begins with the shorter one.
  std::vector<Vec3> longer = pointsOf(this->shape(), 1500, 42, 1e-5);
  longer.resize(1000);
  EXPECT_EQ(longer, points);
}

TEST_P(EachShape, NoiseHasTheSpreadAskedFor)
{
  std::vector<Vec3> points, normals;
  const double sigma = 2e-6;
  ASSERT_EQ(generateShape(this->shape(), 4000, 3, sigma, points, &normals), Status::Ok);
  double sum = 0.0, sum2 = 0.0;
  for (const Vec3& p : points)
  {
    const double distance = closestPoint(this->shape(), p).distance;
    sum += distance;
    sum2 += distance * distance;
  }
  EXPECT_NEAR(sum / 4000, 0.0, 4.0 * sigma / std::sqrt(4000.0));
  EXPECT_NEAR(std::sqrt(sum2 / 4000), sigma, 0.05 * sigma);
}

TEST_P(EachShape, TakesEmptyAndRefusesNonsense)
{
  EXPECT_TRUE(pointsOf(this->shape(), 0, 1).empty());
  EXPECT_EQ(pointsOf(this->shape(), 1, 1).size(), 1u);
  std::vector<Vec3> points(5);
  EXPECT_EQ(generateShape(this->shape(), -1, 1, 0.0, points), Status::InvalidParameter);
  EXPECT_TRUE(points.empty());
  EXPECT_EQ(generateShape(this->shape(), 1, 1, -1e-6, points), Status::InvalidParameter);
  EXPECT_EQ(generateShape(this->shape(), 1, 1, std::nan(""), points), Status::InvalidParameter);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EachShape, testing::Range(0, kNumberOfShapes),
  [](const testing::TestParamInfo<int>& parameter)
  {
    std::string name = shapeName(static_cast<Shape>(parameter.param));
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
  });

TEST(Shapes, RefuseAnUnknownName)
{
  Shape shape = Shape::Torus;
  EXPECT_FALSE(shapeFromName("cube", shape));
  EXPECT_EQ(shape, Shape::Torus);
}

TEST(Shapes, AnswersKnownByHand)
{
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Sphere, { 0.0, 0.0, 0.030 }).distance, 0.005);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Sphere, {}).distance, -0.025);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Torus, {}).distance, 0.015);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Torus, { 0.0, -0.025, 0.0 }).distance, -0.010);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Ellipsoid, {}).distance, -0.018);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Ellipsoid, { 0.05, 0.0, 0.0 }).distance, 0.010);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Ellipsoid, { 0.0, -0.03, 0.0 }).distance, 0.005);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Saddle, { 0.0, 0.0, 0.002 }).distance, 0.002);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Saddle, { 0.0, 0.0, -0.002 }).distance, -0.002);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Box, { 0.028, 0.029, 0.0 }).distance, 0.005);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Box, { 0.020, 0.001, 0.0 }).distance, -0.005);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Edge, { 0.003, 0.0, 0.004 }).distance, 0.005);
  EXPECT_EQ(closestPoint(Shape::Edge, { -0.001, 0.0, -0.002 }).normal, Vec3(1.0, 0.0, 0.0));
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Sheet, { 0.0, 0.0, 0.0 }).distance, -0.0004);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Sheet, { 0.0, 0.0, -0.0014 }).distance, 0.001);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Hole, {}).distance, 0.010);
  EXPECT_DOUBLE_EQ(closestPoint(Shape::Plane, { 0.01, 0.02, -0.003 }).distance, -0.003);
}

TEST(Shapes, DensityStepHasSixteenTimesThePointsOnOneSide)
{
  double dense = 0.0;
  const int count = 170000;
  for (const Vec3& p : pointsOf(Shape::DensityStep, count, 5))
  {
    dense += p.x > 0.0;
  }
  EXPECT_NEAR(dense / (count - dense), 16.0, 0.5);
}

TEST(Shapes, TheSphereIsSampledUniformly)
{
  // Archimedes: z is uniform. Expected 1000 in each of 20 slices; six standard deviations.
  std::vector<int> slices(20);
  for (const Vec3& p : pointsOf(Shape::Sphere, 20000, 6))
  {
    ++slices[std::min<std::size_t>(19, static_cast<std::size_t>((p.z / 0.05 + 0.5) * 20))];
  }
  for (const int slice : slices)
  {
    EXPECT_NEAR(slice, 1000, 190);
  }
}

TEST(Shapes, TheIdolIsDenseAtTheFaceAndSparseBehindTheFoot)
{
  // Points in a small ball on the surface count the density, the surface being nearly flat there.
  const std::vector<Vec3> points = pointsOf(Shape::Idol, 150000, 5);
  const auto countNear = [&points](const Vec3& where)
  {
    const Vec3 center = closestPoint(Shape::Idol, where).point;
    return std::count_if(
      points.begin(), points.end(), [&](const Vec3& p) { return norm(p - center) < 0.002; });
  };
  const auto face = countNear({ 0.006, -0.016, 0.026 });
  const auto back = countNear({ 0.0, 0.024, -0.034 });
  EXPECT_GT(double(face), 9.0 * double(back));
  EXPECT_LT(double(face), 25.0 * double(back));
}

TEST(Shapes, TheIdolIsAboutNineCentimetresTall)
{
  double low = 0.0, high = 0.0;
  for (const Vec3& p : pointsOf(Shape::Idol, 20000, 5))
  {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  EXPECT_NEAR(high - low, 0.09, 0.001);
}

} // namespace
