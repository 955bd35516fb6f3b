// Sums that points are added to, against one run over all the points.
#include "Core/Resample/VoxelAccumulator.h"

#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

constexpr std::size_t kAddedPoints = 8000;

AffineTransform turned()
{
  return AffineTransform::translation({ 0.2, 0.1, 0.3 }) * AffineTransform::rotation(25, { 1, 2, 3 });
}

struct Case
{
  explicit Case(const Lattice& of)
    : lattice(of)
    , points(quantisedPoints(kAddedPoints, 3, of))
  {
    points[5].z = NAN;
    expected = runOf(request(0, kAddedPoints));
  }
  PointView view(std::size_t first, std::size_t last) const
  {
    return { points.data() + first, std::int64_t(last - first) };
  }
  VoxelRequest request(std::size_t first, std::size_t last) const
  {
    VoxelRequest request;
    request.points = view(first, last);
    request.transform = turned();
    request.lattice = lattice;
    request.keys = true;
    request.covariances = true;
    return request;
  }
  VoxelAccumulator of(std::size_t first, std::size_t last, const Executor& executor = {}) const
  {
    VoxelAccumulator sums(lattice, true, {}, turned());
    EXPECT_EQ(sums.add(view(first, last), {}, executor), Status::Ok);
    return sums;
  }

  Lattice lattice;
  std::vector<Vec3> points;
  RunResult expected;
};

void expectFinishes(VoxelAccumulator& sums, const Case& all, const std::string& what,
  InstructionSet instructions = InstructionSet::Automatic, const Executor& executor = {})
{
  VoxelRequest wanted;
  wanted.keys = true;
  wanted.instructions = instructions;
  VoxelResampler result;
  ASSERT_EQ(sums.finish(wanted, result, executor), Status::Ok) << what;
  const RunResult found = { result.clippedPoints(), result.invalidPoints(),
    voxelsOf(result, all.request(0, 1)) };
  expectSame(found, all.expected, nameOf(all.lattice) + ", " + what);
}

std::vector<Lattice> lattices()
{
  return { latticeOf(60, 50, 40), latticeOf(1024, 1024, 1024), latticeOf(5000, 3, 2), latticeOf(2, 2, 1),
    latticeOf(1, 1, 1) };
}

}

TEST(VoxelAccumulator, GivesWhatOneRunGivesHoweverThePointsAreSplit)
{
  for (const Lattice& lattice : lattices())
  {
    const Case all(lattice);
    VoxelAccumulator whole = all.of(0, kAddedPoints);
    expectFinishes(whole, all, "at once");
    VoxelAccumulator parts(lattice, true, {}, turned());
    for (const std::size_t part : randomOrder(100, 4))
    {
      ASSERT_EQ(parts.add(all.view(kAddedPoints * part / 100, kAddedPoints * (part + 1) / 100), {},
                  ThreadedExecutor(int(part % 3) + 1)),
        Status::Ok);
    }
    EXPECT_EQ(parts.points(), std::int64_t(kAddedPoints));
    for (const InstructionSet set : heldInstructionSets())
    {
      expectFinishes(parts, all, "in parts, instruction set", set, ThreadedExecutor(2));
    }
  }
}

TEST(VoxelAccumulator, MergesInAnyOrder)
{
  for (const Lattice& lattice : lattices())
  {
    const Case all(lattice);
    VoxelAccumulator a = all.of(0, 1000);
    VoxelAccumulator b = all.of(1000, 7000);
    VoxelAccumulator c = all.of(7000, kAddedPoints);
    ASSERT_EQ(b.merge(std::move(a)), Status::Ok);
    ASSERT_EQ(c.merge(std::move(b)), Status::Ok);
    expectFinishes(c, all, "merged");
    VoxelAccumulator d(lattice, true, {}, turned());
    ASSERT_EQ(d.merge(std::move(c)), Status::Ok);
    expectFinishes(d, all, "merged into none");
    VoxelAccumulator e = all.of(0, 1000);
    VoxelAccumulator f = all.of(1000, kAddedPoints);
    ASSERT_EQ(e.merge(std::move(f)), Status::Ok);
    expectFinishes(e, all, "merged with what is no longer needed");
    EXPECT_EQ(f.points(), 0);
    ASSERT_EQ(f.merge(std::move(e)), Status::Ok);
    expectFinishes(f, all, "moved into none");
  }
}

TEST(VoxelAccumulator, RefusesOtherLatticesAndMoments)
{
  const Case all(latticeOf(60, 50, 40));
  VoxelAccumulator sums = all.of(0, kAddedPoints);
  EXPECT_EQ(sums.merge(VoxelAccumulator(latticeOf(60, 50, 41), true)), Status::InvalidParameter);
  EXPECT_EQ(sums.merge(VoxelAccumulator(all.lattice, false)), Status::InvalidParameter);
  EXPECT_EQ(sums.merge(VoxelAccumulator(all.lattice, true)), Status::InvalidParameter) << "transform";
  expectFinishes(sums, all, "after what was refused");
  VoxelAccumulator singular(all.lattice, true, {}, AffineTransform::scaling({ 0, 1, 1 }));
  EXPECT_EQ(singular.add(all.view(0, 10)), Status::SingularTransform);
}

TEST(VoxelAccumulator, ComesBackFromBytes)
{
  for (const Lattice& lattice : lattices())
  {
    const Case all(lattice);
    VoxelAccumulator a = all.of(0, 3000);
    VoxelAccumulator b = all.of(3000, kAddedPoints);
    VoxelAccumulator read(latticeOf(1, 1, 1));
    ASSERT_EQ(VoxelAccumulator::deserialize(a.serialize(), read), Status::Ok);
    ASSERT_EQ(read.merge(std::move(b)), Status::Ok);
    expectFinishes(read, all, "from bytes");
    VoxelAccumulator none(lattice);
    ASSERT_EQ(VoxelAccumulator::deserialize(none.serialize(), read), Status::Ok);
    EXPECT_EQ(read.points(), 0);
  }
}

TEST(VoxelAccumulator, SumsPast64BitsKeepTheirMeans)
{
  for (const Lattice& lattice : { latticeOf(60, 50, 40), latticeOf(5000, 5000, 5000) })
  {
    // A place in a voxel has more than 31 bits: 33 doublings pass 64.
    const std::vector<Vec3> points{ { 7.75, 8.75, 9.75 }, { 1.75, 2.75, 10.75 } };
    VoxelAccumulator one(lattice);
    VoxelAccumulator many(lattice);
    ASSERT_EQ(one.add(PointView(points.data(), 1)), Status::Ok);
    ASSERT_EQ(many.add(PointView(points.data() + 1, 1)), Status::Ok);
    for (int doubling = 0; doubling < 33; ++doubling)
    {
      ASSERT_EQ(many.merge(many.part(0, ~std::uint64_t(0))), Status::Ok);
    }
    ASSERT_EQ(many.merge(std::move(one)), Status::Ok);
    VoxelResampler result;
    ASSERT_EQ(many.finish({}, result), Status::Ok);
    ASSERT_EQ(result.size(), 2);
    EXPECT_EQ(result.counts()[0], 1);
    EXPECT_EQ(result.counts()[1], std::int64_t(1) << 33);
    EXPECT_TRUE(std::equal(result.doubles(), result.doubles() + 6, &points[0].x));
  }
}

TEST(VoxelAccumulator, OtherVoxelsOrAnotherEndAreAnotherLattice)
{
  const Lattice lattice = latticeOf(4, 4, 4);
  VoxelAccumulator sums(lattice);
  Lattice other = lattice;
  other.spacing = { 1.0, 1.0, 1.5 };
  EXPECT_EQ(sums.merge(VoxelAccumulator(other)), Status::InvalidParameter);
  other = lattice;
  other.origin = { 0.0, 0.5, 0.0 };
  EXPECT_EQ(sums.merge(VoxelAccumulator(other)), Status::InvalidParameter);
  other = lattice;
  other.end = { 3.5, 3.5, 3.5 };
  EXPECT_EQ(sums.merge(VoxelAccumulator(other)), Status::InvalidParameter);
  EXPECT_EQ(sums.merge(VoxelAccumulator(lattice)), Status::Ok);
}

TEST(VoxelAccumulator, MorePointsThanItCanCountAreRefusedBeforeTheyAreRead)
{
  VoxelAccumulator sums(latticeOf(4, 4, 4));
  const Vec3 one{ 0.5, 0.5, 0.5 };
  EXPECT_EQ(sums.add(PointView(&one, VoxelAccumulator::kMostPoints + 1)), Status::InvalidParameter);
  EXPECT_EQ(sums.points(), 0);
}
