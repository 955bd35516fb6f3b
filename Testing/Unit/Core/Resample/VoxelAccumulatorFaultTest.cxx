// Accumulators refuse sums that no points make, however small the lie.
#include "Core/Resample/VoxelAccumulator.h"

#include "ResamplerRuns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

/// Words of 64 bits in the bytes of an accumulator, behind the eight of its mark.
enum Word : std::size_t
{
  kFractionBits = 13,
  kPointCount = 14,
  kFirstVoxel = 18,
};
constexpr std::size_t kVoxelWords = 6; ///< Key, count, three sums and what is above their words.

std::uint64_t wordAt(const std::string& bytes, std::size_t word)
{
  std::uint64_t value = 0;
  for (std::size_t i = 8; i > 0; --i)
  {
    value = value << 8 | static_cast<unsigned char>(bytes[8 + 8 * word + i - 1]);
  }
  return value;
}

void setWord(std::string& bytes, std::size_t word, std::uint64_t value)
{
  for (std::size_t i = 0; i < 8; ++i)
  {
    bytes[8 + 8 * word + i] = char(value >> 8 * i & 255);
  }
}

Status addTo(VoxelAccumulator& sums, const std::vector<Vec3>& points)
{
  return sums.add(PointView(points.data(), std::int64_t(points.size())));
}

Status subtractFrom(VoxelAccumulator& sums, const std::vector<Vec3>& points)
{
  return sums.subtract(PointView(points.data(), std::int64_t(points.size())));
}

Status finish(VoxelAccumulator& sums)
{
  VoxelResampler result;
  return sums.finish({}, result);
}

/// Two voxels of a point each.
std::string twoVoxels()
{
  VoxelAccumulator sums(latticeOf(4, 4, 4));
  EXPECT_EQ(addTo(sums, { { 0.5, 0.5, 0.5 }, { 2.5, 0.25, 0.25 } }), Status::Ok);
  return sums.serialize();
}

void expectRefused(const std::string& bytes)
{
  VoxelAccumulator read(latticeOf(1, 1, 1));
  EXPECT_EQ(VoxelAccumulator::deserialize(bytes, read), Status::InvalidParameter);
  EXPECT_EQ(read.points(), 0);
}

TEST(VoxelAccumulatorFaults, BytesWhoseVoxelsAreOutOfOrderAreRefused)
{
  const std::string good = twoVoxels();
  VoxelAccumulator read(latticeOf(1, 1, 1));
  ASSERT_EQ(VoxelAccumulator::deserialize(good, read), Status::Ok);
  std::string bytes = good;
  const std::uint64_t first = wordAt(good, kFirstVoxel);
  const std::uint64_t second = wordAt(good, kFirstVoxel + kVoxelWords);
  setWord(bytes, kFirstVoxel, second);
  expectRefused(bytes); // twice the same
  setWord(bytes, kFirstVoxel + kVoxelWords, first);
  expectRefused(bytes);
}

TEST(VoxelAccumulatorFaults, BytesThatCountOtherPointsThanTheirVoxelsAreRefused)
{
  const std::string good = twoVoxels();
  for (const int change : { -1, 1 })
  {
    std::string bytes = good;
    setWord(bytes, kPointCount, wordAt(good, kPointCount) + std::uint64_t(std::int64_t(change)));
    expectRefused(bytes);
    bytes = good;
    setWord(bytes, kFirstVoxel + 1, wordAt(good, kFirstVoxel + 1) + std::uint64_t(std::int64_t(change)));
    expectRefused(bytes);
  }
}

TEST(VoxelAccumulatorFaults, BytesWhoseMeansLieOutsideTheirVoxelsAreRefused)
{
  std::string bytes = twoVoxels();
  const std::uint64_t bits = wordAt(bytes, kFractionBits);
  ASSERT_LT(bits, 63u);
  // In a voxel of one point a sum of 1 is the upper face, which belongs to the next voxel.
  setWord(bytes, kFirstVoxel + 2, (std::uint64_t{ 1 } << bits) - 1);
  VoxelAccumulator read(latticeOf(1, 1, 1));
  EXPECT_EQ(VoxelAccumulator::deserialize(bytes, read), Status::Ok);
  setWord(bytes, kFirstVoxel + 2, std::uint64_t{ 1 } << bits);
  VoxelAccumulator none(latticeOf(1, 1, 1));
  EXPECT_EQ(VoxelAccumulator::deserialize(bytes, none), Status::InvalidParameter);
}

TEST(VoxelAccumulatorFaults, BytesWhoseArraysNoPointsHaveAreRefused)
{
  const Vec3 point(0.5, 0.5, 0.5);
  const std::uint8_t label = 255;
  const float number = NAN;
  struct Case
  {
    AttributeView view;
    AttributeStatistic statistic;
    std::size_t fromEnd; ///< Distance of the changed byte from the end.
    char right;
    char wrong;
  };
  const AttributeView labels{ &label, ScalarType::UInt8, 1, 1 };
  const AttributeView numbers{ &number, ScalarType::Float, 1, 1 };
  const Case cases[] = { { labels, AttributeStatistic::Mean, 35, 0, 1 }, // Sums of 255, 255 + 256.
    { labels, AttributeStatistic::Mode, 8, 1, 2 },                       // How many points have a value.
    { labels, AttributeStatistic::Mode, 15, 0, 1 },                      // The values 255, 255 + 256.
    { numbers, AttributeStatistic::Mean, 44, 1, 2 },                     // How many are NaN.
    { numbers, AttributeStatistic::Mean, 36, 0, 1 } };                   // One NaN, and one infinite.
  for (const Case& c : cases)
  {
    VoxelAccumulator sums(latticeOf(4, 4, 4), false, { { c.view.type, 1, c.statistic } });
    ASSERT_EQ(sums.add(PointView(&point, 1), { c.view }), Status::Ok);
    std::string bytes = sums.serialize();
    char& changed = bytes[bytes.size() - c.fromEnd];
    EXPECT_EQ(changed, c.right) << c.fromEnd;
    changed = c.wrong;
    expectRefused(bytes);
  }
}

TEST(VoxelAccumulatorFaults, OtherVoxelsOrAnotherEndAreAnotherLattice)
{
  const Lattice lattice = latticeOf(4, 4, 4);
  VoxelAccumulator sums(lattice);
  Lattice other = lattice;
  other.spacing = { 1.0, 1.0, 1.5 };
  EXPECT_EQ(sums.merge(VoxelAccumulator(other)), Status::InvalidParameter);
  other = lattice;
  other.origin = { 0.0, 0.5, 0.0 };
  EXPECT_EQ(sums.merge(VoxelAccumulator(other)), Status::InvalidParameter);
  other = lattice;
  other.end = { 3.5, 3.5, 3.5 };
  EXPECT_EQ(sums.merge(VoxelAccumulator(other)), Status::InvalidParameter);
  EXPECT_EQ(sums.merge(VoxelAccumulator(lattice)), Status::Ok);
}

TEST(VoxelAccumulatorFaults, MorePointsThanItCanCountAreRefusedBeforeTheyAreRead)
{
  VoxelAccumulator sums(latticeOf(4, 4, 4));
  const Vec3 one{ 0.5, 0.5, 0.5 };
  EXPECT_EQ(sums.add(PointView(&one, VoxelAccumulator::kMostPoints + 1)), Status::InvalidParameter);
  EXPECT_EQ(sums.points(), 0);
}

TEST(VoxelAccumulatorFaults, SubtractingAPointTwiceIsAnErrorAlsoAtTheCornerOfAVoxel)
{
  // There its sums are 0: only the count tells.
  VoxelAccumulator sums(latticeOf(4, 4, 4));
  ASSERT_EQ(addTo(sums, { { 1.0, 1.0, 1.0 } }), Status::Ok);
  ASSERT_EQ(subtractFrom(sums, { { 1.0, 1.0, 1.0 }, { 1.0, 1.0, 1.0 } }), Status::Ok);
  EXPECT_EQ(finish(sums), Status::InvalidParameter);
}

TEST(VoxelAccumulatorFaults, SubtractingAnotherPointIsAnError)
{
  for (const double other : { 1.25, 1.75, 2.5 }) // Below and above in its voxel, and in the next one.
  {
    VoxelAccumulator sums(latticeOf(4, 4, 4));
    ASSERT_EQ(addTo(sums, { { 1.5, 1.5, 1.5 } }), Status::Ok);
    ASSERT_EQ(subtractFrom(sums, { { 1.5, other, 1.5 } }), Status::Ok);
    EXPECT_EQ(finish(sums), Status::InvalidParameter) << other;
  }
}

TEST(VoxelAccumulatorFaults, SubtractingPointsOutsideThatNeverCameIsAnError)
{
  for (const Vec3& never : { Vec3(9.0, 9.0, 9.0), Vec3(NAN, 0.0, 0.0) })
  {
    VoxelAccumulator sums(latticeOf(4, 4, 4));
    ASSERT_EQ(addTo(sums, { { 1.5, 1.5, 1.5 } }), Status::Ok);
    ASSERT_EQ(subtractFrom(sums, { never }), Status::Ok);
    EXPECT_EQ(finish(sums), Status::InvalidParameter);
  }
}

} // namespace
