#include "Benchmark/Resample/Expected.h"

#include "Core/Reference/ReferenceVoxelMean.h"
#include "Shapes/PortableRandom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;
using namespace pointhaptics::bench::resample;

namespace
{

std::vector<float> randomPoints(std::int64_t count)
{
  detail::PortableRandom random(7);
  std::vector<float> xyz;
  for (std::int64_t i = 0; i < 3 * count; ++i)
  {
    xyz.push_back(float(random.uniform(-0.1, 1.1)));
  }
  return xyz;
}

Lattice unitLattice(std::int64_t dimension)
{
  Lattice lattice;
  const double spacing = 1.0 / double(dimension);
  lattice.spacing = { spacing, spacing, spacing };
  lattice.dimensions = { dimension, dimension, dimension };
  return lattice;
}

/// The right answer, rounded to float as a filter would.
ResampleAnswer rightAnswer(const ExpectedMeans& expected, const Lattice& lattice)
{
  ResampleAnswer answer;
  answer.lattice = lattice;
  answer.counts = expected.counts;
  for (const auto& mean : expected.means)
  {
    for (const long double x : mean)
    {
      answer.xyz.push_back(double(float(x)));
    }
  }
  return answer;
}

constexpr std::int64_t kVoxels = 20;

/// Says whether the right answer for some points is right once a function has spoiled it.
auto spoiledAnswers(ComparedWith with)
{
  const std::vector<float> xyz = randomPoints(3000);
  const Lattice lattice = unitLattice(kVoxels);
  return [=, expected = expectedMeans({ xyz.data(), 3000 }, lattice)](const auto& spoil)
  {
    ResampleAnswer answer = rightAnswer(expected, lattice);
    spoil(answer);
    return judge(answer, expected, with).right;
  };
}

} // namespace

TEST(Expected, AgreesWithTheReference)
{
  const std::vector<float> xyz = randomPoints(5000);
  const PointView points(xyz.data(), 5000);
  const Lattice lattice = unitLattice(9);
  const ExpectedMeans expected = expectedMeans(points, lattice);
  const reference::VoxelMap map = reference::voxelMeans(points, {}, lattice);
  ASSERT_EQ(expected.keys.size(), map.voxels.size());
  std::size_t v = 0;
  for (const auto& entry : map.voxels)
  {
    EXPECT_EQ(expected.keys[v], entry.first);
    EXPECT_EQ(expected.counts[v], std::int64_t(entry.second.members.size()));
    for (int axis = 0; axis < 3; ++axis)
    {
      const long double difference = expected.means[v][std::size_t(axis)] - entry.second.mean[axis];
      EXPECT_LT(std::fabs(difference), 1e-17L);
    }
    ++v;
  }
}

TEST(Expected, TheRightAnswerIsRight)
{
  const std::vector<float> xyz = randomPoints(3000);
  const Lattice lattice = unitLattice(20);
  const ExpectedMeans expected = expectedMeans({ xyz.data(), 3000 }, lattice);
  for (const auto with : { ComparedWith::ExactMeans, ComparedWith::Means, ComparedWith::TheirVoxels })
  {
    const Verdict verdict = judge(rightAnswer(expected, lattice), expected, with);
    EXPECT_TRUE(verdict.right) << verdict.text;
    EXPECT_EQ(verdict.text, "right");
    EXPECT_EQ(verdict.voxels, std::int64_t(expected.keys.size()));
  }
}

TEST(Expected, OneWrongVoxelIsFoundOut)
{
  const auto isRight = spoiledAnswers(ComparedWith::ExactMeans);
  EXPECT_FALSE(isRight([](ResampleAnswer& a) { ++a.counts[17]; }));
  EXPECT_FALSE(isRight([](ResampleAnswer& a) { a.xyz[40] += 1e-6; }));
  EXPECT_FALSE(isRight([](ResampleAnswer& a) { a.xyz[40] = NAN; }));
  EXPECT_FALSE(isRight([](ResampleAnswer& a) { a.fault = "no result"; }));
  EXPECT_FALSE(isRight(
    [](ResampleAnswer& a)
    {
      a.xyz.resize(a.xyz.size() - 3);
      a.counts.pop_back();
    }));
  EXPECT_FALSE(isRight([](ResampleAnswer& a) { std::swap_ranges(&a.xyz[0], &a.xyz[3], &a.xyz[3]); }));
}

TEST(Expected, AnotherPointOfTheVoxelIsRightWhereMeansAreNotAsked)
{
  const auto isRight = spoiledAnswers(ComparedWith::TheirVoxels);
  const double voxel = unitLattice(kVoxels).spacing[1];
  const auto middle = [&](double y) { return (std::floor(y / voxel) + 0.5) * voxel; };
  EXPECT_TRUE(isRight([&](ResampleAnswer& a) { a.xyz[40] = middle(a.xyz[40]); }));
  EXPECT_FALSE(isRight([&](ResampleAnswer& a) { a.xyz[40] = middle(a.xyz[40]) + voxel; }));
  EXPECT_FALSE(isRight([](ResampleAnswer& a) { ++a.counts[17]; }));
  EXPECT_FALSE(isRight([](ResampleAnswer& a) { std::swap_ranges(&a.xyz[0], &a.xyz[3], &a.xyz[3]); }));
}

TEST(Expected, ARivalMayComeInAnyOrderAndMissAFewFaces)
{
  const std::vector<float> xyz = randomPoints(20000);
  const Lattice lattice = unitLattice(20);
  const ExpectedMeans expected = expectedMeans({ xyz.data(), 20000 }, lattice);
  ResampleAnswer answer = rightAnswer(expected, lattice);
  answer.counts.clear();
  std::swap_ranges(&answer.xyz[0], &answer.xyz[3], &answer.xyz[300]);
  EXPECT_EQ(judge(answer, expected, ComparedWith::Means).text, "right");
  answer.xyz.resize(answer.xyz.size() - 3);
  EXPECT_EQ(judge(answer, expected, ComparedWith::Means).text, "right but for faces: 1 voxels differ");
  answer.xyz.resize(answer.xyz.size() / 6 * 3);
  EXPECT_FALSE(judge(answer, expected, ComparedWith::Means).right);
}
