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

/// The per cent of the ticks with each bit of ProxyState::status, by the bit's name.
Json statusOf(const std::array<double, kStatusBits>& percent);

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

/// One method on one scene over all strokes.
TouchFigures judge(StudyContext& context, const Contestant& contestant, const TouchScene& scene,
  const std::vector<TouchTask>& tasks);

void studyScans(StudyContext& context);
/// Runs only where it is named. The fault of the run says how many rows miss a limit.
void studyHard(StudyContext& context);

} // namespace pointhaptics::bench::touch
