/// @file
/// Shared by the tests of local bandwidths: the rules, clouds, and what every result holds.
#pragma once

#include "Core/Bandwidth/LocalBandwidth.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pointhaptics
{
namespace trial
{

constexpr BandwidthRule kRules[] = { BandwidthRule::NormalReference, BandwidthRule::SilvermanRobust,
  BandwidthRule::ScottMultivariate, BandwidthRule::SilvermanMultivariate, BandwidthRule::SheatherJones };

struct Local
{
  std::vector<double> bandwidths;
  std::vector<double> radii;
};

inline Local localOf(
  const std::vector<Vec3>& points, const LocalBandwidthSettings& settings, const Executor& executor = {})
{
  NeighborQuery query;
  query.build(view(points));
  Local result;
  EXPECT_EQ(localBandwidths(view(points), {}, query, settings, result.bandwidths, result.radii, executor),
    Status::Ok);
  EXPECT_EQ(result.bandwidths.size(), points.size());
  EXPECT_EQ(result.radii.size(), points.size());
  return result;
}

inline double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// A square with sixteen times the density on its left half.
inline std::vector<Vec3> densityStep()
{
  std::vector<Vec3> points = randomBox(16000, 31, { 0, 0, 0 }, { 1, 1, 0 });
  const std::vector<Vec3> sparse = randomBox(1000, 32, { 1, 0, 0 }, { 2, 1, 0 });
  points.insert(points.end(), sparse.begin(), sparse.end());
  return points;
}

inline void expectUsable(const Local& local)
{
  for (std::size_t i = 0; i < local.radii.size(); ++i)
  {
    EXPECT_GT(local.radii[i], 0.0);
    EXPECT_TRUE(std::isfinite(local.radii[i]));
    EXPECT_GT(local.bandwidths[i], 0.0);
    EXPECT_TRUE(std::isfinite(local.bandwidths[i]));
  }
}

} // namespace trial
} // namespace pointhaptics
