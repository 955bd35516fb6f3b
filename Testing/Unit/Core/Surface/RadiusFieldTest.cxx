#include "Core/Surface/RadiusField.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pointhaptics;

namespace
{

constexpr double kVoxel = 1e-3;

CellPyramid sheet()
{
  std::vector<Cell> cells;
  for (const Vec3& p : trial::randomBox(20000, 1, { 0, 0, 0 }, { 0.1, 0.1, 0 }))
  {
    Cell cell;
    cell.mean = p;
    cells.push_back(cell);
  }
  CellPyramid pyramid;
  EXPECT_EQ(pyramid.build(cells, kVoxel), Status::Ok);
  return pyramid;
}

LocalScale scaleOf(double radius, double gate)
{
  LocalScale scale;
  scale.radius = radius;
  scale.gate = gate;
  return scale;
}

std::size_t nodes(const CellPyramid& pyramid)
{
  return pyramid.level(RadiusField::nodeLevel(pyramid)).cells.size();
}

} // namespace

TEST(RadiusField, IsTypicalFarFromEveryNode)
{
  const CellPyramid pyramid = sheet();
  std::vector<LocalScale> values(nodes(pyramid), scaleOf(0.003, 0.001));
  for (std::size_t i = 0; i < values.size() / 3; ++i)
  {
    values[i] = scaleOf(0.004, 0.002);
  }
  RadiusField field;
  field.build(pyramid, values);
  EXPECT_EQ(field.typical().radius, 0.003);
  EXPECT_EQ(field.typical().gate, 0.001);
  EXPECT_EQ(field.at(pyramid, { 0.05, 0.05, 2 * field.reach() }).radius, 0.003);
  EXPECT_EQ(field.at(pyramid, { 1e6, -1e6, 0 }).radius, 0.003);
  EXPECT_GT(field.reach(), 8 * kVoxel);
}

TEST(RadiusField, AJumpOfRadiiIsCutToHalfTheDistance)
{
  const CellPyramid pyramid = sheet();
  const std::vector<Cell>& cells = pyramid.level(RadiusField::nodeLevel(pyramid)).cells;
  std::vector<LocalScale> values;
  for (const Cell& cell : cells)
  {
    values.push_back(scaleOf(cell.mean.x < 0.05 ? 0.001 : 0.05, 0.0));
  }
  RadiusField field;
  field.build(pyramid, values);
  // Far on the left nothing changes; on the right the radius rises with a slope near 1/2, never a jump.
  EXPECT_NEAR(field.at(pyramid, { 0.01, 0.05, 0 }).radius, 0.001, 1e-12);
  EXPECT_LT(field.at(pyramid, { 0.06, 0.05, 0 }).radius, 0.001 + 0.5 * 0.03);
  double last = field.at(pyramid, { 0.03, 0.05, 0 }).radius;
  for (double x = 0.03; x < 0.1; x += 1e-4)
  {
    const double radius = field.at(pyramid, { x, 0.05, 0 }).radius;
    EXPECT_LE(std::fabs(radius - last), 1.5e-4) << "at " << x;
    last = radius;
  }
}

TEST(RadiusField, IsContinuousAcrossTheReachOfItsNodes)
{
  const CellPyramid pyramid = sheet();
  trial::Random random(5);
  std::vector<LocalScale> values;
  for (std::size_t i = 0; i < nodes(pyramid); ++i)
  {
    values.push_back(scaleOf(random.uniform(0.002, 0.004), random.uniform(0.0, 0.001)));
  }
  RadiusField field;
  field.build(pyramid, values);
  for (const Vec3& p : trial::randomBox(500, 6, { 0, 0, -0.005 }, { 0.1, 0.1, 0.005 }))
  {
    const double here = field.at(pyramid, p).radius;
    for (const Vec3& step : { Vec3(1e-9, 0, 0), Vec3(0, 1e-9, 0), Vec3(0, 0, 1e-9) })
    {
      EXPECT_LE(std::fabs(field.at(pyramid, p + step).radius - here), 3e-9);
    }
  }
}
