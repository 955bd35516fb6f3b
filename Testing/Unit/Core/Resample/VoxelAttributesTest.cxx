// VoxelResampler's attributes: whichever pass reduces them, they are what the points of each voxel give.
#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResampler.h"

#include "AttributePlans.h"
#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

/// Arrays of all kinds of sums: one word, several parts, halves of 64 bits, not finite.
struct Arrays
{
  std::vector<std::array<std::uint8_t, 3>> colors;
  std::vector<std::array<float, 3>> normals;
  std::vector<double> wide; ///< Magnitudes that differ by far more than 2^50.
  std::vector<std::int64_t> integers;
  std::vector<float> withNaN;
  std::vector<std::int16_t> labels;
  std::vector<std::array<std::int16_t, 3>> turned;
  std::vector<std::array<double, 9>> tensors; ///< Rows too wide to be binned.

  Arrays(std::size_t points, std::uint64_t seed)
  {
    Random random(seed);
    for (std::size_t i = 0; i < points; ++i)
    {
      const Vec3 n = random.direction();
      colors.push_back({ std::uint8_t(random.below(256)), std::uint8_t(random.below(256)),
        std::uint8_t(random.below(256)) });
      normals.push_back({ float(n.x), float(n.y), float(n.z) });
      wide.push_back(std::ldexp(random.uniform(-1, 1), int(random.below(300)) - 150));
      integers.push_back(std::int64_t(random.below(std::size_t(1) << 62)) - (std::int64_t(1) << 61));
      withNaN.push_back(random.below(50) == 0 ? std::numeric_limits<float>::quiet_NaN() : float(n.x));
      labels.push_back(std::int16_t(random.below(4)));
      turned.push_back({ std::int16_t(3e4 * n.x), std::int16_t(3e4 * n.y), std::int16_t(3e4 * n.z) });
      tensors.emplace_back();
      std::generate(tensors.back().begin(), tensors.back().end(), [&] { return random.uniform(-1, 1); });
    }
  }
  std::vector<AttributeRequest> sums() const
  {
    const auto n = std::int64_t(labels.size());
    return { { { colors.data(), ScalarType::UInt8, 3, n } },
      { { normals.data(), ScalarType::Float, 3, n }, AttributeStatistic::Normal },
      { { wide.data(), ScalarType::Double, 1, n } }, { { integers.data(), ScalarType::Int64, 1, n } },
      { { withNaN.data(), ScalarType::Float, 1, n } },
      { { turned.data(), ScalarType::Int16, 3, n }, AttributeStatistic::Normal } };
  }
  AttributeRequest label(AttributeStatistic statistic) const
  {
    return { { labels.data(), ScalarType::Int16, 1, std::int64_t(labels.size()) }, statistic };
  }
  AttributeRequest tensor() const
  {
    return { { tensors.data(), ScalarType::Double, 9, std::int64_t(tensors.size()) } };
  }
};

using Tuples = std::vector<char>;

std::vector<Tuples> attributesOf(const VoxelResampler& resampler, const VoxelRequest& request)
{
  std::vector<Tuples> all;
  for (std::size_t i = 0; i < request.attributes.size(); ++i)
  {
    const auto* const tuples = static_cast<const char*>(resampler.attribute(i));
    all.emplace_back(tuples, tuples + resampler.size() * request.attributes[i].view.tupleBytes());
  }
  return all;
}

/// Expected result of the reducers, point by point.
std::vector<Tuples> expectedOf(const VoxelRequest& request)
{
  VoxelRequest plain;
  plain.points = request.points;
  plain.lattice = request.lattice;
  plain.transform = request.transform;
  plain.voxelIndex = true;
  VoxelResampler resampler;
  EXPECT_EQ(resampler.run(plain), Status::Ok);
  // The tuples of points in voxels, as many apart as they are.
  Plan plan;
  plan.size = resampler.size();
  plan.voxels = resampler.voxelIndex();
  std::vector<Tuples> all;
  for (const AttributeRequest& attribute : request.attributes)
  {
    all.push_back(reducedTuples(attribute, plan, { InstructionSet::Baseline, request.transform }));
  }
  return all;
}

void expectAttributes(VoxelRequest request, const Executor& executor, const std::string& what)
{
  const std::vector<Tuples> expected = expectedOf(request);
  // One chunk, as many as are kept, more.
  for (const std::int64_t chunkPoints : { 0, 1700, 170 })
  {
    for (const InstructionSet set :
      { InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Automatic })
    {
      request.chunkPoints = chunkPoints;
      request.instructions = set;
      VoxelResampler resampler;
      for (int round = 0; round < 2; ++round)
      {
        ASSERT_EQ(resampler.run(request, executor), Status::Ok);
        EXPECT_EQ(attributesOf(resampler, request), expected) << what << ", chunks of " << chunkPoints;
      }
    }
  }
}

} // namespace

TEST(VoxelAttributes, AreThoseOfThePointsOfEachVoxelOnEveryPath)
{
  constexpr std::size_t kPoints = 6000;
  const Arrays arrays(kPoints, 1);
  for (const Lattice& lattice : latticesOfAllPaths())
  {
    std::vector<Vec3> points = quantisedPoints(kPoints, 2, lattice);
    points[7].y = NAN;
    VoxelRequest request;
    request.points = { points.data(), std::int64_t(kPoints) };
    request.lattice = lattice;
    request.attributes = arrays.sums();
    expectAttributes(request, {}, nameOf(lattice) + ", sums");
    request.attributes = { arrays.tensor() };
    expectAttributes(request, ThreadedExecutor(3), nameOf(lattice) + ", wide rows");
    request.attributes = arrays.sums();
    request.attributes.push_back(arrays.label(AttributeStatistic::Mode));
    request.attributes.push_back(arrays.label(AttributeStatistic::Median));
    expectAttributes(request, BackwardExecutor(5), nameOf(lattice) + ", with labels");
  }
}

TEST(VoxelAttributes, ComeWithAnIndexAndATransformAsWithout)
{
  constexpr std::size_t kPoints = 9000;
  const Arrays arrays(kPoints, 3);
  const std::vector<Vec3> points = randomBox(kPoints, 4, { -1, -1, -1 }, { 1, 1, 1 });
  VoxelRequest request;
  request.points = { points.data(), std::int64_t(kPoints) };
  request.lattice = latticeOf(40, 50, 60);
  request.transform = AffineTransform::rotation(40, { 1, 2, 3 }) * AffineTransform::scaling({ 45, 50, 55 });
  request.attributes = arrays.sums();
  const std::vector<Tuples> expected = expectedOf(request);
  PointIndex index;
  ASSERT_EQ(index.build(request.points), Status::Ok);
  request.index = &index;
  for (const std::int64_t chunkPoints : { std::int64_t(0), std::int64_t(500) })
  {
    request.chunkPoints = chunkPoints;
    VoxelResampler resampler;
    ASSERT_EQ(resampler.run(request, ThreadedExecutor(2)), Status::Ok);
    EXPECT_EQ(attributesOf(resampler, request), expected);
  }
}

TEST(VoxelAttributes, ComeWithRepresentativesAndTheVoxelsOfPointsAsWithout)
{
  constexpr std::size_t kPoints = 4000;
  const Arrays arrays(kPoints, 9);
  const std::vector<Vec3> points = randomBox(kPoints, 10, { 0, 0, 0 }, { 20, 20, 20 });
  VoxelRequest request;
  request.points = { points.data(), std::int64_t(kPoints) };
  request.lattice = latticeOf(20, 20, 20);
  request.attributes = arrays.sums();
  request.attributes.push_back(arrays.label(AttributeStatistic::Mode));
  const std::vector<Tuples> expected = expectedOf(request);
  request.voxelIndex = true;
  for (const Representative representative : { Representative::Mean, Representative::NearestToMean,
         Representative::NearestToCenter, Representative::Median })
  {
    request.representative = representative;
    // One chunk, as many as are kept, more.
    for (const std::int64_t chunkPoints : { 0, 500, 100 })
    {
      request.chunkPoints = chunkPoints;
      VoxelResampler resampler;
      ASSERT_EQ(resampler.run(request, BackwardExecutor(3)), Status::Ok);
      EXPECT_EQ(attributesOf(resampler, request), expected);
      for (std::size_t v = 0; v < resampler.chosenPoints().size(); ++v)
      {
        ASSERT_EQ(resampler.voxelIndex()[std::size_t(resampler.chosenPoints()[v])], std::int64_t(v));
      }
    }
  }
}

TEST(VoxelAttributes, OfACrowdNeedMorePartsAsPointsCome)
{
  // 53 bits each: a word holds sums of 1023 of them, more than the first chunks have in a voxel.
  constexpr std::size_t kPoints = 5000;
  std::vector<Vec3> points = randomBox(kPoints, 5, { 0, 0, 0 }, { 8, 8, 8 });
  std::vector<double> values(kPoints);
  Random random(6);
  for (std::size_t i = 0; i < kPoints; ++i)
  {
    // At first a point or two a voxel, then thousands in one.
    points[i] = i < 300 ? points[i] : Vec3(3.25, 3.5, 3.75);
    values[i] = (i % 3 == 0 ? -1.0 : 1.0) * random.uniform(0.25, 0.5);
  }
  VoxelRequest request;
  request.points = { points.data(), std::int64_t(kPoints) };
  request.lattice = latticeOf(8, 8, 8);
  request.attributes = { { { values.data(), ScalarType::Double, 1, std::int64_t(kPoints) } } };
  const std::vector<Tuples> expected = expectedOf(request);
  for (const std::int64_t chunkPoints : { 250, 600, 5000, 0 })
  {
    request.chunkPoints = chunkPoints;
    VoxelResampler resampler;
    ASSERT_EQ(resampler.run(request), Status::Ok);
    EXPECT_EQ(attributesOf(resampler, request), expected) << "chunks of " << chunkPoints;
  }
}

TEST(VoxelAttributes, AreTheSameInTheOrderOfAScan)
{
  // Tuples go with points in no order, and are read where they lie in that of a scan.
  constexpr std::size_t kPoints = 6000;
  std::vector<Vec3> points = randomBox(kPoints, 16, { 0, 0, 0 }, { 30, 31, 32 });
  const Arrays arrays(kPoints, 17);
  for (const bool isScan : { false, true })
  {
    if (isScan)
    {
      std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
    }
    VoxelRequest request;
    request.points = { points.data(), std::int64_t(kPoints) };
    request.lattice = latticeOf(30, 31, 32);
    const std::vector<AttributeRequest> sums = arrays.sums();
    // The last one has no room beside the others.
    for (const std::size_t count : { std::size_t(1), std::size_t(2), sums.size() })
    {
      request.attributes.assign(sums.begin(), sums.begin() + std::ptrdiff_t(count));
      request.attributes.push_back(
        { { arrays.labels.data(), ScalarType::Int16, 1, std::int64_t(kPoints) }, AttributeStatistic::Mode });
      VoxelResampler resampler;
      ASSERT_EQ(resampler.run(request, ThreadedExecutor(2)), Status::Ok);
      EXPECT_EQ(attributesOf(resampler, request), expectedOf(request)) << isScan << ", " << count;
      request.chunkPoints = 1000;
      ASSERT_EQ(resampler.run(request), Status::Ok);
      EXPECT_EQ(attributesOf(resampler, request), expectedOf(request)) << "in chunks";
      request.chunkPoints = 0;
    }
  }
}

namespace
{

/// Memory for so many voxels, and no more.
class TightAllocator final : public OutputAllocator
{
public:
  explicit TightAllocator(std::int64_t voxels)
    : voxels_(std::size_t(voxels))
  {
  }
  void* allocate(std::size_t part, std::size_t bytes) override
  {
    const std::size_t ofVoxel = part == Means ? sizeof(Vec3)
      : part == Counts                        ? sizeof(std::int64_t)
                                              : sizeof(float);
    if (bytes > voxels_ * ofVoxel)
    {
      ++refusals;
      throw std::bad_alloc();
    }
    memory_[part].resize(bytes);
    return memory_[part].data();
  }
  int refusals = 0;

private:
  std::size_t voxels_;
  std::array<std::vector<char>, Attributes + 1> memory_;
};

}

TEST(VoxelAttributes, TakeNoMoreMemoryThanThereIs)
{
  // Room for as many voxels as points is refused; voxels are counted then.
  constexpr std::size_t kPoints = 20000;
  const std::vector<Vec3> points = randomBox(kPoints, 18, { 0, 0, 0 }, { 3, 30, 30 });
  const std::vector<float> values(kPoints, 1.5f);
  for (const std::int64_t columns : { std::int64_t(4), std::int64_t(4096) }) // dense partitions, sparse ones
  {
    VoxelRequest request;
    request.points = { points.data(), std::int64_t(kPoints) };
    request.lattice = latticeOf(columns, 60, 60);
    request.chunkPoints = 5000;
    VoxelResampler plain;
    const std::vector<double> means = runOf(plain, request).voxels.means;
    VoxelResampler resampler;
    for (const bool hasArray : { false, true })
    {
      request.attributes.clear();
      if (hasArray)
      {
        request.attributes.push_back({ { values.data(), ScalarType::Float, 1, std::int64_t(kPoints) } });
      }
      TightAllocator tight(plain.size());
      request.allocator = &tight;
      EXPECT_EQ(runOf(resampler, request, ThreadedExecutor(2)).voxels.means, means) << columns;
      EXPECT_EQ(tight.refusals, 1) << columns;
      EXPECT_EQ(attributesOf(resampler, request), expectedOf(request)) << columns;
      TightAllocator exact(plain.size());
      VoxelRequest inParts = request;
      inParts.allocator = &exact;
      inParts.chunkPoints = 3000; // Sums are merged: the voxels are counted anyway.
      EXPECT_EQ(runOf(resampler, inParts, ThreadedExecutor(2)).voxels.means, means) << columns;
      EXPECT_EQ(exact.refusals, 0) << columns;
      TightAllocator tooTight(plain.size() - 1);
      request.allocator = &tooTight;
      EXPECT_THROW(static_cast<void>(resampler.run(request)), std::bad_alloc);
      request.allocator = nullptr;
      EXPECT_EQ(runOf(resampler, request).voxels.means, means) << "after too little memory";
    }
  }
}

TEST(VoxelAttributes, AreRightAfterMemoryRanOutAmongTheSums)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take so large a request for an error";
#endif
  // Tuples that no memory holds, for whose result there is room all the same.
  class Boundless final : public OutputAllocator
  {
  public:
    void* allocate(std::size_t part, std::size_t) override { return part < Attributes ? nullptr : &memory_; }

  private:
    char memory_ = 0;
  };
  constexpr std::size_t kPoints = 3000;
  const std::vector<Vec3> first = randomBox(kPoints, 19, { 0, 0, 0 }, { 15, 30, 30 });
  const std::vector<Vec3> second = randomBox(kPoints, 20, { 15, 0, 0 }, { 30, 30, 30 });
  VoxelRequest request;
  request.points = { first.data(), std::int64_t(kPoints) };
  request.lattice = latticeOf(30, 30, 30);
  Boundless boundless;
  request.allocator = &boundless;
  request.attributes = { { { first.data(), ScalarType::Double, 1 << 30, std::int64_t(kPoints), sizeof(Vec3) },
    AttributeStatistic::Mode } };
  VoxelResampler resampler;
  EXPECT_THROW(static_cast<void>(resampler.run(request)), std::bad_alloc);
  request.allocator = nullptr;
  request.attributes.clear();
  request.points = { second.data(), std::int64_t(kPoints) };
  VoxelResampler fresh;
  expectSame(runOf(resampler, request), runOf(fresh, request), "after memory ran out");
}

TEST(VoxelAttributes, HaveComponentsAndNormalsThree)
{
  const std::vector<Vec3> points = randomBox(10, 21, { 0, 0, 0 }, { 3, 3, 3 });
  VoxelRequest request;
  request.points = { points.data(), 10 };
  request.lattice = latticeOf(3, 3, 3);
  VoxelResampler resampler;
  for (const auto statistic : { AttributeStatistic::Mean, AttributeStatistic::Normal })
  {
    const int wrong = statistic == AttributeStatistic::Mean ? 0 : 2;
    request.attributes = { { { points.data(), ScalarType::Double, wrong, 10 }, statistic } };
    EXPECT_EQ(resampler.run(request), Status::InvalidParameter) << wrong;
    request.attributes[0].view.components = 3;
    EXPECT_EQ(resampler.run(request), Status::Ok);
  }
}

TEST(VoxelAttributes, LeaveTheSumsOfAnOverfullCellAsTheyAre)
{
  // 9 of 10 points in one voxel: more than the 2^21 whose coordinates a sum of 64 bits holds.
  constexpr std::size_t kPoints = 2400000;
  std::vector<Vec3> points = randomBox(kPoints, 15, { 0, 0, 0 }, { 8, 8, 8 });
  std::vector<float> values(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i)
  {
    points[i] = i % 10 == 0 ? points[i] : Vec3(3, 4, 7) + 0.124 * points[i];
    values[i] = float(i % 7);
  }
  VoxelRequest request;
  request.points = { points.data(), std::int64_t(kPoints) };
  request.lattice = latticeOf(8, 8, 8);
  request.covariances = true;
  VoxelResampler plain;
  ASSERT_EQ(plain.run(request), Status::Ok);
  ASSERT_GT(*std::max_element(plain.counts(), plain.counts() + plain.size()), std::int64_t(1) << 21);
  request.attributes = { { { values.data(), ScalarType::Float, 1, std::int64_t(kPoints) } } };
  request.voxelIndex = true;
  VoxelResampler resampler;
  ASSERT_EQ(resampler.run(request, ThreadedExecutor(2)), Status::Ok);
  ASSERT_EQ(resampler.size(), plain.size());
  const auto voxels = std::size_t(plain.size());
  const auto resultsOf = [&](const VoxelResampler& from)
  {
    std::vector<double> results(from.doubles(), from.doubles() + 3 * voxels);
    results.insert(results.end(), &from.covariances()->xx, &from.covariances()->xx + 6 * voxels);
    return results;
  };
  EXPECT_EQ(resultsOf(resampler), resultsOf(plain));
  EXPECT_TRUE(std::equal(plain.counts(), plain.counts() + voxels, resampler.counts()));
  std::vector<std::int64_t> indexed(voxels, 0);
  for (const std::int64_t voxel : resampler.voxelIndex())
  {
    ++indexed[std::size_t(voxel)];
  }
  EXPECT_TRUE(std::equal(indexed.begin(), indexed.end(), plain.counts()));
  EXPECT_EQ(attributesOf(resampler, request), expectedOf(request));
}

TEST(VoxelAttributes, OfFewerTuplesThanPointsAreRefused)
{
  const std::vector<Vec3> points(10, Vec3(0.5, 0.5, 0.5));
  const std::vector<float> values(9);
  VoxelRequest request;
  request.points = { points.data(), 10 };
  request.attributes = { { { values.data(), ScalarType::Float, 1, 9 } } };
  VoxelResampler resampler;
  EXPECT_EQ(resampler.run(request), Status::InvalidParameter);
  EXPECT_EQ(resampler.size(), 0);
}
