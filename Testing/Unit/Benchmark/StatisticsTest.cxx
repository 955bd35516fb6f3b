#include "Benchmark/Harness/Statistics.h"

#include <gtest/gtest.h>

using namespace pointhaptics::bench;

TEST(Statistics, QuantilesAreLinearBetweenNeighbours)
{
  const std::vector<double> values = { 1.0, 2.0, 4.0, 8.0 };
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 1.0), 8.0);
  EXPECT_EQ(quantile(values, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 1.75); // as R's quantile(c(1, 2, 4, 8), 0.25)
  EXPECT_DOUBLE_EQ(quantile(values, 0.75), 5.0);
  EXPECT_EQ(quantile({ 7.0 }, 0.3), 7.0);
}

TEST(Statistics, QuartilesDoNotDependOnTheOrder)
{
  const Quartiles a = quartiles({ 5.0, 1.0, 3.0, 2.0, 4.0 });
  EXPECT_EQ(a.count, 5u);
  EXPECT_EQ(a.minimum, 1.0);
  EXPECT_EQ(a.lower, 2.0);
  EXPECT_EQ(a.median, 3.0);
  EXPECT_EQ(a.upper, 4.0);
  EXPECT_EQ(a.maximum, 5.0);
}

TEST(Statistics, OneSlowRoundDoesNotMoveTheMedian)
{
  EXPECT_EQ(quartiles({ 1.0, 1.0, 1.0, 1.0, 1e9 }).median, 1.0);
}

TEST(Statistics, NothingGivesZeros)
{
  const Quartiles none = quartiles({});
  EXPECT_EQ(none.count, 0u);
  EXPECT_EQ(none.median, 0.0);
  EXPECT_EQ(pairedRatios({ 1.0 }, {}).count, 0u);
}

TEST(Statistics, PairedRatiosCancelWhatSlowsBoth)
{
  // The machine is ten times slower in the second and third round.
  const Quartiles ratio = pairedRatios({ 2.0, 20.0, 20.0, 2.0 }, { 1.0, 10.0, 10.0, 1.0 });
  EXPECT_EQ(ratio.count, 4u);
  EXPECT_EQ(ratio.minimum, 2.0);
  EXPECT_EQ(ratio.maximum, 2.0);
}

TEST(Statistics, PairedRatiosLeaveOutRoundsThatTookNoTime)
{
  const Quartiles ratio = pairedRatios({ 2.0, 5.0, 3.0 }, { 1.0, 0.0 });
  EXPECT_EQ(ratio.count, 1u);
  EXPECT_EQ(ratio.median, 2.0);
}
