#include "Core/Base/Lattice.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Resample/VoxelResampler.h"

#include "Unit/VoxelMeans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace pointhaptics
{
namespace
{

/// Points with other numbers between them, and the same without. More than a block, one of them NaN.
template <typename Real>
struct Twins
{
  explicit Twins(std::int64_t step)
    : stride(step)
    , packed(3 * count)
    , wide(std::size_t(stride) * (count - 1) + 3) // nothing behind the last z
  {
    std::mt19937 random(5);
    std::normal_distribution<double> place;
    for (Real& number : wide)
    {
      number = Real(1e30);
    }
    for (std::size_t i = 0; i < 3 * count; ++i)
    {
      packed[i] = i == 600 ? Real(NAN) : Real(place(random));
      wide[std::size_t(stride) * (i / 3) + i % 3] = packed[i];
    }
  }
  PointView strided() const { return { wide.data(), std::int64_t(count), stride }; }
  PointView plain() const { return { packed.data(), std::int64_t(count) }; }

  static constexpr std::size_t count = 5000;
  std::int64_t stride;
  std::vector<Real> packed;
  std::vector<Real> wide;
};

template <typename Real>
void expectSameMeans(std::int64_t stride)
{
  const Twins<Real> twins(stride);
  const AffineTransform turned = AffineTransform::rotation(30.0, { 1.0, 2.0, 3.0 });
  const Bounds box = transformedBounds(twins.plain(), turned);
  const Bounds same = transformedBounds(twins.strided(), turned);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(same.minimum[axis], box.minimum[axis]);
    EXPECT_EQ(same.maximum[axis], box.maximum[axis]);
  }
  // Lattices for partitions, and one for the sorted way.
  for (const std::int64_t dimension : { 20, 300, 100000 })
  {
    Lattice lattice;
    LatticeSettings settings;
    settings.dimensions = { dimension, dimension, dimension };
    ASSERT_EQ(makeLattice(settings, box, lattice), Status::Ok);
    VoxelMeans expected;
    VoxelMeans means;
    ASSERT_EQ(voxelMeans(twins.plain(), turned, lattice, true, expected), Status::Ok);
    ASSERT_EQ(voxelMeans(twins.strided(), turned, lattice, true, means), Status::Ok);
    EXPECT_EQ(means.invalidPoints, 1);
    EXPECT_EQ(means.keys, expected.keys);
    EXPECT_EQ(means.counts, expected.counts);
    ASSERT_EQ(means.means.size(), expected.means.size());
    EXPECT_EQ(std::memcmp(means.means.data(), expected.means.data(), sizeof(Vec3) * means.means.size()), 0);
  }
}

TEST(StridedPoints, HaveTheMeansOfTheSamePointsWithoutGaps)
{
  for (const std::int64_t stride : { 3, 4, 5, 8, 12 })
  {
    expectSameMeans<float>(stride);
    expectSameMeans<double>(stride);
  }
}

TEST(StridedPoints, BringTheirTuplesToTheirVoxels)
{
  const Twins<float> twins(7);
  VoxelRequest request;
  request.points = twins.strided();
  LatticeSettings settings;
  settings.dimensions = { 10, 10, 10 };
  ASSERT_EQ(makeLattice(settings, transformedBounds(request.points, {}), request.lattice), Status::Ok);
  // x, y and z themselves, as an attribute: their mean is the point.
  request.attributes = { { { twins.wide.data(), ScalarType::Float, 3, std::int64_t(Twins<float>::count),
    std::int64_t(7 * sizeof(float)) } } };
  VoxelResampler resampler;
  ASSERT_EQ(resampler.run(request), Status::Ok);
  const auto* const averaged = static_cast<const float*>(resampler.attribute(0));
  const double* const means = resampler.doubles();
  for (std::int64_t i = 0; i < 3 * resampler.size(); ++i)
  {
    ASSERT_NEAR(double(averaged[i]), means[i], 1e-6) << i;
  }
}

TEST(StridedPoints, HaveTheRangeOfTheSameNumbersWithoutGaps)
{
  const Twins<double> twins(5);
  const AttributeView plain{ twins.packed.data(), ScalarType::Double, 3, std::int64_t(Twins<double>::count) };
  AttributeView strided = plain;
  strided.values = twins.wide.data();
  strided.stride = 5 * sizeof(double);
  const AttributeRange expected = rangeOf(plain, {});
  const AttributeRange range = rangeOf(strided, {});
  EXPECT_EQ(range.exponent, expected.exponent);
  EXPECT_EQ(range.lastBit, expected.lastBit);
  EXPECT_TRUE(range.hasNonFinite);
}

Bounds boundsOf(double low, double high)
{
  Bounds box;
  box.include({ low, low, low });
  box.include({ high, high, high });
  return box;
}

TEST(AlignedLattice, HasItsFacesAtMultiplesOfTheSpacing)
{
  Lattice lattice;
  std::array<std::int64_t, 3> first{};
  ASSERT_EQ(alignedLattice({ 0.5, 1.0, 2.0 }, boundsOf(-1.25, 3.0), lattice, first), Status::Ok);
  EXPECT_EQ(first, (std::array<std::int64_t, 3>{ -3, -2, -1 }));
  EXPECT_EQ(lattice.origin.x, -1.5);
  EXPECT_EQ(lattice.origin.z, -2.0);
  // 3.0 itself begins a voxel on the first two axes.
  EXPECT_EQ(lattice.dimensions, (std::array<std::int64_t, 3>{ 10, 6, 3 }));
  EXPECT_TRUE(lattice.contains(lattice.continuousIndex({ 3.0, 3.0, 3.0 })));
  EXPECT_EQ(
    Lattice::voxelAt(lattice.continuousIndex({ 0.0, 0.0, 0.0 })), (std::array<std::int64_t, 3>{ 3, 2, 1 }));
}

TEST(AlignedLattice, RefusesWhatItCannotAddress)
{
  Lattice lattice;
  std::array<std::int64_t, 3> first{};
  const auto status = [&](double spacing, const Bounds& box) {
    return alignedLattice({ 1.0, spacing, 1.0 }, box, lattice, first);
  };
  EXPECT_EQ(status(0.0, boundsOf(0, 1)), Status::InvalidVoxelSize);
  EXPECT_EQ(status(-1.0, boundsOf(0, 1)), Status::InvalidVoxelSize);
  EXPECT_EQ(status(NAN, boundsOf(0, 1)), Status::InvalidVoxelSize);
  EXPECT_EQ(status(INFINITY, boundsOf(0, 1)), Status::InvalidVoxelSize);
  EXPECT_EQ(status(1.0, Bounds()), Status::InvalidWorkspace);
  EXPECT_EQ(status(1e-7, boundsOf(0, 1)), Status::LatticeNotAddressable);
  EXPECT_EQ(status(1.0, boundsOf(1e12, 1e12 + 1)), Status::LatticeNotAddressable);
  EXPECT_EQ(status(1e-300, boundsOf(0, 1e300)), Status::LatticeNotAddressable);
  EXPECT_EQ(status(1.0, boundsOf(0, 1)), Status::Ok);
}

}
}
