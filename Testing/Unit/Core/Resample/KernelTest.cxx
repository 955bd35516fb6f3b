// The resampler's kernels where its results alone would not show what is wrong: plans, positions.
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/BinnedVoxels.h"
#include "Core/Resample/Stages/PartitionOrder.h"
#include "Core/Resample/Stages/PointQuantizer.h"

#include "RandomClouds.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <type_traits>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::simd;

namespace
{

Lattice randomLattice(trial::Random& random, double largest)
{
  Lattice lattice;
  for (std::int64_t& n : lattice.dimensions)
  {
    n = std::int64_t(std::pow(largest + 0.5, random.uniform()));
  }
  return lattice;
}

std::uint32_t partitionOf(const PartitionPlan& plan, std::int64_t y, std::int64_t z)
{
  return std::uint32_t(z >> plan.layerShift) * plan.blocksPerLayer + std::uint32_t(y >> plan.rowShift);
}

} // namespace

TEST(PartitionPlan, CoversEveryRowInAscendingOrder)
{
  trial::Random random(1);
  for (int i = 0; i < 2000; ++i)
  {
    const Lattice lattice = randomLattice(random, 4096);
    const auto& d = lattice.dimensions;
    const int bits = indexBitsOf(lattice);
    if (bits < kMinimumIndexBits)
    {
      continue;
    }
    const PartitionPlan plan = makePlan(lattice, bits, std::int64_t(std::pow(10.0, random.uniform(0, 6))));
    SCOPED_TRACE(testing::Message() << d[0] << "x" << d[1] << "x" << d[2] << " in " << plan.partitions);
    ASSERT_GE(plan.partitions, 1u);
    ASSERT_EQ(plan.firstKey(0), 0u);
    ASSERT_EQ(partitionOf(plan, d[1] - 1, d[2] - 1), plan.partitions - 1);
    for (int j = 0; j < 50; ++j)
    {
      const auto y = std::int64_t(random.below(std::size_t(d[1])));
      const auto z = std::int64_t(random.below(std::size_t(d[2])));
      const std::uint32_t p = partitionOf(plan, y, z);
      ASSERT_LT(p, plan.partitions);
      const std::uint64_t key = lattice.key(0, y, z);
      ASSERT_GE(key, plan.firstKey(p));
      ASSERT_LE(key + std::uint64_t(d[0]) - plan.firstKey(p), plan.cells());
      if (p + 1 < plan.partitions)
      {
        ASSERT_LT(key, plan.firstKey(p + 1));
      }
    }
  }
}

TEST(PartitionPlan, KeepsPartitionsWithinHalfTheLayersAndTheirCellsWithin32Bits)
{
  trial::Random random(2);
  for (int i = 0; i < 2000; ++i)
  {
    const Lattice lattice = randomLattice(random, 4096);
    const int bits = indexBitsOf(lattice);
    if (bits < kMinimumIndexBits)
    {
      continue;
    }
    const PartitionPlan plan = makePlan(lattice, bits, 1 + std::int64_t(random.below(1000000)));
    EXPECT_LE(plan.layerShift, bits - 1);
    EXPECT_LT(plan.cells(), std::size_t(1) << 32);
    EXPECT_EQ(plan.upperRows != 0, lattice.dimensions[2] > (std::int64_t(1) << (bits - 1)));
    EXPECT_TRUE(plan.layerShift == 0 || plan.blocksPerLayer == 1);
  }
}

namespace
{

/// Long double has too few digits for what cancels under the transforms of these tests.
__extension__ typedef __float128 Exact;

/// Scales, rotations, and shears of condition numbers up to 10^10.
AffineTransform randomTransform(trial::Random& random, int kind)
{
  switch (kind % 3)
  {
    case 0:
      return AffineTransform::scaling(random.inBox({ 0.5, -4, 0.5 }, { 2, -0.5, 4 }));
    case 1:
      return AffineTransform::rotation(random.uniform(0, 360), random.direction());
    default:
    {
      AffineTransform shear;
      shear.m[0][1] = std::pow(10.0, random.uniform(0, 5));
      return AffineTransform::rotation(random.uniform(0, 360), random.direction()) * shear *
        AffineTransform::rotation(random.uniform(0, 360), random.direction());
    }
  }
}

/// The point that is so far along each axis of a lattice, as near as a double is to it.
Vec3 pointAt(const AffineTransform& transform, const Lattice& lattice, const Vec3& fractions)
{
  Exact target[3];
  Exact m[3][3];
  for (int r = 0; r < 3; ++r)
  {
    target[r] = Exact(lattice.origin[r]) - Exact(transform.m[r][3]) +
      Exact(fractions[r]) * Exact(lattice.dimensions[std::size_t(r)]) * Exact(lattice.spacing[r]);
    std::copy(transform.m[r], transform.m[r] + 3, m[r]);
  }
  const auto cofactor = [&](int r, int c)
  {
    return m[(r + 1) % 3][(c + 1) % 3] * m[(r + 2) % 3][(c + 2) % 3] -
      m[(r + 1) % 3][(c + 2) % 3] * m[(r + 2) % 3][(c + 1) % 3];
  };
  const Exact determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Vec3 point;
  for (int c = 0; c < 3; ++c)
  {
    point[c] = double(
      (cofactor(0, c) * target[0] + cofactor(1, c) * target[1] + cofactor(2, c) * target[2]) / determinant);
  }
  return point;
}

} // namespace

TEST(PointQuantizer, TruncatesPositionsToTheQuantum)
{
  trial::Random random(3);
  int compensated = 0;
  for (int i = 0; i < 900; ++i)
  {
    Lattice lattice = randomLattice(random, double(kMaximumLatticeDimension));
    lattice.origin = random.inBox({ -1e6, -1e6, -1e6 }, { 1e6, 1e6, 1e6 });
    lattice.spacing = random.inBox({ 0.1, 0.1, 0.1 }, { 3, 3, 3 });
    AffineTransform transform = randomTransform(random, i);
    for (int axis = 0; axis < 3; ++axis)
    {
      transform.m[axis][3] = random.uniform(-1e6, 1e6);
    }
    const int bits = indexBitsOf(lattice);
    const PointQuantizer quantizer = makeQuantizer(transform, lattice, bits, positionBitsFor(bits));
    EXPECT_LE(std::ldexp(1.0, -quantizer.fractionBits), 0x1p-31);
    compensated += quantizer.motion == Motion::Compensated;
    const double quantum = std::ldexp(1.0, -quantizer.fractionBits);
    // Rounding adds at most this; where it is worth a part of a quantum, truncation cannot take all of one.
    const bool uncorrected = bits > kMaximumIndexBits && bits <= kUncorrectedIndexBits;
    const double rounding = bits <= kMaximumIndexBits ? 0x1p-34 : uncorrected ? 0.25 * quantum : 0x1p-50;
    EXPECT_LE(quantum + rounding, (bits <= kMaximumIndexBits ? 1.125 : 1.0001) * 0x1p-31);
    int inside = 0;
    for (int j = 0; j < 20; ++j)
    {
      const Vec3 point = pointAt(transform, lattice, random.inBox({ 0, 0, 0 }, { 1, 1, 1 }));
      std::uint64_t position[3];
      const bool isInside = quantizePoint(quantizer, point, position) == PointLocation::Inside;
      inside += isInside;
      for (int axis = 0; axis < 3 && isInside; ++axis)
      {
        const double* row = transform.m[axis];
        const Exact moved =
          Exact(row[0]) * point.x + Exact(row[1]) * point.y + Exact(row[2]) * point.z + Exact(row[3]);
        const Exact u = (moved - Exact(lattice.origin[axis])) / Exact(lattice.spacing[axis]);
        const auto error = double(Exact(position[axis]) * Exact(quantum) - u);
        ASSERT_LE(error, uncorrected ? 0.75 * quantum : rounding) << "motion " << int(quantizer.motion);
        ASSERT_GE(error, -quantum - rounding) << "motion " << int(quantizer.motion);
      }
    }
    EXPECT_GT(inside, 10);
  }
  EXPECT_GT(compensated, 200);
}

TEST(PointQuantizer, CompensatesOnlyWhereItIsOfUse)
{
  Lattice lattice;
  lattice.dimensions = { 4096, 4096, 4096 };
  const auto motionUnder = [&](const AffineTransform& transform)
  { return makeQuantizer(transform, lattice, indexBitsOf(lattice), kPositionBits).motion; };
  const AffineTransform rotation = AffineTransform::rotation(33, { 1, 2, 3 });
  EXPECT_EQ(motionUnder(rotation), Motion::General);
  EXPECT_EQ(motionUnder(AffineTransform::scaling({ 1e5, 1e5, 1e5 }) * rotation), Motion::General);
  EXPECT_EQ(motionUnder(AffineTransform::scaling({ 1, 1e5, 1 })), Motion::Scale);
  EXPECT_EQ(motionUnder(rotation * AffineTransform::scaling({ 1, 1e5, 1 }) * rotation), Motion::Compensated);
  lattice.dimensions[1] = 5000;
  EXPECT_EQ(makeQuantizer(AffineTransform::scaling({ 1, 2, 1 }), lattice, 13, positionBitsFor(13)).motion,
    Motion::Compensated)
    << "no bit of a double is left over";
}

TEST(PointQuantizer, DividesAsAPairOnlyWhereThatIsTheQuotient)
{
  trial::Random random(5);
  int pairs = 0;
  int wrong = 0;
  for (int i = 0; i < 20000; ++i)
  {
    // The quotients nearest to the middle of two doubles: V 2^54 = S M -+ 1 with M odd, so M = +-1 / S mod
    // 2^54.
    constexpr std::uint64_t kModulus = std::uint64_t(1) << 54;
    const std::uint64_t integer = std::uint64_t(random.uniform(0x1p52, 0x1p53)) | 1u;
    std::uint64_t inverse = 1;
    for (int step = 0; step < 6; ++step)
    {
      inverse *= 2 - integer * inverse;
    }
    Lattice lattice;
    lattice.dimensions = { 300, 300, 300 };
    const double spacing = std::ldexp(double(integer), -52);
    lattice.spacing = { spacing, spacing, spacing };
    const PointQuantizer quantizer = makeQuantizer({}, lattice, 9, kPositionBits);
    pairs += quantizer.pairDivides;
    for (const std::uint64_t middle : { inverse % kModulus, kModulus - inverse % kModulus })
    {
      const auto v =
        double(std::uint64_t(UInt128(integer) * middle >> 54) + (middle == inverse % kModulus ? 0 : 1));
      const double asPair = std::fma(v, quantizer.reciprocal[0], v * quantizer.remainder[0]);
      ASSERT_TRUE(asPair == v / quantizer.quantum[0] || !quantizer.pairDivides) << integer << ' ' << v;
      wrong += asPair != v / quantizer.quantum[0];
    }
  }
  EXPECT_GT(pairs, 10000) << "worth having";
  EXPECT_GT(wrong, 0) << "not so for all spacings";
}

TEST(PartitionOrder, AppendsPartitionsThatThreadsTakeInOrderButCountAtOnce)
{
  constexpr std::size_t kPartitions = 20000;
  PartitionOrder order;
  std::atomic<std::size_t> next{ 0 };
  std::atomic<int> wrong{ 0 };
  const auto sizeOf = [](std::size_t p) { return p % 3; };
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
  {
    threads.emplace_back(
      [&]
      {
        for (std::size_t p = next++; p < kPartitions; p = next++)
        {
          if (p % 7 == 0)
          {
            std::this_thread::yield(); // Others come first.
          }
          wrong += order.append(p, sizeOf(p)) != p / 3 * 3 + (p % 3 == 2);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(order.size(), kPartitions / 3 * 3 + sizeOf(kPartitions - 1));
}

TEST(PartitionOrder, NobodyWaitsForAPartitionThatNoThreadCanCount)
{
  PartitionOrder order;
  std::thread waiting([&] { order.append(1, 3); });
  order.giveUp();
  waiting.join();
}

TEST(PointQuantizer, DistinguishesOutsideFromInvalid)
{
  Lattice lattice;
  lattice.dimensions = { 4, 4, 4 };
  AffineTransform transform = AffineTransform::scaling({ 1, 1e10, 1 });
  const PointQuantizer quantizer = makeQuantizer(transform, lattice, 2, kPositionBits);
  const auto locationOf = [&](const Vec3& point)
  {
    std::uint64_t position[3];
    return quantizePoint(quantizer, point, position);
  };
  EXPECT_EQ(locationOf({ 1, 1e-10, 1 }), PointLocation::Inside);
  EXPECT_EQ(locationOf({ 0, 0, 0 }), PointLocation::Inside);
  EXPECT_EQ(locationOf({ 4, 0, 0 }), PointLocation::Outside);
  EXPECT_EQ(locationOf({ -1e-300, 0, 0 }), PointLocation::Outside);
  EXPECT_EQ(locationOf({ 1, 1e307, 1 }), PointLocation::Invalid) << "overflows in the transform";
  EXPECT_EQ(locationOf({ -1, 1e307, 1 }), PointLocation::Invalid);
  EXPECT_EQ(locationOf({ NAN, 0, 0 }), PointLocation::Invalid);
  EXPECT_EQ(locationOf({ 0, 0, -INFINITY }), PointLocation::Invalid);
}

namespace
{

/// Bounds of the points that are finite before and after the transform, one by one.
template <typename Real>
Bounds plainBoundsOf(const AffineTransform& transform, const std::vector<Real>& xyz, std::size_t stride)
{
  Bounds box;
  for (std::size_t i = 0; i < xyz.size(); i += stride)
  {
    const Vec3 p(xyz[i], xyz[i + 1], xyz[i + 2]);
    if (isFinite(p) && isFinite(transform.apply(p)))
    {
      box.include(transform.apply(p));
    }
  }
  return box;
}

template <typename Real>
Bounds boundsOf(
  const Kernels& kernels, const AffineTransform& transform, const std::vector<Real>& xyz, std::size_t stride)
{
  double box[6] = { INFINITY, -INFINITY, INFINITY, -INFINITY, INFINITY, -INFINITY };
  const auto count = std::int64_t((xyz.size() + stride - 1) / stride);
  kernels.of<Real>().bounds(transform.m, xyz.data(), count, std::int64_t(stride), box);
  Bounds bounds;
  if (box[0] <= box[1])
  {
    bounds.include({ box[0], box[2], box[4] });
    bounds.include({ box[1], box[3], box[5] });
  }
  return bounds;
}

template <typename Real>
void expectBounds(const AffineTransform& transform, const std::vector<Real>& xyz, std::size_t stride)
{
  const Bounds expected = plainBoundsOf(transform, xyz, stride);
  for (const InstructionSet set : heldInstructionSets())
  {
    const Bounds box = boundsOf(kernelsFor(set), transform, xyz, stride);
    ASSERT_EQ(box.minimum, expected.minimum) << int(set);
    ASSERT_EQ(box.maximum, expected.maximum) << int(set);
  }
}

/// Clouds whose extremes, and what is not finite, are anywhere: at the ends of vectors, blocks and the cloud.
/// Between points are numbers that are none of theirs, and nothing is behind the last one's z.
template <typename Real>
void tryBounds(const AffineTransform& transform, std::size_t stride)
{
  trial::Random random(8);
  for (const std::size_t size : { 0, 1, 15, 16, 17, 1023, 1024, 1025, 2048, 5000 })
  {
    SCOPED_TRACE(size);
    for (int i = 0; i < 60; ++i)
    {
      std::vector<Real> xyz(size > 0 ? stride * size - (stride - 3) : 0);
      for (Real& x : xyz)
      {
        x = Real(random.uniform(-1, 1));
      }
      for (int extreme = 0; size > 0 && extreme < i % 7; ++extreme)
      {
        xyz[random.below(xyz.size())] = Real(random.uniform(-9, 9));
      }
      for (int broken = 0; size > 0 && broken < i % 3; ++broken)
      {
        const double values[] = { NAN, INFINITY, -INFINITY, sizeof(Real) == 8 ? 1e300 : 9.0 };
        xyz[random.below(xyz.size())] = Real(values[random.below(4)]);
      }
      for (std::size_t at = 0; at < xyz.size(); ++at)
      {
        xyz[at] = at % stride < 3 ? xyz[at] : i % 2 ? Real(99) : Real(NAN);
      }
      ASSERT_NO_FATAL_FAILURE(expectBounds(transform, xyz, stride));
    }
  }
}

} // namespace

TEST(BoundsKernel, FindsTheBoxOfTheFinitePoints)
{
  AffineTransform mirror = AffineTransform::scaling({ -1.7, 1e20, 0.3 });
  mirror.m[0][3] = 0.1;
  mirror.m[2][3] = -1e7;
  AffineTransform shear = mirror;
  shear.m[1][2] = 2.5;
  for (const AffineTransform& transform : { AffineTransform(), mirror, shear })
  {
    for (const std::size_t stride : { 3, 4, 8 })
    {
      SCOPED_TRACE(transform.m[1][2]);
      SCOPED_TRACE(stride);
      ASSERT_NO_FATAL_FAILURE(tryBounds<float>(transform, stride));
      ASSERT_NO_FATAL_FAILURE(tryBounds<double>(transform, stride));
    }
  }
}
