/// @file
/// Summaries of repeated measurements: quartiles, and ratios of measurements taken side by side.
#pragma once

#include <cstddef>
#include <vector>

namespace pointhaptics::bench
{

/// Zero throughout where there was nothing to summarise.
struct Quartiles
{
  std::size_t count = 0;
  double minimum = 0.0;
  double lower = 0.0; ///< A quarter of the values lie below.
  double median = 0.0;
  double upper = 0.0; ///< A quarter of the values lie above.
  double maximum = 0.0;
};

/// The value below which the fraction @p p (0 to 1) of @p sorted lies, linear between neighbours (R's type
/// 7).
/// @pre @p sorted is ascending and not empty.
double quantile(const std::vector<double>& sorted, double p);

Quartiles quartiles(std::vector<double> values);

/// Quartiles of a[i] / b[i]: both were measured in round i, so what slows the machine for a while cancels.
/// Rounds whose b[i] is not above 0 are left out; the longer vector's surplus is too.
Quartiles pairedRatios(const std::vector<double>& a, const std::vector<double>& b);

} // namespace pointhaptics::bench
