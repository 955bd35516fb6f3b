/// Is the force right on surfaces that are not smooth: scans, and machined parts with edges?
#include "Benchmark/Touch/Studies.h"

#include <fmt/format.h>

namespace pointhaptics
{
namespace bench
{
namespace touch
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
  std::vector<Cloud> clouds;
  clouds.push_back({ "samples", samplesToTouch(mesh, options.points) });
  if (mesh.isScan)
  {
    clouds.push_back({ "vertices", mesh.points });
  }
  return clouds;
}

} // namespace

ReportPart studyScans(StudyContext& context)
{
  const TouchBenchmarkOptions& options = context.options;
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "Scans and machined parts beside their own meshes";
  part.text =
    fmt::format("{} strokes on each mesh, set {}: pressed to 1 mm, slid 10 mm at 20 and 50 mm/s, lifted. "
                "Scans are fitted "
                "into 95 mm. Clouds: {} samples uniform over the area, and of scans the bare vertices; {}.",
      options.strokes, options.strokeSet == StrokeSet::A ? "A" : "B", grouped(options.points),
      sceneText(options));
  setFigureHeader(part, { "mesh", "cloud", "points", "method" });
  Chart chart;
  chart.fileName = "touch-time-error";
  chart.title = "Every method on every mesh and cloud";
  chart.x = { "median update (us)" };
  chart.y = { "RMS force error (%)" };
  for (const TouchMesh& mesh : meshesOf(options))
  {
    const TriangleTree tree(mesh);
    if (tree.facets().empty())
    {
      part.remarks.push_back("Left out: " + mesh.name + " has no triangles");
      continue;
    }
    context.progress("god objects on " + mesh.name);
    const std::vector<TouchTask> tasks = tasksOn(tree, strokesOn(tree, options.strokes, options.strokeSet));
    for (Cloud& cloud : cloudsOf(mesh, options))
    {
      const std::size_t count = cloud.points.size();
      const TouchScene scene = makeTouchScene(std::move(cloud.points), sceneSettings(options));
      if (!scene.scene)
      {
        part.remarks.push_back("Left out: " + cloud.name + " of " + mesh.name + " have no finite points");
        continue;
      }
      for (const Contestant& contestant : contestantsNamed(options.methods, options.instructions))
      {
        context.progress(fmt::format("{} on {} of {}", contestant.name, cloud.name, mesh.name));
        const TouchFigures figures = judge(context, contestant, scene, tasks);
        addPoint(chart.series, contestant.name, figures.p50, figures.rmsPercent);
        addFigures(context, part, { mesh.name, cloud.name, grouped(std::int64_t(count)), contestant.name },
          { { "mesh", mesh.name }, { "cloud", cloud.name }, { "points", count },
            { "method", contestant.name } },
          figures);
      }
    }
  }
  for (Series& series : chart.series)
  {
    series.line = false;
  }
  part.charts.push_back(std::move(chart));
  return part;
}

} // namespace touch
} // namespace bench
} // namespace pointhaptics
