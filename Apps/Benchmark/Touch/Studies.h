/// @file
/// The studies of the touch benchmark: each asks one question and gives one part of the report.
#pragma once

#include "Benchmark/Touch/TouchBenchmark.h"
#include "Benchmark/Touch/TouchJudge.h"

namespace pointhaptics
{
namespace bench
{
namespace touch
{

struct StudyContext
{
  const TouchBenchmarkOptions& options;
  const Progress& progress;
  std::string wrong;
};

/// Columns @p leading, then @p own of the study, then those of TouchFigures.
void setFigureHeader(
  ReportPart& part, const std::vector<std::string>& leading, const std::vector<std::string>& own = {});
/// A row of setFigureHeader's columns, and the same as numbers after @p leadingNumbers. Notes states that are
/// not finite in @p context.
void addFigures(StudyContext& context, ReportPart& part, std::vector<std::string> leadingCells,
  const nlohmann::ordered_json& leadingNumbers, const TouchFigures& figures);

/// The name in JSON of a bit of ProxyState::status.
std::string statusName(std::size_t bit);

/// The scans, fitted into the workspace, and the generated meshes; the same samples of each for all studies.
std::vector<TouchMesh> meshesOf(const TouchBenchmarkOptions& options);
std::vector<Vec3> samplesToTouch(const TouchMesh& mesh, std::int64_t count);

/// How the clouds of all studies are resampled, and what a report says about that.
TouchSceneSettings sceneSettings(const TouchBenchmarkOptions& options);
std::string sceneText(const TouchBenchmarkOptions& options);

/// A stroke and its truth.
struct TouchTask
{
  TouchStroke stroke;
  TouchTruth truth;
};

/// Truths of the strokes on the mesh of @p tree; the same for the same strokes.
std::vector<TouchTask> tasksOn(const TriangleTree& tree, std::vector<TouchStroke> strokes);

/// Told of each stroke's states beside its truth.
using TouchObserver = std::function<void(std::size_t stroke, const TouchTrace& trace)>;

/// One method on one scene over all strokes.
TouchFigures judge(StudyContext& context, const Contestant& contestant, const TouchScene& scene,
  const std::vector<TouchTask>& tasks, const TouchObserver& observer = {});

ReportPart studyScans(StudyContext& context);
ReportPart studyEdges(StudyContext& context);
ReportPart studyThin(StudyContext& context);
ReportPart studyLocal(StudyContext& context);
ReportPart studySizes(StudyContext& context);
/// Runs only where it is named. StudyContext::wrong says how many rows miss a limit.
ReportPart studyHard(StudyContext& context);

} // namespace touch
} // namespace bench
} // namespace pointhaptics
