#include "Core/Resample/Stages/VoxelRuns.h"

#include "Core/Resample/Stages/VoxelWriter.h"

#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include <gtest/gtest.h>

#include <map>

using namespace pointhaptics;
using namespace pointhaptics::simd;
using namespace pointhaptics::trial;

namespace
{

VoxelRun randomRun(std::uint64_t seed, std::size_t voxels, std::uint64_t largestGap)
{
  Random random(seed);
  VoxelRun run;
  std::uint64_t key = 0;
  for (std::size_t v = 0; v < voxels; ++v)
  {
    key += 1 + random.below(largestGap);
    const auto sum = [&] { return std::uint64_t(random.below(std::size_t(1) << 63)) * 2; };
    run.voxels.push_back({ key, std::int64_t(1 + random.below(1000)), { sum(), sum(), sum() }, 0 });
    run.secondMoments.push_back(SecondMoments{ { sum(), sum(), sum(), sum(), sum(), sum() } });
  }
  return run;
}

}

TEST(VoxelRuns, SumsPast64BitsAreExact)
{
  struct Sums
  {
    std::int64_t count = 0;
    Int128 of[3] = { 0, 0, 0 };
  };
  std::map<std::uint64_t, Sums> expected;
  VoxelRuns runs;
  for (std::uint64_t r = 0; r < 60; ++r)
  {
    const VoxelRun run = randomRun(r, 50 + 20 * (r % 7), 5);
    for (const WideSums& voxel : run.voxels)
    {
      Sums& sums = expected[voxel.key];
      sums.count += voxel.count;
      for (int axis = 0; axis < 3; ++axis)
      {
        sums.of[axis] += Int128(voxel.low[axis]);
      }
    }
    runs.add(run);
  }
  const VoxelRun& run = runs.whole();
  ASSERT_EQ(run.size(), expected.size());
  ASSERT_EQ(run.secondMoments.size(), expected.size());
  std::size_t v = 0;
  for (const auto& [key, sums] : expected)
  {
    const WideSums& voxel = run.voxels[v];
    ASSERT_EQ(voxel.key, key);
    ASSERT_EQ(voxel.count, sums.count);
    for (int axis = 0; axis < 3; ++axis)
    {
      ASSERT_TRUE(voxel.sum(axis) == sums.of[axis]) << "voxel " << v << " axis " << axis;
    }
    ++v;
  }
}

TEST(VoxelRuns, HoldLittleMoreThanEachVoxelOnceHoweverOftenTheyCome)
{
  VoxelRuns runs;
  const std::size_t voxels = 10000;
  for (std::uint64_t r = 0; r < 100; ++r)
  {
    // The first comes with all voxels, the others with some of them.
    VoxelRun run = randomRun(1, voxels, 3);
    run.secondMoments.clear();
    run.voxels.resize(r == 0 ? voxels : 100 + 90 * r);
    runs.add(run);
    ASSERT_LE(runs.bytes(), voxels * 66 + 1000);
  }
}

TEST(VoxelRuns, MeansOfSumsThatVectorsCannotTakeLieWhereTheyBelong)
{
  const Lattice lattice = latticeOf(5000, 5000, 5000);
  const std::int64_t count = std::int64_t(1) << 30;
  const std::uint64_t place = std::uint64_t(3) << 37; // Three quarters of a voxel.
  const UInt128 sum = UInt128(place) * std::uint64_t(count);
  const std::uint64_t low = std::uint64_t(sum);
  const std::uint64_t high = std::uint64_t(sum >> 64);
  ASSERT_GT(high, 0u);
  VoxelRun run;
  run.voxels.push_back({ lattice.key(7, 8, 9), 4, { 4 * place, 4 * place, 4 * place }, 0 });
  run.voxels.push_back({ lattice.key(1, 2, 10), count, { low, low, low }, high | high << 21 | high << 42 });
  VoxelRuns runs;
  runs.add(run);
  VoxelWriter writer;
  writer.prepare(2, { false, true, false }, lattice, 39, nullptr);
  writer.write(0, runs.whole(), 0, 2);
  const double expected[6] = { 7.75, 8.75, 9.75, 1.75, 2.75, 10.75 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(writer.doubles()[i], expected[i]) << i;
  }
  EXPECT_EQ(writer.counts()[0], 4);
  EXPECT_EQ(writer.counts()[1], count);
  EXPECT_EQ(writer.keys()[1], lattice.key(1, 2, 10));
}
