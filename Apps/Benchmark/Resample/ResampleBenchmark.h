/// @file
/// `pointhaptics bench resample`: our filter beside its rivals.
#pragma once

#include "Benchmark/Report/Report.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace resample
{

struct ResampleBenchmarkOptions
{
  std::vector<std::int64_t> points{ 10000, 100000, 543652, 1000000, 5000000 };
  std::vector<std::int64_t> dimensions{ 75, 150, 300, 600, 1200, 4096 }; ///< Of the study of voxel size.
  std::vector<int> threads;                                              ///< Empty: one, and all cores.
  std::vector<std::string> rivals;                                       ///< As rivalWords() calls them.
  std::vector<std::string> studies;  ///< As studyWords() calls them; empty: all.
  std::int64_t voxelPoints = 543652; ///< Points of the studies of voxel size and memory.
  std::int64_t zoomPoints = 5000000; ///< Points of the study of zooming.
  std::int64_t accumulatorPoints = 1000000;
  std::int64_t dimension = 300; ///< Voxels on an axis where nothing else is said.
  int repetitions = 15;
  int warmUps = 2;
  double longestSeconds = 40.0; ///< See RaceSettings.

  /// A second or two: to see that everything works. The figures mean little.
  void makeQuick();
};

/// What --studies takes: points, voxels, attributes, instructions, zoom, memory, accumulators.
std::vector<std::string> studyWords();

/// Runs the studies. VTK's number of threads may be left changed. Throws std::bad_alloc.
/// @param allRight becomes false where an answer of ours was wrong.
Report benchmarkResample(const ResampleBenchmarkOptions& options, const Progress& progress, bool& allRight);

} // namespace resample
} // namespace bench
} // namespace pointhaptics
