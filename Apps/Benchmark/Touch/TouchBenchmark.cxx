#include "Benchmark/Touch/TouchBenchmark.h"

#include "Benchmark/Touch/Studies.h"

namespace pointhaptics::bench::touch
{
namespace
{

/// Names of the bits of ProxyState::status, in their order.
constexpr const char* kStatusNames[kStatusBits] = { "non-finite", "rounds", "step-limit", "ball", "bit4",
  "no-scene", "cells", "settling", "stiffness", "led", "around", "seeking", "gliding", "crowded", "fallback",
  "bit15" };

} // namespace

void TouchBenchmarkOptions::makeQuick()
{
  quick = true;
  points = 20000;
  strokes = 2;
  meshes = { "box" };
}

Json statusOf(const std::array<double, kStatusBits>& percent)
{
  Json status = Json::object();
  for (std::size_t bit = 0; bit < kStatusBits; ++bit)
  {
    status[kStatusNames[bit]] = percent[bit];
  }
  return status;
}

std::vector<TouchMesh> meshesOf(const TouchBenchmarkOptions& options)
{
  std::vector<TouchMesh> meshes;
  for (TouchMesh mesh : options.scans)
  {
    mesh.points = proxy::fitted(std::move(mesh.points));
    orientOutward(mesh);
    meshes.push_back(std::move(mesh));
  }
  for (const std::string& name : options.meshes)
  {
    meshes.push_back(generatedMesh(name));
  }
  return meshes;
}

TouchSceneSettings sceneSettings(const TouchBenchmarkOptions& options)
{
  TouchSceneSettings settings;
  settings.raw = options.raw;
  settings.local = options.local;
  settings.lateTicks = int(options.lateTicks);
  return settings;
}

std::vector<TouchTask> tasksOn(const TriangleTree& tree, std::vector<TouchStroke> strokes)
{
  std::vector<TouchTask> tasks;
  for (TouchStroke& stroke : strokes)
  {
    TouchTask task;
    task.truth = truthOf(tree, stroke, ContactParameters().stiffness, 100 + tasks.size());
    task.stroke = std::move(stroke);
    tasks.push_back(std::move(task));
  }
  return tasks;
}

TouchFigures judge(StudyContext& context, const Contestant& contestant, const TouchScene& scene,
  const std::vector<TouchTask>& tasks)
{
  const std::unique_ptr<TouchMethod> method = contestant.make();
  TouchJudge judge(ContactParameters().stiffness);
  for (std::size_t i = 0; i < tasks.size(); ++i)
  {
    const TouchTrace trace =
      walk(*method, scene, tasks[i].stroke, tasks[i].truth.ticks.size(), context.run.repetitions);
    judge.add(trace, tasks[i].truth);
  }
  return judge.figures();
}

} // namespace pointhaptics::bench::touch
