// Voxels whose points lie on several ranks, against one run over all points.
#include "Core/Distributed/SharedVoxels.h"

#include "RandomClouds.h"
#include "ResamplerRuns.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

constexpr std::size_t kPoints = 6000;
constexpr int kLevels = 3;
const std::vector<int> kSizes = { 1, 2, 3, 4, 8 };

VoxelRequest requestOf(const std::vector<Vec3>& points, const Lattice& lattice, int levels)
{
  VoxelRequest request;
  request.points = { points.data(), std::int64_t(points.size()) };
  request.lattice = lattice;
  request.keys = true;
  request.covariances = true;
  request.levels = levels;
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
  all.levels.resize(part.levels.size());
  for (std::size_t l = 0; l < part.levels.size(); ++l)
  {
    append(all.levels[l].means, part.levels[l].means);
    append(all.levels[l].counts, part.levels[l].counts);
    append(all.levels[l].keys, part.levels[l].keys);
    append(all.levels[l].covariances, part.levels[l].covariances);
  }
}

/// What each rank makes, one after the other.
RunResult sharedRun(
  const std::vector<Vec3>& points, const Lattice& lattice, int levels, const std::vector<std::size_t>& ends)
{
  const int size = int(ends.size()) - 1;
  std::vector<RunResult> results(static_cast<std::size_t>(size));
  ThreadJob job(size);
  job.run(
    [&](Ranks& ranks)
    {
      VoxelAccumulator own(lattice, true);
      EXPECT_EQ(own.add(partOf(points, ends, ranks.rank())), Status::Ok);
      SharedVoxels shared;
      EXPECT_EQ(shared.share(ranks, std::move(own), levels), Status::Ok);
      VoxelAccumulator::Request wanted;
      wanted.keys = true;
      wanted.levels = levels;
      VoxelResampler made;
      EXPECT_EQ(shared.voxels().finish(wanted, made), Status::Ok);
      RunResult& result = results[std::size_t(ranks.rank())];
      result.clipped = shared.clippedPoints();
      result.invalid = shared.invalidPoints();
      for (int level = 0; level < levels; ++level)
      {
        result.levels.push_back(levelOf(made, requestOf(points, lattice, levels), level));
      }
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

/// A tuple of a mean, its bits.
template <typename T>
void expectSameBits(const std::vector<T>& a, const std::vector<T>& b, const std::string& what)
{
  EXPECT_TRUE(sameBits(a, b)) << what;
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

/// One array in the voxels of one part of the points.
void addPart(AttributeReducer& tuples, const std::vector<std::int64_t>& voxels)
{
  for (std::int64_t i = 0; i < std::int64_t(voxels.size()); ++i)
  {
    const std::int64_t voxel = voxels[std::size_t(i)];
    if (voxel >= 0)
    {
      tuples.add(&i, &voxel, 1);
    }
  }
}

std::vector<std::int64_t> voxelsOf(
  const PointView& points, const Lattice& lattice, const std::vector<std::uint64_t>& keys)
{
  std::vector<std::int64_t> voxels;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    std::int64_t voxel = -1;
    if (isFinite(points[i]) && lattice.contains(points[i]))
    {
      const auto index = Lattice::voxelAt(points[i]);
      const std::uint64_t key = lattice.key(index[0], index[1], index[2]);
      voxel = std::lower_bound(keys.begin(), keys.end(), key) - keys.begin();
    }
    voxels.push_back(voxel);
  }
  return voxels;
}

/// What a rank knows when arrays are exchanged.
struct Shared
{
  Ranks& ranks;
  SharedVoxels voxels;
  std::vector<std::int64_t> ownVoxels; ///< Of its points.
  std::vector<std::int64_t> ownCounts; ///< Of the voxels of its points.
  std::vector<std::int64_t> counts;    ///< Of its range.
  std::int64_t mostPoints = 0;
};

std::vector<std::int64_t> countsOf(const std::vector<std::int64_t>& voxels, std::size_t size)
{
  std::vector<std::int64_t> counts(size, 0);
  for (const std::int64_t voxel : voxels)
  {
    if (voxel >= 0)
    {
      ++counts[std::size_t(voxel)];
    }
  }
  return counts;
}

Shared shareOf(Ranks& ranks, const PointView& part, const Lattice& lattice)
{
  Shared shared{ ranks, {}, {}, {}, {}, 0 };
  VoxelAccumulator own(lattice);
  EXPECT_EQ(own.add(part), Status::Ok);
  const std::vector<std::uint64_t> keys = own.keys();
  EXPECT_EQ(shared.voxels.share(ranks, std::move(own)), Status::Ok);
  shared.ownVoxels = voxelsOf(part, lattice, keys);
  shared.ownCounts = countsOf(shared.ownVoxels, keys.size());
  VoxelResampler made;
  EXPECT_EQ(shared.voxels.voxels().finish({}, made), Status::Ok);
  shared.counts.assign(made.counts(), made.counts() + made.size());
  shared.mostPoints =
    ranks.reduce(made.mostPoints(), [](std::int64_t a, std::int64_t b) { return std::max(a, b); });
  return shared;
}

template <typename T>
std::vector<T> meansOf(Shared& shared, const std::vector<T>& values, int components, std::size_t first)
{
  AttributeView view{ values.data() + first * std::size_t(components),
    std::is_same_v<T, float>      ? ScalarType::Float
      : std::is_same_v<T, double> ? ScalarType::Double
                                  : ScalarType::Int64,
    components, std::int64_t(shared.ownVoxels.size()) };
  const AttributeRange range = commonRange(shared.ranks, rangeOf(view, Executor()));
  AttributeMean own(view, range);
  own.prepare(nullptr, std::int64_t(shared.ownCounts.size()), shared.mostPoints, {});
  addPart(own, shared.ownVoxels);
  AttributeMean merged(view, range);
  merged.prepare(nullptr, std::int64_t(shared.counts.size()), shared.mostPoints, {});
  EXPECT_TRUE(shared.voxels.exchange(shared.ranks, own, merged));
  std::vector<T> means(shared.counts.size() * std::size_t(components));
  merged.write(shared.counts.data(), means.data(), {}, nullptr);
  return means;
}

std::vector<std::uint8_t> labelsOf(
  Shared& shared, const std::vector<std::uint8_t>& values, AttributeStatistic statistic, std::size_t first)
{
  const AttributeView view{ values.data() + first, ScalarType::UInt8, 1,
    std::int64_t(shared.ownVoxels.size()) };
  AttributeTuples own(view, statistic);
  own.prepare(shared.ownCounts.data(), std::int64_t(shared.ownCounts.size()), 0, {});
  addPart(own, shared.ownVoxels);
  AttributeTuples merged(view, statistic);
  merged.prepare(shared.counts.data(), std::int64_t(shared.counts.size()), 0, {});
  EXPECT_TRUE(shared.voxels.exchange(shared.ranks, own, merged));
  std::vector<std::uint8_t> labels(shared.counts.size());
  EXPECT_TRUE(merged.write(nullptr, labels.data(), Executor(), nullptr));
  return labels;
}

struct Made
{
  std::vector<float> floats;
  std::vector<double> doubles;
  std::vector<std::int64_t> integers;
  std::vector<std::uint8_t> modes;
  std::vector<std::uint8_t> medians;
};

Made madeOf(const std::vector<Vec3>& points, const Lattice& lattice, const Arrays& arrays,
  const std::vector<std::size_t>& ends)
{
  const int size = int(ends.size()) - 1;
  std::vector<Made> ofRanks(static_cast<std::size_t>(size));
  ThreadJob job(size);
  job.run(
    [&](Ranks& ranks)
    {
      Shared shared = shareOf(ranks, partOf(points, ends, ranks.rank()), lattice);
      const std::size_t first = ends[std::size_t(ranks.rank())];
      Made& made = ofRanks[std::size_t(ranks.rank())];
      made.floats = meansOf(shared, arrays.floats, 3, first);
      made.doubles = meansOf(shared, arrays.doubles, 3, first);
      made.integers = meansOf(shared, arrays.integers, 1, first);
      made.modes = labelsOf(shared, arrays.labels, AttributeStatistic::Mode, first);
      made.medians = labelsOf(shared, arrays.labels, AttributeStatistic::Median, first);
    });
  Made all;
  for (const Made& made : ofRanks)
  {
    append(all.floats, made.floats);
    append(all.doubles, made.doubles);
    append(all.integers, made.integers);
    append(all.modes, made.modes);
    append(all.medians, made.medians);
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
    for (const int levels : { 1, kLevels })
    {
      RunResult expected = runOf(requestOf(points, lattice, levels));
      for (LevelResult& level : expected.levels)
      {
        level.parents.clear();
      }
      for (const int size : kSizes)
      {
        expectSame(sharedRun(points, lattice, levels, splitOfPoints(size, std::uint64_t(size))), expected,
          nameOf(lattice) + ", ranks " + std::to_string(size) + ", levels " + std::to_string(levels));
      }
    }
  }
}

TEST(SharedVoxels, ArraysAreThoseOfOneRank)
{
  const Lattice lattice = latticeOf(12, 11, 10);
  const std::vector<Vec3> points = cloudOf(lattice);
  const Arrays arrays(9);
  const Made expected = madeOf(points, lattice, arrays, { 0, kPoints });
  ASSERT_TRUE(std::any_of(expected.doubles.begin(), expected.doubles.end(), [](double v) { return v != v; }));
  for (const int size : { 2, 3, 4, 8 })
  {
    const Made made = madeOf(points, lattice, arrays, splitOfPoints(size, 77));
    const std::string what = "ranks " + std::to_string(size);
    expectSameBits(made.floats, expected.floats, "floats, " + what);
    expectSameBits(made.doubles, expected.doubles, "doubles, " + what);
    expectSameBits(made.integers, expected.integers, "integers, " + what);
    expectSameBits(made.modes, expected.modes, "modes, " + what);
    expectSameBits(made.medians, expected.medians, "medians, " + what);
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
        SharedVoxels shared;
        EXPECT_EQ(shared.share(ranks, std::move(own)), Status::Ok);
      });
    sent.push_back(job.bytesSent());
  }
  EXPECT_LT(double(sent[1]), 1.01 * double(sent[0]));
  // Each rank has all voxels, and sends three quarters of them.
  EXPECT_GT(sent[1], 3 * 1000 * 64);
  EXPECT_LT(sent[1], 3 * 1000 * (64 + 32));
}

TEST(SharedVoxels, RefuseSumsOfAnotherLatticeOnAllRanks)
{
  ThreadJob job(3);
  job.run(
    [&](Ranks& ranks)
    {
      VoxelAccumulator own(latticeOf(4, 4, ranks.rank() == 2 ? 5 : 4));
      SharedVoxels shared;
      EXPECT_EQ(shared.share(ranks, std::move(own)), Status::InvalidParameter) << ranks.rank();
    });
}

TEST(SharedVoxels, RefuseSumsOfArraysThatAreNotTheirs)
{
  const std::vector<float> values = { 1.f, 2.f };
  const AttributeView view{ values.data(), ScalarType::Float, 1, 2 };
  AttributeMean mean(view, Executor());
  mean.prepare(nullptr, 2, 2, {});
  std::string bytes;
  mean.serialize(0, 2, bytes);
  EXPECT_TRUE(mean.merge(bytes, { 0, 1 }));
  EXPECT_FALSE(mean.merge(bytes, { 0 }));
  EXPECT_FALSE(mean.merge(bytes + "x", { 0, 1 }));
  const std::int64_t counts[2] = { 1, 1 };
  const std::int64_t voxels[2] = { 0, 1 };
  AttributeTuples tuples(view);
  tuples.prepare(counts, 2, 0, {});
  tuples.add(voxels, voxels, 2);
  bytes.clear();
  tuples.serialize(0, 2, bytes);
  AttributeTuples other(view);
  other.prepare(counts, 2, 0, {});
  EXPECT_FALSE(other.merge(bytes.substr(0, bytes.size() - 1), { 0, 1 }));
  other.prepare(counts, 2, 0, {});
  EXPECT_FALSE(other.merge(bytes + bytes, { 0, 1, 0, 1 })); // more than there is room for
  other.prepare(counts, 2, 0, {});
  EXPECT_TRUE(other.merge(bytes, { 0, 1 }));
}

TEST(SharedVoxels, SumsOfRanksWithFewPointsAndWithManyFit)
{
  // 53 bits and 33 more, in two parts: how they are cut depends on the most points of a voxel alone.
  const std::vector<double> values = { 0x1p33, 1.0 + 0x1p-52 };
  AttributeView few{ values.data(), ScalarType::Double, 1, 2 };
  AttributeView many = few;
  many.tuples = 10000000; // of which two are added
  const AttributeRange range = rangeOf(few, Executor());
  const std::int64_t points[2] = { 0, 1 };
  const std::int64_t voxels[2] = { 0, 0 };
  AttributeMean own(many, range);
  own.prepare(nullptr, 1, 4, {});
  own.add(points, voxels, 2);
  std::string bytes;
  own.serialize(0, 1, bytes);
  AttributeMean merged(few, range);
  merged.prepare(nullptr, 1, 4, {});
  ASSERT_TRUE(merged.merge(bytes, { 0 }));
  double mean = 0.0;
  merged.mean(0, 2, &mean);
  EXPECT_EQ(mean, (0x1p33 + 1.0) / 2);
}
