#include "Core/Surface/CellPyramid.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

using namespace pointhaptics;

namespace
{

Cell cellAt(const Vec3& mean, double count = 1.0, const SymMat3& covariance = {})
{
  Cell cell;
  cell.mean = mean;
  cell.count = count;
  cell.covariance = covariance;
  return cell;
}

/// Cells on a wavy sheet and in a lump, with counts and covariances of their own.
std::vector<Cell> variedCells(std::size_t n, std::uint64_t seed)
{
  trial::Random random(seed);
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double x = random.uniform(-0.02, 0.03);
    const double y = random.uniform(-0.02, 0.03);
    const double z = i % 5 == 0 ? random.uniform(0.0, 0.01) : 0.003 * std::sin(200 * x) + 5.0;
    SymMat3 covariance = outerProduct(random.uniform(0, 1e-4) * random.direction());
    covariance += outerProduct(random.uniform(0, 1e-4) * random.direction());
    cells.push_back(cellAt({ x, y, z - 5.0 * (i % 5 != 0) }, 1.0 + double(random.below(40)), covariance));
  }
  return cells;
}

CellPyramid pyramidOf(const std::vector<Cell>& cells, double voxelSize)
{
  CellPyramid pyramid;
  EXPECT_EQ(pyramid.build(cells, voxelSize), Status::Ok);
  return pyramid;
}

/// The sums of a set of cells about the origin, in long double.
struct Moments
{
  long double count = 0;
  long double first[3] = { 0, 0, 0 };
  long double second[6] = { 0, 0, 0, 0, 0, 0 };

  void add(const Cell& cell)
  {
    const long double n = cell.count;
    const long double m[3] = { cell.mean.x, cell.mean.y, cell.mean.z };
    const SymMat3& c = cell.covariance;
    const double central[6] = { c.xx, c.yy, c.zz, c.xy, c.yz, c.xz };
    const long double outer[6] = { m[0] * m[0], m[1] * m[1], m[2] * m[2], m[0] * m[1], m[1] * m[2],
      m[0] * m[2] };
    count += n;
    for (int i = 0; i < 3; ++i)
    {
      first[i] += n * m[i];
    }
    for (int i = 0; i < 6; ++i)
    {
      second[i] += n * (central[i] + outer[i]);
    }
  }
  Cell cell() const
  {
    const long double m[3] = { first[0] / count, first[1] / count, first[2] / count };
    const SymMat3 c{ double(second[0] / count - m[0] * m[0]), double(second[1] / count - m[1] * m[1]),
      double(second[2] / count - m[2] * m[2]), double(second[3] / count - m[0] * m[1]),
      double(second[4] / count - m[1] * m[2]), double(second[5] / count - m[0] * m[2]) };
    return cellAt({ double(m[0]), double(m[1]), double(m[2]) }, double(count), c);
  }
};

void expectSameMoments(const Cell& a, const Cell& b)
{
  ASSERT_DOUBLE_EQ(a.count, b.count);
  ASSERT_LE(norm(a.mean - b.mean), 1e-16);
  const double tolerance = 1e-12 * 1e-4;
  ASSERT_NEAR(a.covariance.xx, b.covariance.xx, tolerance);
  ASSERT_NEAR(a.covariance.yy, b.covariance.yy, tolerance);
  ASSERT_NEAR(a.covariance.zz, b.covariance.zz, tolerance);
  ASSERT_NEAR(a.covariance.xy, b.covariance.xy, tolerance);
  ASSERT_NEAR(a.covariance.yz, b.covariance.yz, tolerance);
  ASSERT_NEAR(a.covariance.xz, b.covariance.xz, tolerance);
}

using Voxel = std::array<std::int64_t, 3>;

/// Every occupied voxel of a level with the range of its cells.
template <typename Visitor>
void forEachVoxel(const CellPyramid::Level& level, Visitor&& visit)
{
  for (const CellPyramid::Brick& brick : level.bricks)
  {
    std::uint32_t slot = brick.slot;
    for (int bit = 0; bit < 64; ++bit)
    {
      if ((brick.mask >> bit & 1) == 0)
      {
        continue;
      }
      const auto along = [bit](int axis) { return (bit >> axis & 1) | (bit >> (axis + 3) & 1) << 1; };
      const Voxel voxel{ 4 * std::int64_t(brick.x) + along(0), 4 * std::int64_t(brick.y) + along(1),
        4 * std::int64_t(brick.z) + along(2) };
      const bool ranged = !level.slotBegin.empty();
      visit(voxel, ranged ? level.slotBegin[slot] : slot, ranged ? level.slotBegin[slot + 1] : slot + 1);
      ++slot;
    }
  }
}

} // namespace

TEST(MergedCell, HasTheMomentsOfTheUnion)
{
  trial::Random random(1);
  for (int i = 0; i < 200; ++i)
  {
    const std::vector<Cell> cells = variedCells(2, random.below(100000));
    Moments expected;
    expected.add(cells[0]);
    expected.add(cells[1]);
    expectSameMoments(merged(cells[0], cells[1]), expected.cell());
  }
}

TEST(MergedCell, OfTwoPointsHasTheirSpread)
{
  const Cell cell = merged(cellAt({ 0, 0, 0 }), cellAt({ 2, 0, 0 }));
  EXPECT_EQ(cell.count, 2.0);
  EXPECT_EQ(cell.mean, Vec3(1, 0, 0));
  EXPECT_EQ(cell.covariance.xx, 1.0);
  EXPECT_EQ(cell.covariance.yy, 0.0);
}

TEST(CellPyramid, KeepsEveryCell)
{
  const std::vector<Cell> cells = variedCells(3000, 2);
  const CellPyramid pyramid = pyramidOf(cells, 1e-3);
  const auto contentOf = [](const std::vector<Cell>& given)
  {
    std::multiset<std::array<double, 4>> content;
    for (const Cell& cell : given)
    {
      content.insert({ cell.mean.x, cell.mean.y, cell.mean.z, cell.count });
    }
    return content;
  };
  EXPECT_EQ(contentOf(pyramid.level(0).cells), contentOf(cells));
}

TEST(CellPyramid, VoxelsDoubleFromLevelToLevel)
{
  const CellPyramid pyramid = pyramidOf(variedCells(3000, 3), 1e-3);
  ASSERT_GT(pyramid.numberOfLevels(), 1);
  for (int l = 0; l < pyramid.numberOfLevels(); ++l)
  {
    EXPECT_DOUBLE_EQ(pyramid.level(l).voxelSize, std::ldexp(1e-3, l));
  }
}

TEST(CellPyramid, MergesMomentsExactlyOnEveryLevel)
{
  const CellPyramid pyramid = pyramidOf(variedCells(5000, 4), 1e-3);
  std::map<Voxel, std::vector<Cell>> finest;
  forEachVoxel(pyramid.level(0),
    [&](const Voxel& voxel, std::uint32_t begin, std::uint32_t end)
    {
      const auto& cells = pyramid.level(0).cells;
      finest[voxel] = { cells.begin() + begin, cells.begin() + end };
    });
  for (int l = 1; l < pyramid.numberOfCellLevels(); ++l)
  {
    std::map<Voxel, Moments> expected;
    for (const auto& entry : finest)
    {
      Moments& moments = expected[{ entry.first[0] >> l, entry.first[1] >> l, entry.first[2] >> l }];
      for (const Cell& cell : entry.second)
      {
        moments.add(cell);
      }
    }
    std::size_t voxels = 0;
    forEachVoxel(pyramid.level(l),
      [&](const Voxel& voxel, std::uint32_t begin, std::uint32_t end)
      {
        ++voxels;
        ASSERT_EQ(end, begin + 1);
        ASSERT_EQ(expected.count(voxel), 1u);
        expectSameMoments(pyramid.level(l).cells[begin], expected[voxel].cell());
      });
    EXPECT_EQ(voxels, expected.size()) << "level " << l;
  }
}

TEST(CellPyramid, BallEqualsBruteForceOnEveryLevel)
{
  const CellPyramid pyramid = pyramidOf(variedCells(4000, 5), 1e-3);
  for (int l = 0; l < pyramid.numberOfCellLevels(); ++l)
  {
    const std::vector<Cell>& cells = pyramid.level(l).cells;
    std::vector<Vec3> centers = trial::randomBox(40, 6, { -0.03, -0.03, -0.01 }, { 0.04, 0.04, 0.02 });
    centers.push_back(cells[cells.size() / 2].mean);
    for (const Vec3& center : centers)
    {
      for (const double radius : { 1e-4, 1e-3, 6e-3, 1.0 })
      {
        std::vector<std::size_t> found;
        pyramid.visitBall(l, center, radius,
          [&](std::uint32_t index, const Cell& cell, double d2)
          {
            EXPECT_EQ(&cell, &cells[index]);
            EXPECT_EQ(d2, norm2(cell.mean - center));
            found.push_back(index);
          });
        std::sort(found.begin(), found.end());
        std::vector<std::size_t> expected;
        for (std::size_t i = 0; i < cells.size(); ++i)
        {
          if (norm2(cells[i].mean - center) < radius * radius)
          {
            expected.push_back(i);
          }
        }
        ASSERT_EQ(found, expected) << "level " << l << " radius " << radius;
        EXPECT_EQ(pyramid.anyWithin(l, center, radius, [](const Cell&) { return true; }), !expected.empty());
        EXPECT_FALSE(pyramid.anyWithin(l, center, radius, [](const Cell&) { return false; }));
        const Cell* const last = expected.empty() ? nullptr : &cells[expected.back()];
        EXPECT_EQ(pyramid.anyWithin(l, center, radius, [&](const Cell& cell) { return &cell == last; }),
          last != nullptr);
      }
    }
  }
}

TEST(CellPyramid, UnmixedBallPartitionsTheCountsOnEveryLevel)
{
  const std::vector<Cell> cells = variedCells(4000, 7);
  const CellPyramid pyramid = pyramidOf(cells, 1e-3);
  Moments expected;
  for (const Cell& cell : cells)
  {
    expected.add(cell);
  }
  for (int l = 0; l < pyramid.numberOfCellLevels(); ++l)
  {
    Moments found;
    bool anyMixed = false;
    pyramid.visitBallUnmixed(l, { 0, 0, 0 }, 10.0,
      [&](const Cell& cell, double)
      {
        found.add(cell);
        anyMixed = anyMixed || (cell.mixed && cell.count > 1e9);
      });
    EXPECT_EQ(double(found.count), double(expected.count)) << "level " << l;
    expectSameMoments(found.cell(), expected.cell());
  }
}

TEST(CellPyramid, TwoSheetsInOneVoxelAreMixedAndOneSheetIsNot)
{
  trial::Random random(8);
  std::vector<Cell> one;
  std::vector<Cell> two;
  for (int i = 0; i < 4000; ++i)
  {
    const Vec3 p = random.inBox({ 0, 0, 0 }, { 0.02, 0.02, 0 });
    one.push_back(cellAt(p));
    two.push_back(cellAt(p));
    two.push_back(cellAt(p + Vec3(0, 0, 0.0011)));
  }
  const auto mixedShare = [](const CellPyramid& pyramid, int level)
  {
    double mixed = 0;
    for (const Cell& cell : pyramid.level(level).cells)
    {
      mixed += cell.mixed;
    }
    return mixed / double(pyramid.level(level).cells.size());
  };
  EXPECT_EQ(mixedShare(pyramidOf(one, 5e-4), 2), 0.0);
  EXPECT_GT(mixedShare(pyramidOf(two, 5e-4), 3), 0.5);
}

TEST(CellPyramid, ReclassifiesMixedCellsWhoseThicknessIsNoise)
{
  constexpr double kNoise = 1e-4;
  trial::Random random(18);
  std::vector<Cell> noisy;
  std::vector<Cell> apart;
  for (int i = 0; i < 20000; ++i)
  {
    const Vec3 p = random.inBox({ 0, 0, 0 }, { 0.02, 0.02, 0 });
    noisy.push_back(cellAt(p + Vec3(0, 0, kNoise * random.normal())));
    apart.push_back(cellAt(p + Vec3(0, 0, 0.0005 + 0.0011 * (i % 2))));
  }
  const auto mixedCells = [](const CellPyramid& pyramid, int level)
  {
    const std::vector<Cell>& cells = pyramid.level(level).cells;
    return std::count_if(cells.begin(), cells.end(), [](const Cell& cell) { return cell.mixed; });
  };
  CellPyramid sheet = pyramidOf(noisy, 2.5e-4);
  CellPyramid sheets = pyramidOf(apart, 5e-4);
  const auto noisyBefore = mixedCells(sheet, 1);
  const auto apartBefore = mixedCells(sheets, 3);
  ASSERT_GT(noisyBefore, 0);
  ASSERT_GT(apartBefore, 0);
  const auto noise = [](const Vec3&) { return kNoise; };
  sheet.reclassifyMixedCells(noise);
  sheets.reclassifyMixedCells(noise);
  EXPECT_LE(mixedCells(sheet, 1), noisyBefore / 100);
  EXPECT_EQ(mixedCells(sheets, 3), apartBefore);
}

TEST(CellPyramid, NearestEqualsBruteForce)
{
  const CellPyramid pyramid = pyramidOf(variedCells(2000, 9), 1e-3);
  for (int l = 0; l < pyramid.numberOfCellLevels(); ++l)
  {
    const std::vector<Cell>& cells = pyramid.level(l).cells;
    for (const Vec3& center : trial::randomBox(200, 10, { -0.03, -0.03, -0.01 }, { 0.04, 0.04, 0.02 }))
    {
      std::int64_t expected = -1;
      double best = 0.01 * 0.01;
      for (std::size_t i = 0; i < cells.size(); ++i)
      {
        const double d2 = norm2(cells[i].mean - center);
        if (d2 < best)
        {
          best = d2;
          expected = std::int64_t(i);
        }
      }
      double distance = -1.0;
      ASSERT_EQ(pyramid.nearest(l, center, 0.01, distance), expected);
      if (expected >= 0)
      {
        ASSERT_NEAR(distance, std::sqrt(best), 1e-15);
      }
    }
  }
}

TEST(CellPyramid, HoldsSmallAndDegenerateClouds)
{
  for (const std::size_t n : { 1, 2, 11 })
  {
    const CellPyramid lone = pyramidOf(variedCells(n, 11), 1e-3);
    int seen = 0;
    lone.visitBall(0, { 0, 0, 0 }, 1.0, [&](std::uint32_t, const Cell&, double) { ++seen; });
    EXPECT_EQ(seen, int(n));
  }
  const CellPyramid pile = pyramidOf(std::vector<Cell>(100, cellAt({ 1, 2, 3 })), 1e-3);
  EXPECT_EQ(pile.level(0).cells.size(), 100u);
  EXPECT_EQ(pile.level(0).slotBegin.size(), 2u);
}

TEST(CellPyramid, HoldsMapCoordinates)
{
  std::vector<Cell> cells = variedCells(2000, 12);
  for (Cell& cell : cells)
  {
    cell.mean += Vec3(512700, 5403547, 300);
  }
  const CellPyramid pyramid = pyramidOf(cells, 1e-3);
  for (int l = 0; l < pyramid.numberOfCellLevels(); ++l)
  {
    double count = 0;
    pyramid.visitBall(
      l, { 512700, 5403547, 300 }, 1.0, [&](std::uint32_t, const Cell& c, double) { count += c.count; });
    double expected = 0;
    for (const Cell& cell : cells)
    {
      expected += cell.count;
    }
    EXPECT_EQ(count, expected);
  }
}

TEST(CellPyramid, RefusesWhatItCannotHold)
{
  CellPyramid pyramid;
  EXPECT_EQ(pyramid.build({}, 1e-3), Status::Empty);
  for (const double size : { 0.0, -1.0, double(NAN), double(INFINITY) })
  {
    EXPECT_EQ(pyramid.build({ cellAt({ 0, 0, 0 }) }, size), Status::InvalidVoxelSize) << size;
  }
  EXPECT_EQ(pyramid.build({ cellAt({ 0, 0, 0 }), cellAt({ 1, 0, 0 }) }, 1e-9), Status::LatticeNotAddressable);
}

TEST(CellPyramid, RefusesACornerThatAMeanIsBelow)
{
  CellPyramid pyramid;
  const Vec3 corner{ 0.0, 0.0, 0.5 };
  EXPECT_EQ(pyramid.build({ cellAt({ 1, 1, 1 }) }, 0.1, &corner), Status::Ok);
  EXPECT_EQ(pyramid.numberOfCellLevels(), CellPyramid::kCellLevels);
  EXPECT_EQ(pyramid.build({ cellAt({ 1, 1, 0.4 }) }, 0.1, &corner), Status::InvalidParameter);
  EXPECT_EQ(pyramid.build({ cellAt({ 1, 1, 1 }) }, 1e-7, &corner), Status::LatticeNotAddressable);
}
