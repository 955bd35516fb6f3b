#include "Core/Resample/VoxelResampler.h"

#include "Core/Neighbors/PointIndex.h"
#include "CountingObserver.h"
#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include "Unit/HeapBytes.h"
#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

/// Points of a chunk that make a voxel overfull with 13 of 16 of them: 2^19 do.
constexpr std::int64_t kOverfullChunk = 650000;

/// All but three of @p group points are in one voxel.
std::vector<Vec3> pointsWithAnOverfullCell(
  std::size_t n, const Lattice& lattice, const Vec3& voxel, std::size_t group = 16)
{
  std::vector<Vec3> points = quantisedPoints(n, 1, lattice);
  Random random(2);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (int axis = 0; axis < 3 && i % group + 3 < group; ++axis)
    {
      points[i][axis] = voxel[axis] + double(std::int64_t(random.uniform(0.3, 1.0) / kQuantum)) * kQuantum;
    }
  }
  return points;
}

AffineTransform generalTransform(double scale)
{
  return AffineTransform::translation(scale * Vec3(0.5, 0.4, 0.6)) *
    AffineTransform::rotation(33, { 1, 2, -1 }) * AffineTransform::scaling(scale * Vec3(0.5, -0.7, 0.6));
}

} // namespace

TEST(VoxelResampler, SumsMillionsOfPointsInOneVoxelExactlyWithTheirProductsOrWithout)
{
  // More than the 2^21 points whose coordinates a sum of 64 bits holds, in chunks of the default size.
  const Lattice lattice = latticeOf(300, 300, 300);
  const std::vector<Vec3> points = pointsWithAnOverfullCell(3200000, lattice, { 123, 45, 299 });
  const RunResult with = runOf(requestFor(points, lattice, true));
  expectExact(points, lattice, with);
  RunResult without = runOf(requestFor(points, lattice, false));
  without.voxels.covariances = with.voxels.covariances;
  expectSame(without, with, "without covariances");
}

TEST(VoxelResampler, SumsAnOverfullOneOfFewVoxelsExactly)
{
  for (const Lattice& lattice : { latticeOf(5, 5, 5), latticeOf(4, 4, 4) })
  {
    const std::vector<Vec3> points = pointsWithAnOverfullCell(700000, lattice, { 3, 0, 3 });
    VoxelRequest request = requestFor(points, lattice, false);
    request.chunkPoints = kOverfullChunk;
    expectExact(points, lattice, runOf(request));
  }
}

TEST(VoxelResampler, IsExactForTheFewPointsThatSeveralChunksHaveBesideAnOverfullCell)
{
  const Lattice lattice = latticeOf(300, 300, 300);
  const std::vector<Vec3> points = pointsWithAnOverfullCell(700000, lattice, { 123, 45, 299 }, 1024);
  for (const InstructionSet set : { InstructionSet::Baseline, InstructionSet::Automatic })
  {
    VoxelRequest request = requestFor(points, lattice);
    request.chunkPoints = kOverfullChunk;
    request.instructions = set;
    expectExact(points, lattice, runOf(request));
  }
}

TEST(VoxelResampler, IsExactOnEveryPath)
{
  for (const Lattice& lattice : latticesOfAllPaths())
  {
    SCOPED_TRACE(nameOf(lattice));
    const std::vector<Vec3> points = quantisedPoints(20000, 3, lattice);
    expectExact(points, lattice, runOf(requestFor(points, lattice)));
  }
}

TEST(VoxelResampler, IsExactForMoreThanAChunkOfScatteredPoints)
{
  for (const Lattice& lattice :
    { latticeOf(300, 300, 300), latticeOf(2048, 2048, 300), latticeOf(5000, 300, 200) })
  {
    SCOPED_TRACE(nameOf(lattice));
    const std::vector<Vec3> points = quantisedPoints(12600, 4, lattice);
    VoxelRequest request = requestFor(points, lattice);
    request.chunkPoints = 5000;
    expectExact(points, lattice, runOf(request));
  }
}

TEST(VoxelResampler, GivesTheSameBitsForEveryOrderExecutorAndInstructionSet)
{
  for (const Lattice& lattice : latticesOfAllPaths())
  {
    const auto& d = lattice.dimensions;
    const std::vector<Vec3> points =
      randomBox(12000, 5, { 0, 0, 0 }, Vec3(double(d[0]), double(d[1]), 1.01 * double(d[2])));
    VoxelRequest request = requestFor(points, lattice);
    const RunResult expected = runOf(request);
    for (const InstructionSet set : heldInstructionSets())
    {
      request.instructions = set;
      expectSame(runOf(request), expected, nameOf(lattice) + " set " + std::to_string(int(set)));
      expectSame(runOf(request, ThreadedExecutor(8)), expected, nameOf(lattice) + " on eight threads");
    }
    request.instructions = InstructionSet::Automatic;
    expectSame(runOf(request, BackwardExecutor(7)), expected, nameOf(lattice) + " backward");
    std::vector<Vec3> shuffled;
    for (const std::size_t i : randomOrder(points.size(), 6))
    {
      shuffled.push_back(points[i]);
    }
    expectSame(runOf(requestFor(shuffled, lattice)), expected, nameOf(lattice) + " shuffled");
  }
}

TEST(VoxelResampler, TheLowestCornerIsInsideWhateverTheSignOfItsZeros)
{
  Lattice lattice = latticeOf(300, 300, 300);
  for (const double corner : { 0.0, -0.0, 0.1, -7.0 })
  {
    lattice.origin = { corner, corner, corner };
    const std::vector<Vec3> points(37, corner == 0.0 ? Vec3(-0.0, -0.0, -0.0) : lattice.origin);
    // Reciprocals that are rounded up, and down.
    for (int i = 1; i < 30; ++i)
    {
      lattice.spacing = { 0.01 * i, 0.01 * i, 0.01 * i };
      VoxelRequest request = requestFor(points, lattice);
      for (const InstructionSet set : heldInstructionSets())
      {
        request.instructions = set;
        const RunResult result = runOf(request);
        ASSERT_EQ(result.voxels.counts.size(), 1u) << corner << ", " << i << " cm, set " << int(set);
        EXPECT_EQ(result.voxels.counts[0], 37);
        EXPECT_EQ(result.voxels.keys[0], 0u);
      }
    }
  }
}

TEST(VoxelResampler, GivesTheSameBitsUnderAGeneralTransformInBothPrecisions)
{
  for (const double slant : { 0.0, 1e6 })
  {
    AffineTransform shear;
    shear.m[0][1] = slant;
    std::vector<Vec3> points = randomBox(30000, 7, { -1, -1, -1 }, { 1, 1, 1 });
    for (Vec3& p : points)
    {
      p.x -= slant * p.y;
    }
    for (const Lattice& lattice : { latticeOf(300, 300, 300), latticeOf(4096, 4096, 4096) })
    {
      for (const bool single : { false, true })
      {
        VoxelRequest request = requestFor(points, lattice);
        request.transform = generalTransform(double(lattice.dimensions[0])) * shear;
        request.singlePrecision = single;
        const RunResult expected = runOf(request);
        ASSERT_GT(expected.voxels.counts.size(), 1000u);
        for (const InstructionSet set : heldInstructionSets())
        {
          request.instructions = set;
          expectSame(runOf(request, ThreadedExecutor(2)), expected, nameOf(lattice));
        }
      }
    }
  }
}

TEST(VoxelResampler, GivesTheSameBitsForChunksOfAnySize)
{
  for (const Lattice& lattice : { latticeOf(60, 50, 40), latticeOf(1024, 1024, 1024), latticeOf(5000, 3, 2) })
  {
    const std::vector<Vec3> points = quantisedPoints(10000, 47, lattice);
    VoxelRequest request = requestFor(points, lattice);
    request.covariances = true;
    const RunResult expected = runOf(request);
    for (const std::int64_t size : { 97, 1000, 4096, 4099, 9999, 10000 })
    {
      request.chunkPoints = size;
      expectSame(runOf(request, ThreadedExecutor(2)), expected, "chunks of " + std::to_string(size));
    }
  }
}

TEST(VoxelResampler, FloatMeansLieInTheirVoxelsAndRoundTheDoubleOnes)
{
  Random random(9);
  std::vector<Vec3> points;
  Lattice lattice = latticeOf(50, 50, 50);
  lattice.origin = { 4600000, -512700, 0 };
  lattice.spacing = { 1, 0.25, 1.0 / 3.0 };
  for (int i = 0; i < 20000; ++i)
  {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double u = double(random.below(50)) + 1.0 - 0.02 * random.uniform() * random.uniform();
      p[axis] = lattice.origin[axis] + std::nextafter(u, 0.0) * lattice.spacing[axis];
    }
    points.push_back(p);
  }
  VoxelRequest request = requestFor(points, lattice);
  const VoxelResult doubles = runOf(request).voxels;
  request.singlePrecision = true;
  const VoxelResult floats = runOf(request).voxels;
  ASSERT_EQ(floats.keys, doubles.keys);
  for (std::size_t v = 0; v < floats.keys.size(); ++v)
  {
    const auto index = lattice.indexOf(floats.keys[v]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const float f = floats.floats[3 * v + axis];
      const double u = (double(f) - lattice.origin[int(axis)]) / lattice.spacing[int(axis)];
      ASSERT_EQ(std::floor(u), double(index[axis])) << "voxel " << v << " axis " << axis;
      const float ulp = std::nextafter(std::fabs(f), INFINITY) - std::fabs(f);
      ASSERT_NEAR(double(f), doubles.means[3 * v + axis], double(ulp));
    }
  }
}

TEST(VoxelResampler, OneObjectDoesWhatAFreshOneDoesWhateverItDidBefore)
{
  const std::vector<Vec3> points = randomBox(20000, 10, { 0, 0, 0 }, { 70, 70, 70 });
  VoxelResampler reused;
  int step = 0;
  for (int round = 0; round < 2; ++round)
  {
    for (const Lattice& lattice : latticesOfAllPaths())
    {
      for (const int options : { 0, 1, 2, 3 })
      {
        VoxelRequest request = requestFor(points, lattice, (options & 1) != 0);
        request.singlePrecision = (options & 2) != 0;
        request.points = { points.data(), 20000 - 37 * step };
        const ThreadedExecutor threads(1 + step % 3);
        expectSame(runOf(reused, request, threads), runOf(request), nameOf(lattice));
        step = (step + 1) % 100;
      }
    }
    VoxelResampler moved = std::move(reused);
    reused = std::move(moved);
  }
}

TEST(VoxelResampler, AnAbortLeavesNoVoxelsAndAUsableObject)
{
  for (const Lattice& lattice : { latticeOf(60, 60, 60), latticeOf(1024, 1024, 1024), latticeOf(5000, 3, 2) })
  {
    const std::vector<Vec3> points = quantisedPoints(12600, 11, lattice);
    VoxelRequest request = requestFor(points, lattice);
    request.chunkPoints = 5000;
    VoxelResampler resampler;
    CountingObserver once(1);
    EXPECT_EQ(resampler.run(request, {}, &once), Status::Aborted);
    EXPECT_EQ(once.fractions.size(), 1u);
    EXPECT_EQ(resampler.size(), 0);
    EXPECT_EQ(resampler.clippedPoints(), 0);
    EXPECT_EQ(resampler.invalidPoints(), 0);
    VoxelRequest less = request;
    less.points = { points.data(), 4000 };
    expectSame(runOf(resampler, less), runOf(less), nameOf(lattice));
    // And in the pass that tells points their voxels, the last one.
    VoxelRequest indexed = request;
    indexed.voxelIndex = true;
    CountingObserver patient;
    EXPECT_EQ(resampler.run(indexed, {}, &patient), Status::Ok);
    CountingObserver late(int(patient.fractions.size()));
    EXPECT_EQ(resampler.run(indexed, {}, &late), Status::Aborted);
    EXPECT_TRUE(resampler.voxelIndex().empty());
  }
}

TEST(VoxelResampler, FractionsAscendToOne)
{
  for (const Lattice& lattice : { latticeOf(60, 60, 60), latticeOf(5000, 3, 2) })
  {
    const std::vector<Vec3> points = quantisedPoints(12001, 12, lattice);
    VoxelRequest request = requestFor(points, lattice, false);
    request.chunkPoints = 5000;
    VoxelResampler resampler;
    CountingObserver observer;
    ASSERT_EQ(resampler.run(request, ThreadedExecutor(2), &observer), Status::Ok);
    expectAscendToOne(observer.fractions, 3);
  }
}

namespace
{

std::size_t freedBytes(VoxelResampler& resampler)
{
  const std::size_t before = heapBytes();
  resampler.releaseScratch();
  return before - heapBytes();
}

}

TEST(VoxelResampler, ScratchDoesNotGrowWhileASheetMovesThroughTheLattice)
{
  // Layers of the lattice are partitions: each has most voxels at some time.
  SKIP_WITHOUT_HEAP();
  const std::size_t before = heapBytes();
  VoxelResampler resampler;
  std::size_t least = ~std::size_t(0);
  std::size_t most = 0;
  for (double z = 0.5; z < 20.0; z += 1.0)
  {
    const std::vector<Vec3> points = randomBox(42000, 31, { 0, 0, z }, { 200, 200, z + 0.25 });
    VoxelRequest request = requestFor(points, latticeOf(200, 200, 20), false);
    request.chunkPoints = 21000;
    ASSERT_EQ(resampler.run(request), Status::Ok);
    const std::size_t kept = heapBytes() - before - points.capacity() * sizeof(Vec3);
    least = std::min(least, kept);
    most = std::max(most, kept);
  }
  EXPECT_LT(most, least + least / 8);
}

TEST(VoxelResampler, HoldsFourChunksHoweverManyThereAre)
{
  SKIP_WITHOUT_HEAP();
  const std::vector<Vec3> points = randomBox(400000, 32, { 0, 0, 0 }, { 20, 20, 20 });
  VoxelRequest request = requestFor(points, latticeOf(20, 20, 20), false);
  VoxelResampler all;
  const RunResult expected = runOf(all, request);
  EXPECT_GT(freedBytes(all), std::size_t(400000 * 16));
  request.chunkPoints = 10000;
  VoxelResampler chunks;
  expectSame(runOf(chunks, request), expected, "chunks");
  EXPECT_LT(freedBytes(chunks), std::size_t(4 * 10000 * 16 + 1500000));
}

TEST(VoxelResampler, FreesItsScratch)
{
  SKIP_WITHOUT_HEAP();
  const std::vector<Vec3> points = randomBox(50000, 13, { 0, 0, 0 }, { 300, 300, 300 });
  const VoxelRequest request = requestFor(points, latticeOf(300, 300, 300));
  VoxelResampler resampler;
  const RunResult expected = runOf(resampler, request);
  const std::size_t bytes = heapBytes();
  runOf(resampler, request);
  EXPECT_LT(heapBytes(), bytes + 100000) << "the same again needs no more";
  EXPECT_GT(freedBytes(resampler), std::size_t(50000 * 16));
  EXPECT_EQ(resampler.size(), 0);
  expectSame(runOf(resampler, request), expected, "after releaseScratch()");
}

TEST(VoxelResampler, RefusesWhatItCannotDoAndHasNoVoxelsThen)
{
  const std::vector<Vec3> points = randomBox(100, 14, { 0, 0, 0 }, { 3, 3, 3 });
  const VoxelRequest good = requestFor(points, latticeOf(3, 3, 3));
  VoxelResampler resampler;
  const auto expectRefused = [&](const VoxelRequest& request, Status status)
  {
    ASSERT_EQ(resampler.run(good), Status::Ok);
    ASSERT_GT(resampler.size(), 0);
    EXPECT_EQ(resampler.run(request), status);
    EXPECT_EQ(resampler.size(), 0);
  };
  VoxelRequest bad = good;
  bad.transform = AffineTransform::scaling({ 1, 0, 1 });
  expectRefused(bad, Status::SingularTransform);
  bad.transform = AffineTransform::translation({ NAN, 0, 0 });
  expectRefused(bad, Status::NonFiniteTransform);
  bad = good;
  bad.lattice.spacing.y = -1;
  expectRefused(bad, Status::InvalidVoxelSize);
  bad = good;
  bad.lattice.dimensions[0] = kMaximumLatticeDimension + 1;
  expectRefused(bad, Status::InvalidDimensions);
  const std::vector<Vec3> others = randomBox(50, 15, { 0, 0, 0 }, { 3, 3, 3 });
  PointIndex index;
  ASSERT_EQ(index.build(PointView(&others[0].x, 50)), Status::Ok);
  bad = good;
  bad.index = &index;
  expectRefused(bad, Status::InvalidParameter);
}

TEST(VoxelResampler, CloudsWithoutAPointInsideAreNoError)
{
  const std::vector<Vec3> outside(5, Vec3(-1, 0, 0));
  const std::vector<Vec3> invalid(4, Vec3(0, NAN, 0));
  for (const Lattice& lattice : latticesOfAllPaths())
  {
    for (const auto* points : { &outside, &invalid })
    {
      VoxelRequest request = requestFor(*points, lattice);
      VoxelResampler resampler;
      const RunResult result = runOf(resampler, request);
      EXPECT_EQ(result.clipped, points == &outside ? 5 : 0);
      EXPECT_EQ(result.invalid, points == &outside ? 0 : 4);
      EXPECT_EQ(resampler.size(), 0);
    }
    VoxelRequest none = requestFor({}, lattice);
    CountingObserver observer;
    VoxelResampler resampler;
    EXPECT_EQ(resampler.run(none, {}, &observer), Status::Ok);
    EXPECT_EQ(resampler.size(), 0);
    none.voxelIndex = true;
    EXPECT_EQ(resampler.run(none), Status::Ok);
    EXPECT_TRUE(resampler.voxelIndex().empty());
  }
}

TEST(VoxelResampler, OfAPartItsVoxelsAreTheSameBitForBit)
{
  const Lattice lattice = latticeOf(120, 120, 120);
  const std::vector<Vec3> points = randomBox(300000, 5, { -150, -150, -150 }, { 150, 150, 150 });
  PointIndex index;
  ASSERT_EQ(index.build({ points.data(), std::int64_t(points.size()) }), Status::Ok);
  VoxelRequest request = requestFor(points, lattice);
  request.transform = generalTransform(100.0);
  request.transform = AffineTransform::scaling({ 0.01, 0.01, 0.01 }) * request.transform;
  request.index = &index;
  VoxelResampler resampler;
  const VoxelResult whole = runOf(resampler, request).voxels;
  request.part = lattice;
  request.part->origin =
    lattice.origin + Vec3{ 40 * lattice.spacing.x, 30 * lattice.spacing.y, 50 * lattice.spacing.z };
  request.part->dimensions = { 20, 35, 10 };
  const RunResult run = runOf(resampler, request);
  const VoxelResult& part = run.voxels;
  EXPECT_LT(part.keys.size(), whole.keys.size() / 9);
  EXPECT_GT(run.clipped, 200000);
  int inside = 0;
  for (std::size_t i = 0; i < whole.keys.size(); ++i)
  {
    const auto voxel = lattice.indexOf(whole.keys[i]);
    if (voxel[0] < 40 || voxel[0] >= 60 || voxel[1] < 30 || voxel[1] >= 65 || voxel[2] < 50 || voxel[2] >= 60)
    {
      continue;
    }
    const auto at =
      std::size_t(std::lower_bound(part.keys.begin(), part.keys.end(), whole.keys[i]) - part.keys.begin());
    ASSERT_LT(at, part.keys.size());
    ASSERT_EQ(part.keys[at], whole.keys[i]);
    EXPECT_EQ(part.counts[at], whole.counts[i]);
    EXPECT_EQ(part.means[3 * at + 1], whole.means[3 * i + 1]);
    EXPECT_EQ(part.covariances[at].xz, whole.covariances[i].xz);
    ++inside;
  }
  EXPECT_GT(inside, 100);
}
