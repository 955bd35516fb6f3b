/// @file
/// `pointhaptics bench io`: our reader and writers beside those of VTK and PCL.
#pragma once

#include "Benchmark/Report/Report.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace io
{

struct IoBenchmarkOptions
{
  std::int64_t points = 543652;
  std::int64_t memoryPoints = 3000000; ///< Of the study of memory: 64 MB must not hide everything.
  std::vector<std::string> rivals;     ///< As rivalWords() calls them.
  std::vector<std::string> studies;    ///< As studyWords() calls them; empty: all.
  int repetitions = 15;
  int warmUps = 1;

  /// A second or two: to see that everything works. The figures mean little.
  void makeQuick();
};

/// What --studies takes: read, packed, write, memory.
std::vector<std::string> studyWords();

/// Runs the studies on files in a temporary folder. Throws std::runtime_error where they cannot be written.
/// @param allRight becomes false where an answer of ours was wrong.
Report benchmarkIo(const IoBenchmarkOptions& options, const Progress& progress, bool& allRight);

} // namespace io
} // namespace bench
} // namespace pointhaptics
