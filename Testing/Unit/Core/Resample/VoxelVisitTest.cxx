// VoxelResampler beside means: the voxel of each point, and indexed clouds.
#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResampler.h"

#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include <gtest/gtest.h>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

/// Each point inside knows its voxel, and no other.
void expectIndexed(VoxelRequest request, const Executor& executor)
{
  request.voxelIndex = true;
  const std::string what = nameOf(request.lattice) + (request.index ? " with an index" : "");
  VoxelResampler resampler;
  const RunResult result = runOf(resampler, request, executor);
  const VoxelResult& level = result.voxels;
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
