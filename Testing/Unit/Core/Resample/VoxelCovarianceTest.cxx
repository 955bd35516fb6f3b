// Sums of products in 64-bit words and covariances from them, against 128-bit integers: bit for bit.
#include "Core/Resample/Stages/VoxelWriter.h"

#include "RandomClouds.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::simd;
using trial::Random;

namespace
{

const std::vector<InstructionSet> kSets = heldInstructionSets();
constexpr std::size_t kEdge = 4;
constexpr std::size_t kCells = kEdge * kEdge;

struct Places
{
  std::uint64_t x, y, z;
};

/// Points of the cells of a square of them: on each side of the vectors' width.
using Cells = std::vector<std::vector<Places>>;

/// Places all over the cell, or in a piece of it of @p spread.
Cells randomCells(std::size_t points, double spread, int fractionBits, std::uint64_t seed)
{
  Random random(seed);
  Cells cells(kCells);
  const double all = std::ldexp(1.0, fractionBits);
  for (std::size_t c = 0; c < kCells; ++c)
  {
    const Vec3 corner = random.inBox({}, (1.0 - spread) * Vec3(1, 1, 1));
    for (std::size_t i = 0; i < points + c; ++i)
    {
      const Vec3 p = all * (corner + random.inBox({}, spread * Vec3(1, 1, 1)));
      cells[c].push_back({ std::uint64_t(p.x), std::uint64_t(p.y), std::uint64_t(p.z) });
    }
  }
  return cells;
}

PointRecord recordOf(std::size_t cell, const Places& p, int fractionBits)
{
  const std::uint64_t x = (std::uint64_t(cell % kEdge) << fractionBits) + p.x;
  const std::uint64_t y = (std::uint64_t(cell / kEdge) << fractionBits) + p.y;
  return { (x << kLowBits) | (p.z & kLowMask), (y << kLowBits) | (p.z >> kLowBits) };
}

struct Sums
{
  std::vector<PackedSums> packed;
  std::vector<SecondMoments> secondMoments;
};

Sums sumsOf(const Kernels& kernels, const Cells& cells, int fractionBits)
{
  std::size_t size = 0;
  for (const std::vector<Places>& points : cells)
  {
    size += points.size();
  }
  Buffer<PointRecord> records; // aligned, as kernels want them
  records.reserve(size);
  size = 0;
  for (std::size_t c = 0; c < cells.size(); ++c)
  {
    for (const Places& p : cells[c])
    {
      records[size++] = recordOf(c, p, fractionBits);
    }
  }
  const CellMap map = { fractionBits, kEdge, kEdge, 0, 0 };
  std::uint64_t occupancy = 0;
  std::uint32_t rankTable = 0;
  const CellRanks ranks = { &occupancy, &rankTable, 1 };
  std::vector<std::uint32_t> cellsOf(size);
  kernels.cells(map, records.data(), int(size), records.data(), cellsOf.data());
  kernels.setOccupied(cellsOf.data(), int(size), &occupancy);
  EXPECT_EQ(kernels.rankWords(ranks, nullptr), kCells);
  Sums sums = { std::vector<PackedSums>(kCells + kWidest, PackedSums{}),
    std::vector<SecondMoments>(kCells + kWidest, SecondMoments{}) };
  std::vector<std::uint32_t> order(kCells);
  kernels.accumulate(map, ranks, records.data(), cellsOf.data(), int(size), records.data(),
    { order.data(), sums.packed.data(), sums.secondMoments.data() });
  return sums;
}

struct WideVoxel
{
  std::int64_t count = 0;
  Int128 sums[3] = { 0, 0, 0 };
  SecondMoments secondMoments = { { 0, 0, 0, 0, 0, 0 } };
};

WideVoxel wideSumsOf(const std::vector<Places>& points)
{
  WideVoxel wide;
  for (const Places& p : points)
  {
    ++wide.count;
    wide.sums[0] += Int128(p.x);
    wide.sums[1] += Int128(p.y);
    wide.sums[2] += Int128(p.z);
    addProducts(wide.secondMoments, p.x, p.y, p.z);
  }
  return wide;
}

void expectSameAsWide(const Cells& cells, int fractionBits, bool allFit)
{
  const Vec3 spacing(0.1, 3.0, 0.7);
  const double quantum = std::ldexp(1.0, -fractionBits);
  const Vec3 unit = quantum * spacing;
  const CovarianceMap map = { fractionBits, { unit.x, unit.y, unit.z } };
  for (const InstructionSet set : kSets)
  {
    const Kernels& kernels = kernelsFor(set);
    const Sums sums = sumsOf(kernels, cells, fractionBits);
    SymMat3 got[kCells];
    int full[kCells];
    const int found =
      kernels.covariances(map, sums.packed.data(), sums.secondMoments.data(), int(kCells), &got[0].xx, full);
    EXPECT_EQ(found, allFit ? 0 : int(kCells));
    for (std::size_t c = 0; c < kCells; ++c)
    {
      const WideVoxel wide = wideSumsOf(cells[c]);
      const SecondMoments& secondMoments = sums.secondMoments[c];
      for (int m = 0; m < 6; ++m)
      {
        ASSERT_TRUE(secondMoments.lanes[m] == wide.secondMoments.lanes[m]) << "cell " << c << " sum " << m;
      }
      const SymMat3 expected = covarianceOf(wide.count, wide.sums, wide.secondMoments, quantum, spacing);
      ASSERT_TRUE(!allFit || std::memcmp(&got[c], &expected, sizeof expected) == 0) << "cell " << c;
    }
  }
}

}

TEST(VoxelCovariance, IsThatOfWideIntegersForEveryCountSpreadAndQuantum)
{
  for (const int fractionBits : { 31, 32, 34, 38 })
  {
    for (const std::size_t points : { 1, 2, 3, 40, 490 })
    {
      for (const double spread : { 1.0, 0.3, 1e-4, 1e-7, 0.0 })
      {
        SCOPED_TRACE(testing::Message() << fractionBits << " bits, " << points << " points, " << spread);
        // 512 points of 38 bits are the most that fit.
        const std::size_t count = fractionBits == 38 ? points - points / 40 : points;
        expectSameAsWide(randomCells(count, spread, fractionBits, 17 * points), fractionBits, true);
      }
    }
  }
}

TEST(VoxelCovariance, IsRightWhereThePointsAreInOppositeCorners)
{
  for (const int fractionBits : { 31, 34, 38 })
  {
    const std::uint64_t most = (std::uint64_t(1) << fractionBits) - 1;
    Cells cells(kCells, { { 0, 0, 0 }, { most, most, most }, { most, 0, most }, { 0, most, 0 } });
    for (std::size_t c = 0; c < kCells; ++c)
    {
      cells[c].insert(cells[c].end(), c, { most, 0, 0 });
    }
    expectSameAsWide(cells, fractionBits, true);
  }
}

TEST(VoxelCovariance, ListsVoxelsWithTooManyPoints)
{
  // 8 points of 41 bits, 2^7 of 39, are the most whose central sums surely fit.
  expectSameAsWide(randomCells(9, 1.0, 41, 5), 41, false);
  expectSameAsWide(randomCells(129, 1.0, 39, 6), 39, false);
}
