#include "Haptics/Servo/LatencyHistogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <thread>
#include <vector>

using namespace pointhaptics;

TEST(LatencyHistogram, IsZeroBeforeTheFirstRecord)
{
  const LatencyHistogram::Summary summary = LatencyHistogram().summary();
  EXPECT_EQ(summary.count, 0u);
  EXPECT_EQ(summary.p50, 0.0);
  EXPECT_EQ(summary.p999, 0.0);
  EXPECT_EQ(summary.maximum, 0.0);
}

TEST(LatencyHistogram, QuantilesAreAtMost19PercentTooLarge)
{
  std::mt19937_64 random(3);
  std::lognormal_distribution<double> duration(std::log(20e-6), 1.0);
  std::vector<double> values(20001);
  LatencyHistogram histogram;
  for (double& value : values)
  {
    value = duration(random);
    histogram.record(value);
  }
  std::sort(values.begin(), values.end());
  const LatencyHistogram::Summary summary = histogram.summary();
  const auto expectNear = [&](double reported, double fraction)
  {
    const double exact = values[std::size_t(std::ceil(fraction * double(values.size()))) - 1];
    EXPECT_GE(reported, exact) << fraction;
    EXPECT_LE(reported, exact * std::exp2(0.25) * (1.0 + 1e-12)) << fraction;
  };
  expectNear(summary.p50, 0.5);
  expectNear(summary.p99, 0.99);
  expectNear(summary.p999, 0.999);
  EXPECT_EQ(summary.maximum, values.back());
  EXPECT_EQ(summary.count, values.size());
}

TEST(LatencyHistogram, TakesEveryNumber)
{
  LatencyHistogram histogram;
  const double infinity = std::numeric_limits<double>::infinity();
  for (double value : { 0.0, -1.0, std::nan(""), 1e-30, 1e9, -infinity })
  {
    histogram.record(value);
  }
  EXPECT_EQ(histogram.summary().count, 6u);
  EXPECT_EQ(histogram.summary().maximum, 1e9);
  EXPECT_EQ(histogram.summary().p999, 1e9);
  histogram.record(infinity);
  EXPECT_EQ(histogram.summary().maximum, infinity);
}

TEST(LatencyHistogram, NoQuantileIsAboveTheMaximum)
{
  LatencyHistogram histogram;
  histogram.record(1.01e-6);
  EXPECT_EQ(histogram.summary().p50, 1.01e-6);
}

TEST(LatencyHistogram, ForgetsWhenCleared)
{
  LatencyHistogram histogram;
  histogram.record(1.0);
  histogram.clear();
  EXPECT_EQ(histogram.summary().count, 0u);
  EXPECT_EQ(histogram.summary().maximum, 0.0);
}

TEST(LatencyHistogram, IsReadBesideItsWriter)
{
  constexpr std::uint64_t kRecords = 200000;
  LatencyHistogram histogram;
  std::thread writer(
    [&]
    {
      for (std::uint64_t i = 0; i < kRecords; ++i)
      {
        histogram.record(1e-6);
      }
    });
  std::uint64_t last = 0;
  while (last < kRecords)
  {
    const std::uint64_t count = histogram.summary().count;
    ASSERT_GE(count, last);
    last = count;
  }
  writer.join();
}
