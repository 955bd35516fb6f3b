/// @file
/// The studies of the bandwidth benchmark: each asks one question and gives one part of the report.
#pragma once

#include "Benchmark/Bandwidth/BandwidthBenchmark.h"
#include "Benchmark/Harness/Race.h"
#include "Benchmark/Report/Report.h"

#include <functional>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{

/// What the studies share.
struct StudyContext
{
  const BandwidthBenchmarkOptions& options;
  const Progress& progress;
  bool allRight = true;

  int mostThreads() const { return options.threads.back(); }
};

/// Rounds of a race with @p threads threads: as many as the options say, or @p part of them (at least 3, or
/// what the options say where that is less).
std::vector<Lap> timed(
  const std::vector<Contestant>& contestants, int threads, const StudyContext& context, double part = 1.0);

ReportPart studySearch(StudyContext& context);
ReportPart studyRules(StudyContext& context);
ReportPart studyTouch(StudyContext& context);
ReportPart studySettling(StudyContext& context);
ReportPart studyLattice(StudyContext& context);
ReportPart studyTruncation(StudyContext& context);

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
