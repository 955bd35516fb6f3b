/// @file
/// How long a tick takes, how late it comes, and how many are missed.
#pragma once

#include "Benchmark/Report.h"

namespace pointhaptics
{
namespace bench
{
namespace servo
{

struct ServoBenchmarkOptions
{
  int points = 543652;
  double seconds = 10.0; ///< Of each run.
  bool rendering = true; ///< There is a display.
};

/// @p allRight: in every run the hand touched, and the force was that of the ideal sphere within 5 % of the
/// largest one.
Report benchmarkServo(const ServoBenchmarkOptions& options, const Progress& progress, bool& allRight);

} // namespace servo
} // namespace bench
} // namespace pointhaptics
