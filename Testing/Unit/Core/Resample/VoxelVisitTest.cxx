// VoxelResampler beside means: coarser levels, and the voxel of each point.
#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResampler.h"

#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include <gtest/gtest.h>

#include <array>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

/// Every level is what the resampling of the points at its lattice gives.
void expectLevelsAreDirect(const VoxelRequest& request, const Executor& executor = {})
{
  VoxelResampler resampler;
  const RunResult all = runOf(resampler, request, executor);
  for (int l = 1; l < request.levels; ++l)
  {
    const Lattice& coarse = resampler.lattice(l);
    VoxelRequest direct = request;
    direct.lattice = coarse;
    direct.levels = 1;
    direct.chunkPoints = 0;
    const std::string what = nameOf(request.lattice) + " at " + nameOf(coarse);
    expectSameVoxels(all.levels[std::size_t(l)], runOf(direct).levels[0], what);
  }
}

/// Each point inside knows its voxel, and no other.
void expectIndexed(VoxelRequest request, const Executor& executor)
{
  request.voxelIndex = true;
  const std::string what = nameOf(request.lattice) + (request.index ? " with an index" : "");
  VoxelResampler resampler;
  const RunResult result = runOf(resampler, request, executor);
  const LevelResult& level = result.levels[0];
  const std::vector<std::int64_t> voxels = resampler.voxelIndex();
  ASSERT_EQ(voxels.size(), std::size_t(request.points.size()));
  std::vector<std::int64_t> counts(level.counts.size(), 0);
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    const Vec3 u = request.lattice.continuousIndex(request.points[std::int64_t(i)]);
    ASSERT_EQ(voxels[i] >= 0, request.lattice.contains(u)) << what << " point " << i;
    if (voxels[i] >= 0)
    {
      ASSERT_LT(std::size_t(voxels[i]), level.keys.size());
      ASSERT_EQ(level.keys[std::size_t(voxels[i])],
        request.lattice.key(std::int64_t(u.x), std::int64_t(u.y), std::int64_t(u.z)))
        << what;
      ++counts[std::size_t(voxels[i])];
    }
  }
  EXPECT_EQ(counts, level.counts) << what;
  expectSame(runOf(resampler, request, executor), result, what + " run again");
  EXPECT_EQ(resampler.voxelIndex(), voxels) << what << " run again";
}

} // namespace

TEST(VoxelLevels, AreWhatDirectResamplingGivesBitForBit)
{
  const std::vector<Vec3> points = randomBox(6000, 1, { -0.01, 0, 0 }, { 1, 1, 1.01 });
  for (Lattice lattice : { latticeOf(300, 300, 300), latticeOf(7, 1, 33), latticeOf(1024, 1023, 1024),
         latticeOf(4096, 4095, 300), latticeOf(3, 3, 3), latticeOf(1, 1, 1) })
  {
    lattice.origin = { 0.003, -0.001, 0.002 };
    for (int axis = 0; axis < 3; ++axis)
    {
      lattice.spacing[axis] = 0.99 / double(lattice.dimensions[std::size_t(axis)]);
    }
    VoxelRequest request = requestFor(points, lattice);
    request.levels = 14;
    request.transform = AffineTransform::rotation(3, { 1, 1, 0 });
    expectLevelsAreDirect(request, ThreadedExecutor(2));
    request.singlePrecision = true;
    request.levels = 4;
    expectLevelsAreDirect(request);
  }
}

TEST(VoxelLevels, AreWhatDirectResamplingGivesOnTheFinestLattices)
{
  const Lattice lattice = latticeOf(kMaximumLatticeDimension, 5, 3);
  const std::vector<Vec3> points =
    randomBox(3000, 2, { 0, 0, 0 }, { double(kMaximumLatticeDimension), 5, 3 });
  VoxelRequest request = requestFor(points, lattice);
  request.levels = 9; // 8192 voxels: positions have as many bits on all of these.
  expectLevelsAreDirect(request);
}

TEST(VoxelLevels, LoseNothingWherePointsFitTheQuantaOnBothSidesOfTheBorder)
{
  for (const Lattice& lattice : { latticeOf(5000, 3, 2), latticeOf(kMaximumLatticeDimension, 5, 3) })
  {
    const std::vector<Vec3> points = quantisedPoints(3000, 3, lattice, 0x1p-22);
    VoxelRequest request = requestFor(points, lattice);
    request.covariances = false; // Those are rounded from other quanta.
    request.levels = 22;
    expectLevelsAreDirect(request);
  }
}

TEST(VoxelLevels, AreWhatDirectResamplingGivesForMoreThanAChunk)
{
  for (const Lattice& lattice : { latticeOf(20, 30, 40), latticeOf(1024, 1024, 1024) })
  {
    const std::vector<Vec3> points = quantisedPoints(12600, 3, lattice);
    VoxelRequest request = requestFor(points, lattice);
    request.levels = 2;
    request.chunkPoints = 5000;
    expectLevelsAreDirect(request);
  }
}

TEST(VoxelLevels, AreWhatDirectResamplingGivesOnLatticesOfAllShapes)
{
  trial::Random random(6);
  for (int i = 0; i < 60; ++i)
  {
    const auto largest = [&] { return std::int64_t(std::pow(300.5, random.uniform())); };
    const Lattice lattice = latticeOf(largest(), largest(), largest());
    const auto& d = lattice.dimensions;
    std::vector<Vec3> points =
      randomBox(1 + random.below(4000), 7 + i, { 0, 0, 0 }, Vec3(double(d[0]), double(d[1]), double(d[2])));
    VoxelRequest request = requestFor(points, lattice);
    request.levels = 4;
    if (i % 2 == 1)
    {
      AffineTransform shear;
      shear.m[0][1] = std::pow(10.0, random.uniform(-1, 5));
      request.transform = AffineTransform::rotation(random.uniform(0, 360), random.direction()) * shear;
      for (Vec3& p : points)
      {
        p = request.transform.inverse().apply(p);
      }
    }
    expectLevelsAreDirect(request, ThreadedExecutor(3));
  }
}

TEST(VoxelLevels, AreWhatDirectResamplingGivesBesideAnOverfullCell)
{
  const Lattice lattice = latticeOf(100, 101, 99);
  // 19 of 20 points: more than the 2^21 whose coordinates a sum of 64 bits holds.
  std::vector<Vec3> points = quantisedPoints(2600000, 8, lattice);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (i % 20 != 0)
    {
      points[i] = { 7.0 + points[i].x / 128, 100.0 + points[i].y / 128, 98.0 + points[i].z / 128 };
    }
  }
  VoxelRequest request = requestFor(points, lattice);
  request.levels = 3;
  expectLevelsAreDirect(request, ThreadedExecutor(2));
}

TEST(VoxelLevels, StopAtOneVoxelAndRepeatIt)
{
  const std::vector<Vec3> points = randomBox(100, 4, { 0, 0, 0 }, { 5, 5, 5 });
  VoxelRequest request = requestFor(points, latticeOf(5, 5, 5));
  request.levels = 22;
  VoxelResampler resampler;
  const RunResult result = runOf(resampler, request);
  for (int l = 4; l < 22; ++l)
  {
    EXPECT_EQ(nameOf(resampler.lattice(l)), "1x1x1");
    expectSameVoxels(result.levels[std::size_t(l)], result.levels[3], "level " + std::to_string(l));
  }
}

TEST(VoxelVisit, ReachesEveryPointInsideOnceOnEveryPath)
{
  for (const Lattice& lattice : latticesOfAllPaths())
  {
    std::vector<Vec3> points = quantisedPoints(10000, 5, lattice);
    points[5].x = NAN;
    points[9000].z = INFINITY;
    VoxelRequest request = requestFor(points, lattice);
    expectIndexed(request, {});
    expectIndexed(request, ThreadedExecutor(3));
    PointIndex index;
    ASSERT_EQ(index.build(request.points), Status::Ok);
    request.index = &index;
    expectIndexed(request, ThreadedExecutor(2));
    request.lattice.end = 0.3 * Vec3(double(lattice.dimensions[0]), double(lattice.dimensions[1]), 1e9);
    request.lattice.end.z = INFINITY;
    expectIndexed(request, BackwardExecutor(5));
  }
}

TEST(VoxelVisit, ReachesEveryPointOfMoreThanAChunk)
{
  const Lattice lattice = latticeOf(1000, 1000, 1000);
  const std::vector<Vec3> points = quantisedPoints(13000, 6, lattice);
  VoxelRequest request = requestFor(points, lattice);
  request.covariances = false;
  PointIndex index;
  ASSERT_EQ(index.build(request.points), Status::Ok);
  request.index = &index;
  request.lattice.origin = { 20, 30, 10 };
  request.lattice.dimensions = { 970, 960, 980 };
  for (const std::int64_t chunkPoints : { 5000, 500 })
  {
    request.chunkPoints = chunkPoints;
    expectIndexed(request, ThreadedExecutor(2));
  }
}

TEST(VoxelVisit, AnIndexChangesNoBit)
{
  std::vector<Vec3> points = randomBox(40000, 7, { -1, -1, -1 }, { 1, 1, 1 });
  points[77].y = -INFINITY;
  PointIndex index;
  ASSERT_EQ(index.build({ points.data(), 40000 }), Status::Ok);
  Random random(8);
  for (int i = 0; i < 30; ++i)
  {
    VoxelRequest request =
      requestFor(points, i % 2 == 0 ? latticeOf(60, 70, 80) : latticeOf(1024, 1024, 300));
    request.transform = AffineTransform::translation(random.inBox({ 0, 0, 0 }, { 100, 100, 100 })) *
      AffineTransform::rotation(random.uniform(0, 360), random.direction()) *
      AffineTransform::scaling(random.inBox({ 5, -500, 50 }, { 300, 700, 900 }));
    const RunResult expected = runOf(request);
    request.index = &index;
    expectSame(runOf(request, ThreadedExecutor(2)), expected, "transform " + std::to_string(i));
  }
}

TEST(VoxelVisit, AnIndexLosesNoPointThatRoundingPutsOnAFace)
{
  Random random(9);
  for (int i = 0; i < 200; ++i)
  {
    // Most are in one brick, so that those on the faces have bricks to themselves.
    const AffineTransform transform =
      AffineTransform::translation(random.inBox({ 0, 0, 0 }, { 1e4, 1e4, 1e4 })) *
      AffineTransform::rotation(random.uniform(0, 360), random.direction());
    const AffineTransform back = transform.inverse();
    std::vector<Vec3> points(3000, back.apply({ -1, -1, -1 }));
    for (int j = 0; j < 60; ++j)
    {
      Vec3 target = random.inBox({ 0, 0, 0 }, { 4, 4, 4 });
      target[j % 3] = j % 2 == 0 ? 0.0 : 4.0;
      points.push_back(back.apply(target));
    }
    VoxelRequest request = requestFor(points, latticeOf(4, 4, 4));
    request.transform = transform;
    const RunResult expected = runOf(request);
    PointIndex index;
    ASSERT_EQ(index.build(request.points), Status::Ok);
    request.index = &index;
    expectSame(runOf(request), expected, "transform " + std::to_string(i));
  }
}

TEST(VoxelVisit, AnIndexCountsPointsThatOverflowInTheTransformAsInvalid)
{
  // Outside on x, and beyond all numbers on y.
  std::vector<Vec3> points = trial::randomBox(500, 1, { 0, 0, 0 }, { 1, 1, 1 });
  points.insert(points.end(), 500, Vec3(5, 1e300, 0.5));
  VoxelRequest request;
  request.points = { points.data(), std::int64_t(points.size()) };
  request.lattice = trial::latticeOf(4, 4, 4);
  request.keys = true;
  request.transform = AffineTransform::scaling({ 1, 1e20, 1 });
  const trial::RunResult without = trial::runOf(request);
  EXPECT_GE(without.invalid, 500);
  PointIndex index;
  ASSERT_EQ(index.build(request.points), Status::Ok);
  request.index = &index;
  trial::expectSame(trial::runOf(request), without, "overflow");
}
