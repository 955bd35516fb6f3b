#include "Core/Base/QuantityText.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{

using namespace pointhaptics;

TEST(QuantityText, SwitchesTheUnitOfALengthInsteadOfShowingZeros)
{
  EXPECT_EQ(lengthText(12.0), "12 m");
  EXPECT_EQ(lengthText(0.31), "0.31 m");
  EXPECT_EQ(lengthText(0.0349), "34.9 mm");
  EXPECT_EQ(lengthText(0.000345), "0.345 mm");
  EXPECT_EQ(lengthText(0.0000871), "87.1 um");
  EXPECT_EQ(lengthText(2.5e-8), "25 nm");
  EXPECT_EQ(lengthText(1.1e-11), "11 pm");
  EXPECT_EQ(lengthText(1234.0), "1.23 km");
  EXPECT_EQ(lengthText(-0.0349), "-34.9 mm");
  EXPECT_EQ(lengthText(0.0), "0 mm");
  EXPECT_EQ(lengthText(1e-15), "1.0e-15 m");
  EXPECT_EQ(lengthText(std::numeric_limits<double>::quiet_NaN()), "unknown");
}

TEST(QuantityText, RoundsToTheDigitsWithoutAnExponent)
{
  EXPECT_EQ(lengthText(12.19, 2), "12 m");
  EXPECT_EQ(lengthText(384.0, 2), "380 m");
  EXPECT_EQ(lengthText(999.4), "999 m");
  EXPECT_EQ(lengthText(999.6), "1 km");
  EXPECT_EQ(lengthText(5.4321e6), "5,432 km");
}

TEST(QuantityText, KeepsTheUnitOfTheFileWhereItCanBeRead)
{
  EXPECT_EQ(lengthText(0.3048, "ft", 0.3048), "1 ft");
  EXPECT_EQ(lengthText(12.0 * 0.3048, "ft", 0.3048, 2), "12 ft");
  EXPECT_EQ(lengthText(1e-4 * 0.3048, "ft", 0.3048, 2), "30 um");
}

TEST(QuantityText, SaysRatiosAndCountsWithCommas)
{
  EXPECT_EQ(ratioText(12204.0), "12,200");
  EXPECT_EQ(ratioText(2.2222), "2.22");
  EXPECT_EQ(ratioText(1.0), "1");
  EXPECT_EQ(ratioText(999.7), "1,000");
  EXPECT_EQ(ratioText(46.04), "46");
  EXPECT_EQ(ratioText(3.0e16), "3.00e+16");
  EXPECT_EQ(countText(543652), "543,652");
  EXPECT_EQ(countText(999), "999");
  EXPECT_EQ(countText(0), "0");
  EXPECT_EQ(countText(-1234567), "-1,234,567");
}

} // namespace
