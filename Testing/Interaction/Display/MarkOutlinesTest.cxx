#include "MarkOutlines.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pointhaptics;

namespace
{

double lengthOf(const std::vector<ScreenSegment>& lines)
{
  double length = 0.0;
  for (const ScreenSegment& line : lines)
  {
    length += std::hypot(line.end[0] - line.begin[0], line.end[1] - line.begin[1]);
  }
  return length;
}

ScreenPolygon square(double left, double bottom, double edge)
{
  return { { left, bottom }, { left + edge, bottom }, { left + edge, bottom + edge },
    { left, bottom + edge } };
}

TEST(MarkOutlines, AHullHasTheOuterPointsCounterclockwise)
{
  const ScreenPolygon hull = convexHull({ { 0, 0 }, { 1, 1 }, { 2, 0 }, { 2, 2 }, { 0, 2 }, { 1, 0 } });
  EXPECT_EQ(hull, square(0.0, 0.0, 2.0));
  EXPECT_TRUE(convexHull({}).empty());
  EXPECT_EQ(convexHull({ { 3, 4 }, { 3, 4 } }).size(), 1u);
  EXPECT_EQ(convexHull({ { 0, 0 }, { 1, 1 }, { 2, 2 } }).size(), 2u) << "a line";
}

TEST(MarkOutlines, AHullAboutPointsKeepsItsDistance)
{
  for (const std::array<double, 2>& corner : hullAbout({ { 10, 20 } }, 3.0))
  {
    EXPECT_NEAR(std::hypot(corner[0] - 10.0, corner[1] - 20.0), 3.0, 1e-9);
  }
}

TEST(MarkOutlines, WhatLiesInAnotherShapeIsNotDrawn)
{
  EXPECT_DOUBLE_EQ(lengthOf(outlineOf({ square(0, 0, 4) })), 16.0);
  EXPECT_DOUBLE_EQ(lengthOf(outlineOf({ square(0, 0, 4), square(10, 0, 4) })), 32.0);
  EXPECT_DOUBLE_EQ(lengthOf(outlineOf({ square(0, 0, 4), square(1, 1, 2) })), 16.0) << "one within the other";
  EXPECT_DOUBLE_EQ(lengthOf(outlineOf({ square(0, 0, 4), square(2, 2, 4) })), 24.0);
  // A bar across a square leaves four corners of that and two ends of the bar.
  const ScreenPolygon bar = { { -2, 1 }, { 6, 1 }, { 6, 3 }, { -2, 3 } };
  EXPECT_DOUBLE_EQ(lengthOf(outlineOf({ square(0, 0, 4), bar })), 12.0 + 12.0);
}

} // namespace
