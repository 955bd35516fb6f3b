#include "Core/Surface/FitCells.h"
#include "Core/Surface/RadiusField.h"
#include "Core/Surface/SurfaceFit.h"

#include "RandomClouds.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <memory>

using namespace pointhaptics;

namespace
{

/// Single points about z = 5 x y, @p perSquare of them a square metre.
CellPyramid saddle(int n, double voxelSize)
{
  trial::Random random(1);
  std::vector<Cell> cells(static_cast<std::size_t>(n));
  for (Cell& cell : cells)
  {
    const Vec3 p = random.inBox({ -0.03, -0.03, -1e-5 }, { 0.03, 0.03, 1e-5 });
    cell.mean = { p.x, p.y, 5.0 * p.x * p.y + p.z };
    cell.count = 1.0 + double(random.below(5));
    cell.covariance.xx = 1e-9 * random.uniform();
    cell.covariance.yy = 1e-9;
    cell.covariance.xz = 1e-10 * random.uniform();
  }
  CellPyramid pyramid;
  EXPECT_EQ(pyramid.build(cells, voxelSize), Status::Ok);
  return pyramid;
}

struct Look
{
  SurfaceFrame frame;
  FitSettings settings;
  TracedSlopes slopes;
};

Look lookAt(double x, double y, double radius)
{
  Look look;
  look.frame.origin = { x, y, 5.0 * x * y };
  look.frame.turnTo(normalized(Vec3(-5.0 * y, -5.0 * x, 1.0)));
  look.settings.radius = radius;
  look.settings.gate = 4e-5;
  look.slopes.strength = 1.0;
  look.slopes.radiusGradient = { 0.1, -0.2, 0.05 };
  return look;
}

} // namespace

TEST(FitCells, FitsAreTheSameBitsWithEveryInstructionSet)
{
  SKIP_WITHOUT_OTHER_INSTRUCTION_SETS();
  const CellPyramid pyramid = saddle(40000, 5e-4);
  const auto plain = std::make_unique<FitCells>(InstructionSet::Baseline);
  for (const InstructionSet set : heldInstructionSets())
  {
    const auto fast = std::make_unique<FitCells>(set);
    for (const double radius : { 1.2e-3, 2.7e-3, 6e-3 })
    {
      const Look look = lookAt(0.004, -0.003, radius);
      const SurfaceFit expected = fitSurface(pyramid, look.frame, look.settings, *plain, &look.slopes);
      const SurfaceFit found = fitSurface(pyramid, look.frame, look.settings, *fast, &look.slopes);
      ASSERT_EQ(expected.quality, FitQuality::Quadric);
      for (int i = 0; i < 6; ++i)
      {
        EXPECT_EQ(found.k[i], expected.k[i]) << i;
      }
      EXPECT_EQ(found.residual, expected.residual);
      EXPECT_EQ(found.cells, expected.cells);
    }
  }
}

TEST(FitCells, AKeptNeighbourhoodGivesTheFitOfAFreshOne)
{
  const CellPyramid pyramid = saddle(40000, 5e-4);
  const auto kept = std::make_unique<FitCells>();
  const auto fresh = std::make_unique<FitCells>();
  for (int i = 0; i < 400; ++i)
  {
    // The radius passes through two levels and both blends between them.
    const Look look = lookAt(-0.01 + 5e-5 * i, 0.002 + 2e-5 * i, 1.5e-3 + 1e-5 * i);
    fresh->invalidate();
    const SurfaceFit expected = fitSurface(pyramid, look.frame, look.settings, *fresh, &look.slopes);
    const SurfaceFit found = fitSurface(pyramid, look.frame, look.settings, *kept, &look.slopes);
    ASSERT_EQ(found.cells, expected.cells) << i;
    for (int c = 0; c < 6; ++c)
    {
      ASSERT_NEAR(found.k[c], expected.k[c], 1e-11) << i;
    }
  }
}

TEST(FitCells, TakesCoarserCellsWhereABlockIsTooSmallAndSaysSo)
{
  const CellPyramid pyramid = saddle(200000, 1e-3);
  const auto memory = std::make_unique<FitCells>();
  int level = 0;
  const simd::FitBlock& block = memory->near(pyramid, level, Vec3(), 4e-3);
  EXPECT_TRUE(memory->overflowed());
  EXPECT_GT(level, 0);
  EXPECT_GT(block.size, 0);
  EXPECT_LE(block.size, simd::FitBlock::kCapacity);
  double count = 0.0;
  double expected = 0.0;
  for (int i = 0; i < block.size; ++i)
  {
    const Vec3 p{ block.x[i], block.y[i], block.z[i] };
    count += norm(p) < 3e-3 ? block.count[i] : 0.0;
  }
  pyramid.visitBallUnmixed(level, Vec3(), 3e-3, [&](const Cell& cell, double) { expected += cell.count; });
  EXPECT_EQ(count, expected) << "all of them, none twice";
  memory->clearOverflow();
  level = 0;
  memory->near(pyramid, level, Vec3(), 1e-3);
  EXPECT_FALSE(memory->overflowed());
  EXPECT_EQ(level, 0);
}

TEST(FitCells, ScalesAreThoseOfTheField)
{
  const CellPyramid pyramid = saddle(40000, 5e-4);
  const std::size_t nodes = pyramid.level(RadiusField::nodeLevel(pyramid)).cells.size();
  trial::Random random(3);
  std::vector<LocalScale> values(nodes);
  for (LocalScale& value : values)
  {
    value.radius = random.uniform(1e-3, 4e-3);
    value.gate = random.uniform(1e-4, 4e-4);
    value.countRadius = random.uniform(1e-3, 2e-3);
    value.proxyRadius = random.uniform(2e-3, 5e-3);
    value.noise = random.uniform(1e-4, 5e-4);
  }
  RadiusField field;
  field.build(pyramid, values);
  const auto memory = std::make_unique<FitCells>();
  for (int i = 0; i < 2000; ++i)
  {
    const Vec3 p = i % 3 == 0 ? random.inBox({ -0.05, -0.05, -0.05 }, { 0.05, 0.05, 0.05 })
                              : Vec3(-0.02 + 2e-5 * i, 1e-5 * i, 1e-3);
    Vec3 expectedGradient;
    Vec3 gradient;
    const LocalScale expected = field.at(pyramid, p, expectedGradient);
    const LocalScale found = memory->scaleAt(pyramid, field, p, gradient);
    // Where the last node fades out the weights are rounding: there only the order of magnitude is the same.
    if (norm2(pyramid.level(0).cells[0].mean - p) < 0.05 * 0.05 && std::abs(p.z) < 2e-3)
    {
      ASSERT_NEAR(found.radius, expected.radius, 1e-12) << i;
      ASSERT_NEAR(found.gate, expected.gate, 1e-12);
      ASSERT_NEAR(found.countRadius, expected.countRadius, 1e-12);
      ASSERT_NEAR(found.proxyRadius, expected.proxyRadius, 1e-12);
      ASSERT_NEAR(found.noise, expected.noise, 1e-12);
      ASSERT_LE(norm(gradient - expectedGradient), 1e-9);
    }
    ASSERT_GE(found.radius, 1e-3 * (1 - 1e-9));
    ASSERT_LE(found.radius, 4e-3 * (1 + 1e-9));
  }
}
