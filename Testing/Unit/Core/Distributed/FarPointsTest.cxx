// Points far from all others, whatever the ranks.
#include "Core/Distributed/FarPoints.h"

#include "RandomClouds.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

Bounds boundsOf(const std::vector<Vec3>& points)
{
  Bounds box;
  for (const Vec3& p : points)
  {
    if (isFinite(p))
    {
      box.include(p);
    }
  }
  return box;
}

FarPoints farOf(const std::vector<Vec3>& points)
{
  return findFarPoints(view(points), boundsOf(points));
}

/// On a unit sphere about @p center.
std::vector<Vec3> sphere(std::size_t n, const Vec3& center = {})
{
  std::vector<Vec3> points = randomBox(n, 7, { -1, -1, -1 }, { 1, 1, 1 });
  for (Vec3& p : points)
  {
    p = center + (1.0 / norm(p)) * p;
  }
  return points;
}

Vec3 around(Random& random, double width)
{
  return width * Vec3(random.normal(), random.normal(), random.normal());
}

} // namespace

TEST(FarPoints, AreUpToOneInTwentyAnywhere)
{
  for (const std::size_t n : { 1000, 50000 })
  {
    for (const double share : { 0.002, 0.01, 0.03, 0.05 })
    {
      for (const double width : { 6.0, 30.0, 200.0 })
      {
        std::vector<Vec3> points = sphere(n);
        Random random(5);
        const auto strays = std::size_t(double(n) * share);
        points.push_back({ 0.0, 0.0, 4.0 * width });
        for (std::size_t i = 1; i < strays; ++i)
        {
          points.push_back(around(random, width));
        }
        const FarPoints far = farOf(points);
        const std::string what =
          std::to_string(n) + " " + std::to_string(share) + " " + std::to_string(width);
        EXPECT_GT(double(far.count), 0.9 * double(strays)) << what;
        EXPECT_LE(far.count, std::int64_t(strays)) << what;
        for (int axis = 0; axis < 3; ++axis)
        {
          EXPECT_GT(far.others.extent()[axis], 1.99) << what;
          EXPECT_LT(far.others.extent()[axis], width < 10.0 ? 4.0 : 2.6) << what;
        }
      }
    }
  }
}

TEST(FarPoints, AreFoundAtAnyDistance)
{
  for (const double distance : { 30.0, 1e3, 1e9, 1e100 })
  {
    std::vector<Vec3> points = sphere(2000, { 5e5, 4e6, 100.0 });
    points.push_back({ distance + 5e5, -distance, 0.0 });
    const FarPoints far = farOf(points);
    EXPECT_EQ(far.count, 1) << distance;
    EXPECT_LT(far.others.extent().x, 2.01) << distance;
    EXPECT_EQ(far.text(), "1 of 2,001 points is far from all others");
  }
}

TEST(FarPoints, OfNoDataAreFarWhateverTheirNumber)
{
  for (const double none : { -9999.0, -32767.0, 9999.0, 1e30, -1e10 })
  {
    std::vector<Vec3> points = sphere(2000, { 5e5, 4e6, 100.0 });
    for (std::size_t i = 0; i < points.size(); i += 4)
    {
      points[i] = i % 8 == 0 ? Vec3() : Vec3(points[i].x, points[i].y, none);
    }
    EXPECT_EQ(farOf(points).count, 500) << none;
  }
  std::vector<Vec3> plates = randomBox(1000, 7, {}, { 1, 1, 0 });
  for (std::size_t i = 0; i < plates.size(); i += 3)
  {
    plates[i].z = 100.0;
  }
  EXPECT_EQ(farOf(plates).count, 0) << "each has exactly one height";
  std::vector<Vec3> hall = randomBox(20000, 7, {}, { 10, 10, 0.02 });
  for (std::size_t i = 0; i < hall.size(); i += 3)
  {
    hall[i].z = 3.0;
  }
  hall.push_back({ 665, 5, 1 });
  EXPECT_EQ(farOf(hall).count, 1) << "a ceiling is far from a thin floor, and no farther than it is wide";
}

TEST(FarPoints, AreNoneWhereTheCloudGoesOnOrFallsApart)
{
  Random random(9);
  // A scan: ever sparser with the distance, 95 % in the inner tenth.
  std::vector<Vec3> scan;
  for (int i = 0; i < 100000; ++i)
  {
    const double r = std::pow(10.0, random.uniform(0.0, 2.3));
    const double angle = random.uniform(0.0, 6.283);
    scan.push_back({ r * std::cos(angle), r * std::sin(angle), random.uniform(0.0, 1.0) });
  }
  EXPECT_EQ(farOf(scan).count, 0);
  // An object on thin ground.
  std::vector<Vec3> onGround = sphere(50000);
  for (int i = 0; i < 2500; ++i)
  {
    onGround.push_back({ random.uniform(-10.5, 10.5), random.uniform(-10.5, 10.5), -1.0 });
  }
  EXPECT_EQ(farOf(onGround).count, 0);
  // Two objects.
  std::vector<Vec3> two = sphere(1000);
  const std::vector<Vec3> other = sphere(1000, { 100.0, 0.0, 0.0 });
  two.insert(two.end(), other.begin(), other.end());
  EXPECT_EQ(farOf(two).count, 0);
  two.push_back({ 0.0, 1e6, 0.0 });
  EXPECT_EQ(farOf(two).count, 1);
  EXPECT_EQ(farOf(sphere(50)).count, 0);
  EXPECT_EQ(farOf(std::vector<Vec3>(500, Vec3(1, 2, 3))).count, 0);
  EXPECT_EQ(farOf({}).count, 0);
  EXPECT_EQ(farOf(std::vector<Vec3>(500, Vec3(NAN, 2, 3))).count, 0);
}

TEST(FarPoints, AreTheSameOnAnyNumberOfRanks)
{
  std::vector<Vec3> points = sphere(20000);
  Random random(5);
  for (int i = 0; i < 700; ++i)
  {
    points.insert(points.begin() + std::ptrdiff_t(random.below(points.size())), around(random, 60.0));
  }
  const FarPoints expected = farOf(points);
  EXPECT_GT(expected.count, 690);
  for (const int size : { 2, 3, 5 })
  {
    ThreadJob job(size);
    job.run(
      [&](Ranks& ranks)
      {
        const std::size_t first = points.size() * std::size_t(ranks.rank()) / std::size_t(size);
        const std::size_t last = points.size() * std::size_t(ranks.rank() + 1) / std::size_t(size);
        const std::vector<Vec3> own(
          points.begin() + std::ptrdiff_t(first), points.begin() + std::ptrdiff_t(last));
        const FarPoints found = findFarPoints({ view(own) }, boundsOf(own), ranks);
        EXPECT_EQ(found.note(), expected.note());
        EXPECT_EQ(found.others, expected.others);
      });
  }
}
