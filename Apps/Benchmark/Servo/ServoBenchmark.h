/// @file
/// Step time, jitter and deadline misses of the servo loop.
#pragma once

#include "Benchmark/Report/Report.h"

#include <functional>
#include <string>
#include <vector>

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
  /// One frame of the viewer, turned a little; null: no display, and no rows with drawing.
  std::function<void()> draw;
  /// Which rows: of handWords(), loadWords(), rateWords(); empty: all.
  std::vector<std::string> hands, loads, rates;
};

std::vector<std::string> handWords();
std::vector<std::string> loadWords();
std::vector<std::string> rateWords();

/// A report without parts where no row is left: the Falcon runs at 1000 Hz only, drawing needs a display.
/// @p allRight: in every run the hand touched, and the force was that of the ideal sphere within 5 % of the
/// largest one.
Report benchmarkServo(const ServoBenchmarkOptions& options, const Progress& progress, bool& allRight);

} // namespace servo
} // namespace bench
} // namespace pointhaptics
