// Voxels whose points lie on several ranks, against one run over all points.
#include "Core/Distributed/SharedVoxels.h"

#include "RandomClouds.h"
#include "ResamplerRuns.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

constexpr std::size_t kPoints = 6000;
const std::vector<int> kSizes = { 1, 2, 3, 4, 8 };

VoxelRequest requestOf(const std::vector<Vec3>& points, const Lattice& lattice)
{
  VoxelRequest request;
  request.points = { points.data(), std::int64_t(points.size()) };
  request.lattice = lattice;
  request.keys = true;
  request.covariances = true;
  return request;
}

/// Where the points of each rank end: uneven, and some ranks have none.
std::vector<std::size_t> splitOfPoints(int size, std::uint64_t seed)
{
  Random random(seed);
  std::vector<std::size_t> ends;
  for (int r = 1; r < size; ++r)
  {
    ends.push_back(random.below(4) == 0 ? 0 : random.below(kPoints));
  }
  ends.push_back(kPoints);
  std::sort(ends.begin(), ends.end());
  ends.insert(ends.begin(), 0);
  return ends;
}

PointView partOf(const std::vector<Vec3>& points, const std::vector<std::size_t>& ends, int rank)
{
  const std::size_t begin = ends[std::size_t(rank)];
  return { points.data() + begin, std::int64_t(ends[std::size_t(rank) + 1] - begin) };
}

template <typename T>
void append(std::vector<T>& all, const std::vector<T>& more)
{
  all.insert(all.end(), more.begin(), more.end());
}

void append(RunResult& all, const RunResult& part)
{
  all.clipped = part.clipped;
  all.invalid = part.invalid;
  append(all.voxels.means, part.voxels.means);
  append(all.voxels.counts, part.voxels.counts);
  append(all.voxels.keys, part.voxels.keys);
  append(all.voxels.covariances, part.voxels.covariances);
}

/// Joins the results of the ranks, one after the other.
RunResult sharedRun(
  const std::vector<Vec3>& points, const Lattice& lattice, const std::vector<std::size_t>& ends)
{
  const int size = int(ends.size()) - 1;
  std::vector<RunResult> results(static_cast<std::size_t>(size));
  ThreadJob job(size);
  job.run(
    [&](Ranks& ranks)
    {
      VoxelAccumulator own(lattice, true);
      EXPECT_EQ(own.add(partOf(points, ends, ranks.rank())), Status::Ok);
      EXPECT_EQ(shareVoxels(ranks, shareKeys(ranks, own.keys()), own), Status::Ok);
      VoxelRequest wanted;
      wanted.keys = true;
      VoxelResampler made;
      EXPECT_EQ(own.finish(wanted, made), Status::Ok);
      RunResult& result = results[std::size_t(ranks.rank())];
      result.clipped = ranks.sum(own.clippedPoints());
      result.invalid = ranks.sum(own.invalidPoints());
      result.voxels = voxelsOf(made, requestOf(points, lattice));
    });
  RunResult all;
  for (const RunResult& result : results)
  {
    append(all, result);
  }
  return all;
}

std::vector<Vec3> cloudOf(const Lattice& lattice)
{
  std::vector<Vec3> points = quantisedPoints(kPoints, 5, lattice);
  points[7].y = NAN;
  points[kPoints - 1].x = INFINITY;
  return points;
}

/// The arrays of the test: floats with and without numbers that are not finite, integers, labels.
struct Arrays
{
  std::vector<float> floats;
  std::vector<double> doubles;
  std::vector<std::int64_t> integers;
  std::vector<std::uint8_t> labels;

  explicit Arrays(std::uint64_t seed)
  {
    Random random(seed);
    for (std::size_t i = 0; i < 3 * kPoints; ++i)
    {
      floats.push_back(float(random.uniform(-1.0, 1.0)));
      doubles.push_back(std::ldexp(random.uniform(-1.0, 1.0), int(random.below(200))));
    }
    doubles[5] = NAN;
    doubles[3 * kPoints - 1] = -INFINITY;
    for (std::size_t i = 0; i < kPoints; ++i)
    {
      integers.push_back(std::numeric_limits<std::int64_t>::max() - std::int64_t(random.below(1000)));
      labels.push_back(std::uint8_t(random.below(5)));
    }
  }
};

std::vector<VoxelAccumulator::Array> kindsOfArrays()
{
  return { { ScalarType::Float, 3, AttributeStatistic::Mean },
    { ScalarType::Double, 3, AttributeStatistic::Mean }, { ScalarType::Int64, 1, AttributeStatistic::Mean },
    { ScalarType::UInt8, 1, AttributeStatistic::Mode },
    { ScalarType::UInt8, 1, AttributeStatistic::Median } };
}

/// Views of the arrays of the points from @p first on.
std::vector<AttributeView> viewsOf(const Arrays& arrays, std::size_t first, std::int64_t points)
{
  return { { arrays.floats.data() + 3 * first, ScalarType::Float, 3, points },
    { arrays.doubles.data() + 3 * first, ScalarType::Double, 3, points },
    { arrays.integers.data() + first, ScalarType::Int64, 1, points },
    { arrays.labels.data() + first, ScalarType::UInt8, 1, points },
    { arrays.labels.data() + first, ScalarType::UInt8, 1, points } };
}

/// The bytes of each array.
using Made = std::vector<std::vector<char>>;

Made madeBy(const VoxelResampler& result)
{
  Made made;
  for (std::size_t i = 0; i < kindsOfArrays().size(); ++i)
  {
    const VoxelAccumulator::Array kind = kindsOfArrays()[i];
    const auto* bytes = static_cast<const char*>(result.attribute(i));
    made.emplace_back(bytes, bytes + result.size() * bytesOf(kind.type) * kind.components);
  }
  return made;
}

Made madeOf(const std::vector<Vec3>& points, const Lattice& lattice, const Arrays& arrays,
  const std::vector<std::size_t>& ends)
{
  const int size = int(ends.size()) - 1;
  std::vector<Made> ofRanks(static_cast<std::size_t>(size));
  ThreadJob job(size);
  job.run(
    [&](Ranks& ranks)
    {
      const PointView part = partOf(points, ends, ranks.rank());
      VoxelAccumulator own(lattice, false, kindsOfArrays());
      EXPECT_EQ(own.add(part, viewsOf(arrays, ends[std::size_t(ranks.rank())], part.size())), Status::Ok);
      EXPECT_EQ(shareVoxels(ranks, shareKeys(ranks, own.keys()), own), Status::Ok);
      VoxelResampler made;
      EXPECT_EQ(own.finish({}, made), Status::Ok);
      ofRanks[std::size_t(ranks.rank())] = madeBy(made);
    });
  Made all(kindsOfArrays().size());
  for (const Made& made : ofRanks)
  {
    for (std::size_t i = 0; i < made.size(); ++i)
    {
      append(all[i], made[i]);
    }
  }
  return all;
}

}

TEST(SharedVoxels, AreThoseOfOneRunHoweverPointsAndRanksAreSplit)
{
  for (const Lattice& lattice : { latticeOf(60, 50, 40), latticeOf(1024, 1024, 1024), latticeOf(5000, 3, 2),
         latticeOf(2, 2, 1), latticeOf(1, 1, 1) })
  {
    const std::vector<Vec3> points = cloudOf(lattice);
    const RunResult expected = runOf(requestOf(points, lattice));
    for (const int size : kSizes)
    {
      expectSame(sharedRun(points, lattice, splitOfPoints(size, std::uint64_t(size))), expected,
        nameOf(lattice) + ", ranks " + std::to_string(size));
    }
  }
}

TEST(SharedVoxels, ArraysAreThoseOfOneRun)
{
  const Lattice lattice = latticeOf(12, 11, 10);
  const std::vector<Vec3> points = cloudOf(lattice);
  const Arrays arrays(9);
  VoxelRequest request = requestOf(points, lattice);
  const std::vector<AttributeView> views = viewsOf(arrays, 0, std::int64_t(kPoints));
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    request.attributes.push_back({ views[i], kindsOfArrays()[i].statistic });
  }
  VoxelResampler one;
  ASSERT_EQ(one.run(request), Status::Ok);
  const Made expected = madeBy(one);
  for (const int size : { 1, 2, 3, 4, 8 })
  {
    EXPECT_TRUE(madeOf(points, lattice, arrays, splitOfPoints(size, 77)) == expected) << "ranks " << size;
  }
}

TEST(SharedVoxels, SendInProportionToVoxelsNotToPoints)
{
  const Lattice lattice = latticeOf(10, 10, 10);
  std::vector<std::int64_t> sent;
  for (const std::size_t times : { std::size_t(1), std::size_t(8) })
  {
    const std::vector<Vec3> points = quantisedPoints(times * 20000, 3, lattice);
    ThreadJob job(4);
    job.run(
      [&](Ranks& ranks)
      {
        const std::int64_t share = std::int64_t(points.size()) / 4;
        VoxelAccumulator own(lattice);
        EXPECT_EQ(own.add(PointView(points.data() + share * ranks.rank(), share)), Status::Ok);
        EXPECT_EQ(shareVoxels(ranks, shareKeys(ranks, own.keys()), own), Status::Ok);
      });
    sent.push_back(job.bytesSent());
  }
  EXPECT_LT(double(sent[1]), 1.01 * double(sent[0]));
  // Each rank has all voxels, and sends three quarters of them.
  EXPECT_GT(sent[1], 3 * 1000 * 48);
  EXPECT_LT(sent[1], 3 * 1000 * (48 + 16));
}

TEST(SharedVoxels, RefuseSumsOfAnotherLatticeOnAllRanks)
{
  ThreadJob job(3);
  job.run(
    [&](Ranks& ranks)
    {
      VoxelAccumulator own(latticeOf(4, 4, ranks.rank() == 2 ? 5 : 4));
      EXPECT_EQ(shareVoxels(ranks, shareKeys(ranks, own.keys()), own), Status::InvalidParameter)
        << ranks.rank();
    });
}

TEST(SharedVoxels, RefuseOtherArraysOnAllRanks)
{
  ThreadJob job(3);
  job.run(
    [&](Ranks& ranks)
    {
      const ScalarType type = ranks.rank() == 2 ? ScalarType::Double : ScalarType::Float;
      VoxelAccumulator own(latticeOf(4, 4, 4), false, { { type, 1, AttributeStatistic::Mean } });
      EXPECT_EQ(shareVoxels(ranks, shareKeys(ranks, own.keys()), own), Status::InvalidParameter)
        << ranks.rank();
    });
}
