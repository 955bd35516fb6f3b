/// @file
/// The studies of the proxy's benchmark: each asks one question and gives one part of the report.
#pragma once

#include "Benchmark/Proxy/ProxyBenchmark.h"
#include "Benchmark/Proxy/Scenes.h"
#include "Benchmark/Proxy/Trial.h"

namespace pointhaptics
{
namespace bench
{
namespace proxy
{

struct StudyContext
{
  const ProxyBenchmarkOptions& options;
  const Progress& progress;
  std::string wrong;
};

/// Columns @p leading, then errors, steps, energy and times.
void setFigureHeader(ReportPart& part, const std::vector<std::string>& leading);
/// A row of setFigureHeader's columns, and the same as numbers after those of @p leadingNumbers.
void addFigures(ReportPart& part, const std::vector<std::string>& leadingCells,
  const nlohmann::ordered_json& leadingNumbers, const TrialFigures& figures);

HapticParameters gradientSteps(const GradientStepsParameters& gains);
/// The exact answer of the sphere scaled by @p scale.
ExactAnswer scaledSphere(double scale);

/// The largest number of points asked for.
std::int64_t mostPoints(const StudyContext& context);

ReportPart studyShapes(StudyContext& context);
ReportPart studyMethods(StudyContext& context);
ReportPart studyPaths(StudyContext& context);
ReportPart studyValidation(StudyContext& context);
ReportPart studyPaper(StudyContext& context);
ReportPart studySize(StudyContext& context);
ReportPart studyInstructions(StudyContext& context);
/// Without a key where there are no scans.
ReportPart studyScans(StudyContext& context);

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
