// The points that stand for voxels, and the voxel of each point.
#include "Core/Neighbors/PointIndex.h"
#include "Core/Reference/ReferenceVoxelMean.h"
#include "Core/Resample/VoxelResampler.h"

#include "CountingObserver.h"
#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

constexpr std::size_t kCloudPoints = 6000;
constexpr Representative kNearest[] = { Representative::NearestToMean, Representative::NearestToCenter };
constexpr Representative kAll[] = { Representative::NearestToMean, Representative::NearestToCenter,
  Representative::Median };

/// Points on eighths of voxels, many of them twice or thrice, and a value of few kinds for each. Voxels have
/// from one to thousands.
struct Cloud
{
  explicit Cloud(const Lattice& lattice, std::uint64_t seed = 1)
  {
    Random random(seed);
    Vec3 extent;
    for (int axis = 0; axis < 3; ++axis)
    {
      extent[axis] = std::min(double(lattice.dimensions[std::size_t(axis)]), 9.0);
    }
    while (points.size() < kCloudPoints)
    {
      const Vec3 p = random.inBox({ -0.3, -0.3, -0.3 }, extent + Vec3(0.3, 0.3, 0.3));
      points.push_back(0.125 * Vec3(std::floor(8 * p.x), std::floor(8 * p.y), std::floor(8 * p.z)));
      points.insert(points.end(), random.below(3), points.back());
    }
    points.resize(kCloudPoints);
    points[17].y = NAN;
    for (std::size_t i = 0; i < kCloudPoints; ++i)
    {
      values.push_back(int(random.below(3)) - 1);
    }
  }

  VoxelRequest request(const Lattice& lattice, Representative representative) const
  {
    VoxelRequest request;
    request.points = { points.data(), std::int64_t(points.size()) };
    request.lattice = lattice;
    request.keys = true;
    request.covariances = true;
    request.representative = representative;
    request.tieBreakers = { { values.data(), ScalarType::Int32, 1, std::int64_t(values.size()) } };
    request.voxelIndex = true;
    return request;
  }

  std::vector<Vec3> points;
  std::vector<int> values;
};

struct Chosen
{
  std::vector<double> places;
  std::vector<std::int64_t> points;
  std::vector<std::int64_t> index;
  std::vector<std::int64_t> counts;
};

Chosen chosenBy(const VoxelRequest& request, const Executor& executor = {})
{
  VoxelResampler resampler;
  const RunResult result = runOf(resampler, request, executor);
  const VoxelResult& level = result.voxels;
  std::vector<double> places = level.means;
  places.insert(places.end(), level.floats.begin(), level.floats.end());
  return { places, resampler.chosenPoints(), resampler.voxelIndex(), level.counts };
}

void expectSameChoice(const Chosen& found, const Chosen& expected, const std::string& what)
{
  EXPECT_TRUE(sameBits(found.places, expected.places)) << what;
  EXPECT_EQ(found.points, expected.points) << what;
  EXPECT_EQ(found.index, expected.index) << what;
  EXPECT_EQ(found.counts, expected.counts) << what;
}

/// All paths: cells side by side, sorted records, any lattice, few voxels.
std::vector<Lattice> lattices()
{
  return { latticeOf(300, 300, 300), latticeOf(9, 7, 5), latticeOf(1024, 1024, 1024), latticeOf(5000, 3, 2),
    latticeOf(2, 2, 1), latticeOf(1, 1, 1) };
}

Vec3 centerOf(const Lattice& lattice, std::uint64_t key)
{
  const auto index = lattice.indexOf(key);
  return lattice.origin + Vec3(double(index[0]) + 0.5, double(index[1]) + 0.5, double(index[2]) + 0.5);
}

void expectOracle(const Cloud& cloud, const VoxelRequest& request, const Chosen& found)
{
  const reference::VoxelMap expected =
    reference::voxelMeans(request.points, request.transform, request.lattice);
  ASSERT_EQ(found.counts.size(), expected.voxels.size());
  std::vector<std::int64_t> index(cloud.points.size(), -1);
  std::size_t v = 0;
  for (const auto& [key, voxel] : expected.voxels)
  {
    for (const std::int64_t member : voxel.members)
    {
      index[std::size_t(member)] = std::int64_t(v);
    }
    if (request.representative == Representative::Median)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_EQ(found.places[3 * v + std::size_t(axis)],
          reference::medianOf(request.points, request.transform, voxel, axis));
      }
    }
    else if (request.representative != Representative::Mean)
    {
      const Vec3 center = centerOf(request.lattice, key);
      const bool toCenter = request.representative == Representative::NearestToCenter;
      const std::int64_t nearest = reference::nearestMember(
        request.points, request.transform, voxel, toCenter ? &center : nullptr, cloud.values);
      ASSERT_EQ(found.points[v], nearest) << "voxel " << v << " of " << voxel.members.size() << " points";
      ASSERT_EQ(found.places[3 * v], request.transform.apply(cloud.points[std::size_t(nearest)]).x);
    }
    ++v;
  }
  EXPECT_EQ(found.index, index);
}

} // namespace

TEST(VoxelRepresentative, IsTheOraclesOnEveryPath)
{
  for (const Lattice& lattice : lattices())
  {
    const Cloud cloud(lattice);
    for (const Representative representative : kAll)
    {
      SCOPED_TRACE(nameOf(lattice) + ", representative " + std::to_string(int(representative)));
      const VoxelRequest request = cloud.request(lattice, representative);
      expectOracle(cloud, request, chosenBy(request));
    }
  }
}

/// Points about as far from the centres of their voxels: within @p steps of @p step.
Cloud nearlyEqual(const Lattice& lattice, std::size_t steps, double step)
{
  Cloud cloud(lattice);
  Random random(17);
  for (Vec3& point : cloud.points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      point[axis] = double(random.below(std::size_t(lattice.dimensions[std::size_t(axis)]))) + 0.5;
    }
    const double sign = random.below(2) == 0 ? -1.0 : 1.0;
    point[int(random.below(3))] += sign * (0.25 + step * double(random.below(steps)));
  }
  return cloud;
}

TEST(VoxelRepresentative, IsTheOraclesWhereDistancesAreNearlyEqual)
{
  const Lattice lattice = latticeOf(9, 9, 9);
  // Distances are exact where their squares fit a double.
  for (const double step : { 0x1p-22, 0x1p-20, 0x1p-18 })
  {
    const Cloud cloud = nearlyEqual(lattice, 8, step);
    for (const Representative representative : kNearest)
    {
      SCOPED_TRACE("steps of " + std::to_string(step));
      const VoxelRequest request = cloud.request(lattice, representative);
      expectOracle(cloud, request, chosenBy(request));
    }
  }
}

/// So far away that doubles there keep less of a point than its record has: the place in the lattice decides.
TEST(VoxelRepresentative, IsTheSameWhereCoordinatesAreRounded)
{
  Lattice lattice = latticeOf(9, 9, 9);
  const Cloud cloud = nearlyEqual(lattice, 8, 0x1p-18);
  for (const Representative representative : kNearest)
  {
    VoxelRequest request = cloud.request(lattice, representative);
    const Chosen expected = chosenBy(request);
    request.lattice.origin = { 0x1p36, 0x1p36, 0x1p36 };
    request.transform = AffineTransform::translation(request.lattice.origin);
    EXPECT_EQ(chosenBy(request).points, expected.points);
  }
}

/// A transform that doubles can follow exactly.
TEST(VoxelRepresentative, OfPointsThatAreMovedIsThatOfPointsThatLieThere)
{
  const AffineTransform transform =
    AffineTransform::translation({ 0.5, -0.25, 1.0 }) * AffineTransform::scaling({ 0.5, 2.0, 1.0 });
  for (const Lattice& lattice : lattices())
  {
    const Cloud cloud(lattice);
    Cloud there = cloud;
    for (Vec3& point : there.points)
    {
      point = transform.apply(point);
    }
    for (const Representative representative : kAll)
    {
      VoxelRequest request = cloud.request(lattice, representative);
      request.transform = transform;
      expectSameChoice(chosenBy(request), chosenBy(there.request(lattice, representative)),
        nameOf(lattice) + ", representative " + std::to_string(int(representative)));
    }
  }
}

TEST(VoxelRepresentative, IsTheSameForEveryExecutorInstructionSetChunkAndIndex)
{
  for (const Lattice& lattice : lattices())
  {
    const Cloud cloud(lattice);
    for (const Representative representative : kAll)
    {
      VoxelRequest request = cloud.request(lattice, representative);
      request.transform = AffineTransform::translation({ 0.01, 0.02, 0.03 }) *
        AffineTransform::rotation(20, { 1, 2, 3 }) * AffineTransform::scaling({ 0.9, 1.1, 0.7 });
      const Chosen expected = chosenBy(request);
      const std::string what = nameOf(lattice) + ", representative " + std::to_string(int(representative));
      expectSameChoice(chosenBy(request, ThreadedExecutor(3)), expected, what + ", threads");
      expectSameChoice(chosenBy(request, BackwardExecutor(7)), expected, what + ", backward");
      for (const InstructionSet set : heldInstructionSets())
      {
        request.instructions = set;
        expectSameChoice(chosenBy(request, ThreadedExecutor(2)), expected, what + ", instruction set");
      }
      request.chunkPoints = 1100;
      expectSameChoice(chosenBy(request, ThreadedExecutor(2)), expected, what + ", chunks");
      PointIndex index;
      ASSERT_EQ(index.build(request.points), Status::Ok);
      request.index = &index;
      expectSameChoice(chosenBy(request), expected, what + ", chunks and an index");
      request.chunkPoints = 0;
      expectSameChoice(chosenBy(request), expected, what + ", an index");
    }
  }
}

TEST(VoxelRepresentative, IsTheSameForEveryOrderOfThePoints)
{
  for (const Lattice& lattice : lattices())
  {
    const Cloud cloud(lattice);
    const std::vector<std::size_t> order = randomOrder(kCloudPoints, 5);
    Cloud shuffled = cloud;
    for (std::size_t i = 0; i < kCloudPoints; ++i)
    {
      shuffled.points[i] = cloud.points[order[i]];
      shuffled.values[i] = cloud.values[order[i]];
    }
    for (const Representative representative : kAll)
    {
      const Chosen expected = chosenBy(cloud.request(lattice, representative));
      const Chosen found = chosenBy(shuffled.request(lattice, representative));
      EXPECT_TRUE(sameBits(found.places, expected.places));
      for (std::size_t v = 0; v < found.points.size(); ++v)
      {
        ASSERT_EQ(
          shuffled.values[std::size_t(found.points[v])], cloud.values[std::size_t(expected.points[v])]);
      }
      for (std::size_t i = 0; i < kCloudPoints; ++i)
      {
        ASSERT_EQ(found.index[i], expected.index[order[i]]);
      }
    }
  }
}

/// Two points are equally far from their mean, whatever their coordinates.
TEST(VoxelRepresentative, OfTwoPointsIsTheOneWithTheSmallerXWhereverTheyAre)
{
  Random random(6);
  for (int i = 0; i < 500; ++i)
  {
    VoxelRequest request;
    const double scale = std::ldexp(1.0, int(random.below(200)) - 100);
    std::vector<Vec3> points;
    for (int p = 0; p < 2; ++p)
    {
      points.push_back(scale * random.inBox({ 0, 0, 0 }, { 1, 1, 1 }));
    }
    request.points = { points.data(), 2 };
    request.lattice.origin = scale * random.inBox({ -1, -1, -1 }, { 0, 0, 0 });
    request.lattice.spacing = scale * random.inBox({ 2, 2, 2 }, { 3, 4, 5 });
    request.representative = Representative::NearestToMean;
    ASSERT_EQ(chosenBy(request).points, std::vector<std::int64_t>{ points[0].x < points[1].x ? 0 : 1 });
  }
}

TEST(VoxelRepresentative, OfFloatsIsAPointBitForBit)
{
  const Cloud cloud(latticeOf(9, 9, 9));
  std::vector<float> floats;
  for (const Vec3& p : cloud.points)
  {
    floats.insert(floats.end(), { float(p.x) + 0.1f, float(p.y) + 0.01f, -0.0f });
  }
  for (const Representative representative : kNearest)
  {
    VoxelRequest request = cloud.request(latticeOf(9, 9, 9), representative);
    request.points = { floats.data(), std::int64_t(kCloudPoints) };
    request.singlePrecision = true;
    VoxelResampler resampler;
    const RunResult result = runOf(resampler, request);
    for (std::size_t v = 0; v < resampler.chosenPoints().size(); ++v)
    {
      const float* point = floats.data() + 3 * resampler.chosenPoints()[v];
      ASSERT_EQ(std::memcmp(result.voxels.floats.data() + 3 * v, point, 3 * sizeof(float)), 0);
    }
  }
}

TEST(VoxelRepresentative, ChangesNeitherCountsNorCovariances)
{
  for (const Lattice& lattice : lattices())
  {
    const Cloud cloud(lattice);
    VoxelRequest request = cloud.request(lattice, Representative::Mean);
    request.voxelIndex = false;
    const RunResult means = runOf(request);
    request.voxelIndex = true;
    expectSame(runOf(request), means, nameOf(lattice) + " with the voxel of each point");
    for (const Representative representative : kAll)
    {
      request.representative = representative;
      RunResult result = runOf(request);
      result.voxels.means = means.voxels.means;
      expectSame(result, means, nameOf(lattice));
    }
  }
}

TEST(VoxelRepresentative, RefusesTheIndexesOwnPoints)
{
  const Cloud cloud(latticeOf(9, 9, 9));
  VoxelRequest request = cloud.request(latticeOf(9, 9, 9), Representative::NearestToMean);
  VoxelResampler resampler;
  PointIndex index;
  ASSERT_EQ(index.build(request.points), Status::Ok);
  request.index = &index;
  request.points = index.points();
  EXPECT_EQ(resampler.run(request), Status::InvalidParameter);
  EXPECT_EQ(resampler.size(), 0);
  EXPECT_TRUE(resampler.chosenPoints().empty());
}

TEST(VoxelRepresentative, AnAbortAnywhereLeavesNothing)
{
  const Cloud cloud(latticeOf(9, 9, 9));
  for (const Representative representative : kAll)
  {
    VoxelRequest request = cloud.request(latticeOf(9, 9, 9), representative);
    request.chunkPoints = 1000;
    struct Stop : ProgressObserver
    {
      int left = 0;
      bool report(double /*fraction*/) override { return left-- > 0; }
    };
    VoxelResampler resampler;
    Stop stop;
    int reports = 0;
    do
    {
      stop.left = reports;
      ASSERT_LT(++reports, 100);
    } while (resampler.run(request, {}, &stop) == Status::Aborted && resampler.size() == 0 &&
      resampler.voxelIndex().empty());
    EXPECT_GT(reports, 10);
    EXPECT_GT(resampler.size(), 0);
  }
}
