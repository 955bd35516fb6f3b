/// Is the force right on surfaces that are not smooth: scans, and machined parts with edges?
#include "Benchmark/Harness/Instructions.h"
#include "Benchmark/Touch/Studies.h"

#include <fmt/format.h>

namespace pointhaptics::bench::touch
{
namespace
{

struct Cloud
{
  std::string name;
  std::vector<Vec3> points;
};

std::vector<Cloud> cloudsOf(const TouchMesh& mesh, const TouchBenchmarkOptions& options)
{
  constexpr std::uint64_t kSeed = 28;
  std::vector<Cloud> clouds;
  for (const double size : options.sizes)
  {
    clouds.push_back({ "samples", samplesOf(mesh, std::int64_t(size), kSeed) });
  }
  if (mesh.isScan)
  {
    clouds.push_back({ "vertices", mesh.points });
  }
  return clouds;
}

/// A row: @p row, then the figures. States that are not finite are a fault.
void addFigures(StudyContext& context, Json row, const TouchFigures& f)
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
  row["status_percent"] = statusOf(f.statusPercent);
  context.run.add("scans", std::move(row));
}

} // namespace

void studyScans(StudyContext& context)
{
  const TouchBenchmarkOptions& options = context.options;
  const auto leaveOut = [&](const std::string& what) { context.run.remark("scans", "Left out: " + what); };
  for (const TouchMesh& mesh : meshesOf(options))
  {
    const TriangleTree tree(mesh);
    if (tree.facets().empty())
    {
      leaveOut(mesh.name + " has no triangles");
      continue;
    }
    context.run.say("god objects on " + mesh.name);
    const std::vector<TouchTask> tasks =
      tasksOn(tree, strokesOn(tree, int(options.strokes), options.strokeSet));
    for (Cloud& cloud : cloudsOf(mesh, options))
    {
      const std::size_t count = cloud.points.size();
      const double before = secondsNow();
      const TouchScene scene = makeTouchScene(std::move(cloud.points), sceneSettings(options));
      const double built = secondsNow() - before;
      if (!scene.scene)
      {
        leaveOut(cloud.name + " of " + mesh.name + " have no finite points");
        continue;
      }
      for (const Contestant& contestant : contestantsNamed(options.methods, options.instructions))
      {
        context.run.say(fmt::format("{} on {} of {}", contestant.name, cloud.name, mesh.name));
        addFigures(context,
          { { "mesh", mesh.name }, { "cloud", cloud.name }, { "points", count },
            { "method", contestant.name }, { "built_seconds", built } },
          judge(context, contestant, scene, tasks));
      }
    }
  }
}

} // namespace pointhaptics::bench::touch
