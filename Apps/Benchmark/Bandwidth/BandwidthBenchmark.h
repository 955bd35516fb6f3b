/// @file
/// `pointhaptics bench bandwidth`: neighbours, bandwidths, radii, densities and kernel sums; time against
/// error.
#pragma once

#include "Benchmark/Report/Report.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{

struct BandwidthBenchmarkOptions
{
  std::int64_t points = 200000;
  std::int64_t latticePoints = 543652; ///< Of the idol in the study of lattice means.
  std::int64_t values = 409600;        ///< Of the univariate sample in the study of fast sums.
  int neighbors = 16;
  std::string file;                 ///< A real cloud that joins the study of neighbour search; may be empty.
  std::vector<int> threads;         ///< Ascending, not empty.
  std::vector<std::string> rivals;  ///< As rivalWords() calls them.
  std::vector<std::string> studies; ///< As studyWords() calls them; empty: all.
  int repetitions = 15;
  int warmUps = 2;
  int checkedPoints = 300; ///< Whose answers are compared with long double.

  /// A second or two: to see that everything works. The figures mean little.
  void makeQuick();
};

/// What --studies takes: search, rules, touch, settling, lattice, truncation, sums.
std::vector<std::string> studyWords();

/// Runs the studies. VTK's number of threads may be left changed. Throws std::bad_alloc, and
/// std::runtime_error where the file cannot be read.
/// @param allRight becomes false where an answer of ours was wrong.
Report benchmarkBandwidth(const BandwidthBenchmarkOptions& options, const Progress& progress, bool& allRight);

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
