// Lattices that the partitions of voxels cannot take as they are: few voxels with many points, more voxels on
// an axis than a record can tell, voxels of no ordinary size. All give what the others would.
#include "Core/Neighbors/PointIndex.h"
#include "Core/Reference/ReferenceVoxelMean.h"
#include "Core/Resample/VoxelResampler.h"

#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

/// Unit voxels become ones of edge 1 / count.
Lattice unitCube(std::int64_t count)
{
  Lattice lattice = latticeOf(count, count, count);
  lattice.spacing = { 1.0 / double(count), 1.0 / double(count), 1.0 / double(count) };
  return lattice;
}

/// Points on a sphere and a few scattered ones, so that voxels have from one to many points.
std::vector<Vec3> sphereAndDust(std::size_t n, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i)
  {
    points.push_back(i % 5 == 0 ? random.inBox({ -0.01, 0, 0 }, { 1, 1, 1 })
                                : Vec3{ 0.5, 0.5, 0.5 } + 0.45 * random.direction());
  }
  return points;
}

void expectNearReference(const VoxelRequest& request, const VoxelResult& level)
{
  const reference::VoxelMap expected =
    reference::voxelMeans(request.points, request.transform, request.lattice);
  ASSERT_EQ(level.keys.size(), expected.voxels.size());
  std::size_t v = 0;
  for (const auto& [key, voxel] : expected.voxels)
  {
    ASSERT_EQ(level.keys[v], key);
    ASSERT_EQ(level.counts[v], std::int64_t(voxel.members.size()));
    for (int axis = 0; axis < 3; ++axis)
    {
      const double error = std::fabs(level.means[3 * v + std::size_t(axis)] - double(voxel.mean[axis]));
      ASSERT_LE(error, 0x1p-31 * request.lattice.spacing[axis] + 6e-16) << "voxel " << v;
    }
    ++v;
  }
}

}

TEST(VoxelPaths, ManyChunksInFewVoxelsAreWhatOneChunkGives)
{
  const std::vector<Vec3> points = sphereAndDust(13000, 1);
  for (const bool covariances : { false, true })
  {
    VoxelRequest request = requestFor(points, unitCube(8), covariances);
    const VoxelResult expected = runOf(request, ThreadedExecutor(2)).voxels;
    request.chunkPoints = 4000;
    request.voxelIndex = true;
    VoxelResampler resampler;
    const RunResult result = runOf(resampler, request, ThreadedExecutor(2));
    expectSameVoxels(result.voxels, expected, covariances ? "with covariances" : "without");
    std::vector<std::int64_t> counts(result.voxels.counts.size());
    for (const std::int64_t voxel : resampler.voxelIndex())
    {
      if (voxel >= 0)
      {
        ++counts[std::size_t(voxel)];
      }
    }
    EXPECT_EQ(counts, result.voxels.counts);
  }
}

TEST(VoxelPaths, VoxelsOfNoOrdinarySizeGiveTheSameBits)
{
  const std::vector<Vec3> points = sphereAndDust(13000, 3);
  const double tiny = std::ldexp(1.0, -540);
  std::vector<Vec3> small;
  for (const Vec3& p : points)
  {
    small.push_back(tiny * p);
  }
  for (const std::int64_t n : { 2, 30, 300 })
  {
    VoxelRequest request = requestFor(points, unitCube(n), false);
    request.chunkPoints = 6000;
    RunResult expected = runOf(request);
    for (double& mean : expected.voxels.means)
    {
      mean *= tiny;
    }
    VoxelRequest scaled = request;
    scaled.points = view(small);
    scaled.lattice.spacing = tiny * scaled.lattice.spacing;
    expectSame(runOf(scaled, ThreadedExecutor(2)), expected, std::to_string(n));
  }
}

TEST(VoxelPaths, FineLatticesMeetTheOracle)
{
  const std::vector<Vec3> points = sphereAndDust(40000, 4);
  for (const std::int64_t n : { std::int64_t(5000), std::int64_t(1) << 20 })
  {
    VoxelRequest request = requestFor(points, unitCube(n));
    request.lattice.end.y = 0.7 * double(n);
    expectNearReference(request, runOf(request, ThreadedExecutor(3)).voxels);
  }
}

TEST(VoxelPaths, FineLatticesGiveTheSameBitsForEveryOrderOfManyChunks)
{
  // A small patch on 5000^3, so that all chunks meet in its voxels, and a wide one where they do not.
  for (const double extent : { 0.002, 1.0 })
  {
    const std::vector<Vec3> points =
      randomBox(17000, 5, { 0.2, 0.2, 0.2 }, Vec3{ 0.2, 0.2, 0.2 } + 0.79 * extent * Vec3(1, 1, 1));
    VoxelRequest request = requestFor(points, unitCube(5000), false);
    request.chunkPoints = 2600;
    const RunResult expected = runOf(request);
    std::int64_t sum = 0;
    for (const std::int64_t count : expected.voxels.counts)
    {
      sum += count;
    }
    EXPECT_EQ(sum, std::int64_t(points.size()));
    const std::vector<Vec3> reversed(points.rbegin(), points.rend());
    request.points = view(reversed);
    expectSame(runOf(request, ThreadedExecutor(2)), expected, "reversed");
  }
}

TEST(VoxelPaths, AnIndexChangesNoBitOfFineLattices)
{
  std::vector<Vec3> points = sphereAndDust(60000, 6);
  points[3].x = NAN;
  PointIndex index;
  ASSERT_EQ(index.build({ points.data(), std::int64_t(points.size()) }), Status::Ok);
  VoxelRequest request = requestFor(points, unitCube(6000));
  request.transform = AffineTransform::translation({ 0.6, 0.7, 0.5 }) *
    AffineTransform::rotation(40, { 1, 0, 2 }) * AffineTransform::scaling({ 1, 1, -1.2 }) *
    AffineTransform::translation({ -0.5, -0.5, -0.5 });
  const RunResult expected = runOf(request);
  ASSERT_GT(expected.voxels.counts.size(), 1000u);
  ASSERT_GT(expected.clipped, 1000);
  request.index = &index;
  expectSame(runOf(request, ThreadedExecutor(2)), expected, "with an index");
}
