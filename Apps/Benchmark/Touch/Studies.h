/// @file
/// The studies of the touch benchmark: each asks one question and adds rows.
#pragma once

#include "Benchmark/Harness/Run.h"
#include "Benchmark/Touch/TouchBenchmark.h"
#include "Benchmark/Touch/TouchJudge.h"

namespace pointhaptics::bench::touch
{

struct StudyContext
{
  const TouchBenchmarkOptions& options;
  Run& run;
};

/// A row of @p study: @p leading, then the figures. States that are not finite are a fault.
void addFigures(StudyContext& context, const char* study, Json leading, const TouchFigures& figures);

/// The name in JSON of a bit of ProxyState::status.
std::string statusName(std::size_t bit);

/// The scans, fitted into the workspace, and the generated meshes.
std::vector<TouchMesh> meshesOf(const TouchBenchmarkOptions& options);

/// How the clouds of all studies are resampled.
TouchSceneSettings sceneSettings(const TouchBenchmarkOptions& options);

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

void studyScans(StudyContext& context);
void studyEdges(StudyContext& context);
void studyThin(StudyContext& context);
/// Runs only where it is named. The fault of the run says how many rows miss a limit.
void studyHard(StudyContext& context);

} // namespace pointhaptics::bench::touch
