// Arrays that are accumulated with the points, against those of one run over all of them.
#include "Core/Resample/VoxelAccumulator.h"

#include "RandomClouds.h"
#include "ResamplerRuns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

constexpr std::size_t kArrayPoints = 5000;

AffineTransform turnedBy(double degrees)
{
  return AffineTransform::translation({ 0.2, 0.1, 0.3 }) * AffineTransform::rotation(degrees, { 1, 2, 3 });
}

/// Points with arrays of every kind, whose magnitudes differ by the cloud.
struct ArrayCloud
{
  std::vector<Vec3> points;
  std::vector<float> colors;
  std::vector<double> reals;
  std::vector<std::int64_t> integers;
  std::vector<std::uint8_t> labels;
  std::vector<float> heights;
  std::vector<float> normals;
  std::vector<std::int16_t> shorts; ///< Their sums are words of one unit.

  ArrayCloud(std::size_t size, const Lattice& lattice, std::uint64_t seed, int magnitude)
    : points(quantisedPoints(size, seed, lattice))
  {
    Random random(seed);
    for (std::size_t i = 0; i < size; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        colors.push_back(float(std::ldexp(random.uniform(-1.0, 1.0), magnitude / 10)));
        normals.push_back(float(random.uniform(-1.0, 1.0)));
      }
      reals.push_back(std::ldexp(random.uniform(-1.0, 1.0), magnitude - int(random.below(300))));
      integers.push_back(std::numeric_limits<std::int64_t>::min() + std::int64_t(random.below(1000)));
      labels.push_back(std::uint8_t(random.below(5)));
      heights.push_back(float(random.below(7)) - 3.0f);
      shorts.push_back(std::int16_t(random.below(65536) - 32768));
    }
    reals[1] = -INFINITY;
    reals[size / 2] = NAN;
  }
  PointView view(std::size_t first, std::size_t last) const
  {
    return { points.data() + first, std::int64_t(last - first) };
  }
  std::vector<AttributeView> arrays(std::size_t first, std::size_t last) const
  {
    const auto size = std::int64_t(last - first);
    return { { colors.data() + 3 * first, ScalarType::Float, 3, size },
      { reals.data() + first, ScalarType::Double, 1, size },
      { integers.data() + first, ScalarType::Int64, 1, size },
      { labels.data() + first, ScalarType::UInt8, 1, size },
      { heights.data() + first, ScalarType::Float, 1, size },
      { normals.data() + 3 * first, ScalarType::Float, 3, size },
      { shorts.data() + first, ScalarType::Int16, 1, size } };
  }
};

std::vector<VoxelAccumulator::Array> kinds()
{
  return { { ScalarType::Float, 3, AttributeStatistic::Mean },
    { ScalarType::Double, 1, AttributeStatistic::Mean }, { ScalarType::Int64, 1, AttributeStatistic::Mean },
    { ScalarType::UInt8, 1, AttributeStatistic::Mode }, { ScalarType::Float, 1, AttributeStatistic::Median },
    { ScalarType::Float, 3, AttributeStatistic::Normal },
    { ScalarType::Int16, 1, AttributeStatistic::Mean } };
}

/// The bytes of all arrays.
std::string bytesOf(const VoxelResampler& made)
{
  std::string bytes;
  for (std::size_t i = 0; i < kinds().size(); ++i)
  {
    const auto size =
      std::size_t(made.size() * pointhaptics::bytesOf(kinds()[i].type)) * std::size_t(kinds()[i].components);
    bytes.append(static_cast<const char*>(made.attribute(i)), size);
  }
  return bytes;
}

std::string finished(VoxelAccumulator& sums)
{
  VoxelRequest wanted;
  VoxelResampler made;
  EXPECT_EQ(sums.finish(wanted, made, ThreadedExecutor(2)), Status::Ok);
  return bytesOf(made);
}

std::string ofOneRun(const ArrayCloud& cloud, const Lattice& lattice, const AffineTransform& transform)
{
  VoxelRequest request;
  request.points = cloud.view(0, kArrayPoints);
  request.transform = transform;
  request.lattice = lattice;
  const std::vector<AttributeView> views = cloud.arrays(0, kArrayPoints);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    request.attributes.push_back({ views[i], kinds()[i].statistic });
  }
  VoxelResampler made;
  EXPECT_EQ(made.run(request), Status::Ok);
  return bytesOf(made);
}

std::vector<Lattice> someLattices()
{
  return { latticeOf(30, 25, 20), latticeOf(5000, 3, 2), latticeOf(1, 1, 1) };
}

void addPart(VoxelAccumulator& sums, const ArrayCloud& cloud, std::size_t first, std::size_t last,
  const Executor& executor = {})
{
  EXPECT_EQ(sums.add(cloud.view(first, last), cloud.arrays(first, last), executor), Status::Ok);
}

}

TEST(VoxelAccumulatorArrays, AreThoseOfOneRunHoweverTheyCame)
{
  for (const Lattice& lattice : someLattices())
  {
    const ArrayCloud cloud(kArrayPoints, lattice, 3, 0);
    const std::string expected = ofOneRun(cloud, lattice, turnedBy(25));
    VoxelAccumulator sums(lattice, true, kinds(), turnedBy(25));
    for (const std::size_t part : randomOrder(40, 4))
    {
      addPart(sums, cloud, kArrayPoints * part / 40, kArrayPoints * (part + 1) / 40,
        ThreadedExecutor(int(part % 3) + 1));
    }
    EXPECT_TRUE(finished(sums) == expected) << nameOf(lattice) << ", in parts";
    VoxelAccumulator first = sums.part(0, 0);
    VoxelAccumulator second = sums.part(0, 0);
    addPart(first, cloud, 0, 1700);
    addPart(second, cloud, 1700, kArrayPoints);
    VoxelAccumulator read(latticeOf(1, 1, 1));
    ASSERT_EQ(VoxelAccumulator::deserialize(second.serialize(), read), Status::Ok);
    ASSERT_EQ(read.merge(std::move(first)), Status::Ok);
    EXPECT_TRUE(finished(read) == expected) << nameOf(lattice) << ", merged from bytes";
  }
}

TEST(VoxelAccumulatorArrays, RangesOfBytesAreThePartsOfTheWhole)
{
  for (const Lattice& lattice : someLattices())
  {
    const ArrayCloud cloud(kArrayPoints, lattice, 3, 0);
    VoxelAccumulator sums(lattice, true, kinds(), turnedBy(25));
    addPart(sums, cloud, 0, kArrayPoints);
    const std::vector<std::uint64_t> keys = sums.keys();
    std::vector<std::uint64_t> ends = { 0, 0, keys[keys.size() / 3], keys[keys.size() / 2], keys.back() + 9,
      ~std::uint64_t(0) };
    VoxelAccumulator merged = sums.part(0, 0);
    for (std::size_t i = 1; i < ends.size(); ++i)
    {
      VoxelAccumulator read{ Lattice() };
      ASSERT_EQ(VoxelAccumulator::deserialize(sums.serialize(ends[i - 1], ends[i]), read), Status::Ok);
      VoxelAccumulator part = sums.part(ends[i - 1], ends[i]);
      EXPECT_TRUE(finished(read) == finished(part)) << nameOf(lattice);
      ASSERT_EQ(merged.merge(std::move(read)), Status::Ok);
    }
    EXPECT_TRUE(finished(merged) == finished(sums)) << nameOf(lattice);
    EXPECT_EQ(merged.clippedPoints(), sums.clippedPoints());
  }
}

TEST(VoxelAccumulatorArrays, SumsAreRoundedOnceWhateverIsFarBelow)
{
  // Half of the last bit of 1 and next to nothing more, or less; and numbers among the denormals.
  const Lattice lattice = latticeOf(1, 1, 1);
  const std::vector<Vec3> points(4, Vec3(0.5, 0.5, 0.5));
  const std::vector<std::vector<double>> cases = { { 1.0, 0x1p-53, 0x1p-900, 0.0 },
    { 1.0, 0x1p-53, -0x1p-900, 0.0 }, { 1.0, 0x1p-52 + 0x1p-53, -0x1p-300, 0x1p-1074 },
    { 0x1p-1074, 0x1p-1070, 0x1p-1060, 0x1p-1074 }, { 0x1p1023, 0x1p1023, 0x1p1023, -0x1p-1074 },
    { 1.0, -1.0, 0.0, 0.0 }, { -0x1p31, -0x1p-1, 0x1p63, 0x1p95 } };
  for (const std::vector<double>& values : cases)
  {
    const AttributeView view{ values.data(), ScalarType::Double, 1, 4 };
    VoxelAccumulator sums(lattice, false, { { ScalarType::Double, 1, AttributeStatistic::Mean } });
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_EQ(
        sums.add(PointView(points.data(), 1), { { &values[i], ScalarType::Double, 1, 1 } }), Status::Ok);
    }
    VoxelResampler made;
    ASSERT_EQ(sums.finish({}, made), Status::Ok);
    VoxelRequest request;
    request.points = { points.data(), 4 };
    request.lattice = lattice;
    request.attributes = { { view, AttributeStatistic::Mean } };
    VoxelResampler expected;
    ASSERT_EQ(expected.run(request), Status::Ok);
    EXPECT_EQ(
      *static_cast<const double*>(made.attribute(0)), *static_cast<const double*>(expected.attribute(0)))
      << values[0] << " " << values[1];
  }
}

TEST(VoxelAccumulatorArrays, OthersAreRefused)
{
  const Lattice lattice = latticeOf(4, 4, 4);
  const ArrayCloud cloud(kArrayPoints, lattice, 3, 0);
  VoxelAccumulator sums(lattice, false, kinds(), turnedBy(25));
  const PointView points = cloud.view(0, 100);
  EXPECT_EQ(sums.add(points), Status::InvalidParameter) << "no arrays";
  EXPECT_EQ(sums.add(points, cloud.arrays(0, 99)), Status::InvalidParameter) << "too few";
  std::vector<AttributeView> views = cloud.arrays(0, 100);
  std::swap(views[0], views[1]);
  EXPECT_EQ(sums.add(points, views), Status::InvalidParameter) << "another type";
  EXPECT_EQ(sums.points(), 0);
  EXPECT_EQ(sums.merge(VoxelAccumulator(lattice)), Status::InvalidParameter);
  EXPECT_EQ(sums.merge(VoxelAccumulator(lattice, false, kinds())), Status::InvalidParameter);
}

TEST(VoxelAccumulatorArrays, BytesThatWereCutOrChangedAreRefused)
{
  const Lattice lattice = latticeOf(4, 3, 2);
  const ArrayCloud cloud(60, lattice, 3, 0);
  VoxelAccumulator sums(lattice, false, kinds(), turnedBy(25));
  addPart(sums, cloud, 0, 60);
  const std::string bytes = sums.serialize();
  VoxelAccumulator read{ Lattice() };
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50)
  {
    EXPECT_EQ(VoxelAccumulator::deserialize(bytes.substr(0, size), read), Status::InvalidParameter) << size;
  }
  EXPECT_EQ(VoxelAccumulator::deserialize(bytes + "x", read), Status::InvalidParameter);
  EXPECT_EQ(VoxelAccumulator::deserialize(bytes + "12345678", read), Status::InvalidParameter);
  Random random(9);
  for (int i = 0; i < 3000; ++i)
  {
    std::string changed = bytes;
    // Every third time in the header, every other one by a small number.
    changed[random.below(i % 3 == 0 ? 200 : changed.size())] ^= char(1 + random.below(i % 2 ? 4 : 255));
    EXPECT_EQ(VoxelAccumulator::deserialize(changed, read), Status::InvalidParameter);
  }
  EXPECT_EQ(read.points(), 0);
}

TEST(VoxelAccumulatorArrays, AttributesOfTheRequestDoNotCount)
{
  const Lattice lattice = latticeOf(4, 3, 2);
  const ArrayCloud cloud(60, lattice, 3, 0);
  VoxelAccumulator sums(lattice, false, kinds(), turnedBy(25));
  addPart(sums, cloud, 0, 60);
  VoxelRequest request;
  request.attributes.push_back({ cloud.arrays(0, 60)[0], AttributeStatistic::Mean });
  VoxelResampler result;
  EXPECT_EQ(sums.finish(request, result), Status::Ok);
}
