// Resampling and averaging on more threads than most machines have processors, over more points than a chunk.
#include "Core/Resample/VoxelResampler.h"

#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

/// More than three chunks.
constexpr std::size_t kPoints = 100000;
constexpr std::int64_t kChunkPoints = 30000;

/// Four at a time near each other, far from each other in the order; some are above the lattice.
std::vector<Vec3> groupedPoints(const Lattice& lattice)
{
  const auto& d = lattice.dimensions;
  constexpr std::size_t n = kPoints;
  const std::vector<Vec3> places =
    randomBox(n / 4, 21, { 0, 0, 0 }, Vec3(double(d[0]), double(d[1]), 1.01 * double(d[2])));
  Random random(22);
  std::vector<Vec3> points;
  points.reserve(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    points.push_back(places[i % places.size()] + random.inBox({ 0, 0, 0 }, { 0.3, 0.3, 0.3 }));
  }
  return points;
}

std::vector<float> inSinglePrecision(const std::vector<Vec3>& points)
{
  std::vector<float> result;
  result.reserve(3 * points.size());
  for (const Vec3& p : points)
  {
    result.insert(result.end(), { float(p.x), float(p.y), float(p.z) });
  }
  return result;
}

/// Three a point.
std::vector<float> randomValues(std::size_t points)
{
  Random random(23);
  std::vector<float> values;
  values.reserve(3 * points);
  for (std::size_t i = 0; i < 3 * points; ++i)
  {
    values.push_back(float(random.uniform(-1000.0, 1000.0)));
  }
  return values;
}

/// Means of the last run's array.
std::vector<float> meansOf(const VoxelResampler& resampler)
{
  const auto* const means = static_cast<const float*>(resampler.attribute(0));
  return { means, means + 3 * resampler.size() };
}

/// A lattice of unit voxels, and whether points and means are floats.
class VoxelThreads : public ::testing::TestWithParam<std::tuple<std::array<std::int64_t, 3>, bool>>
{
};

} // namespace

TEST_P(VoxelThreads, GiveTheBitsOfOneThreadOnEveryInstructionSet)
{
  const auto& [dimensions, single] = GetParam();
  VoxelRequest request;
  request.lattice.dimensions = dimensions;
  request.chunkPoints = kChunkPoints;
  request.keys = true;
  request.covariances = !single;
  request.singlePrecision = single;
  request.instructions = InstructionSet::Baseline;
  const std::vector<Vec3> doubles = groupedPoints(request.lattice);
  const std::vector<float> floats = inSinglePrecision(doubles);
  const auto n = std::int64_t(doubles.size());
  request.points = single ? PointView(floats.data(), n) : PointView(&doubles[0].x, n);
  const std::vector<float> values = randomValues(doubles.size());
  request.attributes = { { { values.data(), ScalarType::Float, 3, n } } };
  VoxelResampler resampler;
  const RunResult expected = runOf(resampler, request);
  const std::vector<float> expectedMeans = meansOf(resampler);
  EXPECT_GT(expected.clipped, n / 1000);
  for (const InstructionSet set : heldInstructionSets())
  {
    request.instructions = set;
    const std::string what = "set " + std::to_string(int(set));
    const ThreadedExecutor threads(8);
    expectSame(runOf(resampler, request, threads), expected, what);
    EXPECT_TRUE(sameBits(meansOf(resampler), expectedMeans)) << what;
  }
}

/// Cells side by side, sorted records, anything.
INSTANTIATE_TEST_SUITE_P(Paths, VoxelThreads,
  ::testing::Combine(
    ::testing::Values(std::array<std::int64_t, 3>{ 100, 100, 100 },
      std::array<std::int64_t, 3>{ 1024, 1024, 300 }, std::array<std::int64_t, 3>{ 4100, 40, 40 }),
    ::testing::Bool()));
