/// @file
/// Bandwidths and radii in long double at some points of a cloud: what a contestant's answer is held against.
#pragma once

#include "Benchmark/Bandwidth/Rivals/Rival.h"

#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{

struct ExpectedPoint
{
  std::size_t index = 0;
  double bandwidth = 0.0;
  double radius = 0.0;
};

/// At @p count points spread over the cloud, by the definition; those whose neighbourhood has no spread are
/// left out, as their answer is a matter of convention.
std::vector<ExpectedPoint> expectedPoints(const BandwidthTask& task, int count);

struct Verdict
{
  bool right = false;
  double worstError = 0.0; ///< Relative, of bandwidths and radii.
  std::string text;        ///< "right to 2e-16", "12 of 300 differ by up to 3 %".
};

/// Ours may be off by 1e-9 relative; a loop over numbers in float by 1e-4.
Verdict judge(const BandwidthAnswer& answer, const std::vector<ExpectedPoint>& expected, bool isOurs);

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
