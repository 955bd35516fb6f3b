#include "Benchmark/Touch/TouchBenchmark.h"

#include "Benchmark/Harness/Instructions.h"
#include "Benchmark/Touch/Studies.h"

#include <fmt/format.h>

namespace pointhaptics::bench::touch
{
namespace
{

/// Names of the bits of ProxyState::status, in their order.
constexpr const char* kStatusNames[] = { "non-finite", "rounds", "step-limit", "ball", "bit4", "no-scene",
  "cells", "settling", "stiffness", "led", "around", "seeking", "gliding", "crowded", "fallback" };

} // namespace

void TouchBenchmarkOptions::makeQuick()
{
  quick = true;
  points = 20000;
  strokes = 2;
  meshes = { "box" };
}

std::string statusName(std::size_t bit)
{
  return bit < std::size(kStatusNames) ? kStatusNames[bit] : fmt::format("bit{}", bit);
}

void addFigures(StudyContext& context, const char* study, Json row, const TouchFigures& f)
{
  if (f.nonFinite > 0)
  {
    context.run.fault(fmt::format("{}: {} states that are not finite", row.dump(), f.nonFinite));
  }
  row.update(
    { { "median_percent", f.medianPercent }, { "p95_percent", f.p95Percent }, { "rms_percent", f.rmsPercent },
      { "direction_p95_degrees", f.directionP95Degrees }, { "lost_percent", f.lostPercent },
      { "pops", f.pops }, { "phantom_newton", f.phantomNewton }, { "held", f.held },
      { "phantom_after_leap_newton", f.laterPhantomNewton }, { "held_after_leap", f.laterHeld },
      { "strokes", f.strokes }, { "leaps", f.leaps }, { "releases", f.releases }, { "ticks", f.ticks },
      { "contact_ticks", f.contacts }, { "judged_ticks", f.judged }, { "judged_percent", f.judgedPercent },
      { "step_p99", f.stepP99 }, { "largest_step", f.largestStep }, { "energy_joule", f.energyJoule },
      { "p50_us", f.p50 }, { "p99_us", f.p99 }, { "first_contact_us", f.firstContact },
      { "max_us", f.maximum }, { "instructions", usedInstructions(context.options.instructions) } });
  Json status = Json::object();
  for (std::size_t bit = 0; bit < kStatusBits; ++bit)
  {
    if (bit < std::size(kStatusNames) || f.statusPercent[bit] > 0.0)
    {
      status[statusName(bit)] = f.statusPercent[bit];
    }
  }
  row["status_percent"] = std::move(status);
  context.run.add(study, std::move(row));
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
  const std::vector<TouchTask>& tasks, const TouchObserver& observer)
{
  const std::unique_ptr<TouchMethod> method = contestant.make();
  TouchJudge judge(ContactParameters().stiffness);
  for (std::size_t i = 0; i < tasks.size(); ++i)
  {
    const TouchTrace trace =
      walk(*method, scene, tasks[i].stroke, tasks[i].truth.ticks.size(), context.run.repetitions);
    judge.add(trace, tasks[i].truth);
    if (observer)
    {
      observer(i, trace);
    }
  }
  return judge.figures();
}

} // namespace pointhaptics::bench::touch
