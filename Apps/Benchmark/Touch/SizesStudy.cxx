/// What does a tick take on smooth shapes and on scans, among few points and among very many?
#include "Benchmark/Touch/Studies.h"

#include <fmt/format.h>

#include <chrono>

namespace pointhaptics
{
namespace bench
{
namespace touch
{
namespace
{

/// A sphere with facets smaller than fits reach, scaled: at larger ones the surface would not be smooth.
TouchMesh smoothMesh(const std::string& name, const Vec3& scale)
{
  constexpr double kRadius = 0.030;
  constexpr int kRings = 600;
  TouchMesh mesh = sphereMesh(kRadius, kRings);
  mesh.name = name;
  for (Vec3& p : mesh.points)
  {
    p = turnedAway({ scale.x * p.x, scale.y * p.y, scale.z * p.z });
  }
  return mesh;
}

/// The smooth shapes, then the scans.
std::vector<TouchMesh> meshesToSize(const TouchBenchmarkOptions& options)
{
  std::vector<TouchMesh> meshes = { smoothMesh("sphere", { 1.0, 1.0, 1.0 }),
    smoothMesh("ellipsoid", { 1.0, 0.7, 0.5 }) };
  for (TouchMesh& mesh : meshesOf(options))
  {
    if (mesh.isScan)
    {
      meshes.push_back(std::move(mesh));
    }
  }
  return meshes;
}

} // namespace

ReportPart studySizes(StudyContext& context)
{
  const TouchBenchmarkOptions& options = context.options;
  ReportPart part;
  part.title = "The tick's time against the size of the cloud";
  part.text = fmt::format(
    "The strokes of the first study on samples of smooth shapes and of scans, {} on each; {}. Built: from "
    "points in memory to a scene that can be felt everywhere, on one thread, and the index for those near "
    "the hand. The smooth shapes are meshes with facets of 0.3 degrees, smaller than fits reach.",
    options.strokes, sceneText(options));
  setFigureHeader(part, { "mesh", "points", "method" }, { "built s" });
  const std::vector<std::string> methods =
    options.methods.empty() ? std::vector<std::string>{ "surface-fit" } : options.methods;
  for (const TouchMesh& mesh : meshesToSize(options))
  {
    const TriangleTree tree(mesh);
    if (tree.facets().empty())
    {
      continue;
    }
    context.progress("god objects on " + mesh.name);
    const std::vector<TouchTask> tasks = tasksOn(tree, strokesOn(tree, options.strokes, options.strokeSet));
    for (const std::int64_t size : options.sizes)
    {
      context.progress(fmt::format("{} samples of {}", grouped(size), mesh.name));
      std::vector<Vec3> points = samplesToTouch(mesh, size);
      const auto count = std::int64_t(points.size());
      const auto before = std::chrono::steady_clock::now();
      const TouchScene scene = makeTouchScene(std::move(points), sceneSettings(options));
      const std::chrono::duration<double> built = std::chrono::steady_clock::now() - before;
      if (!scene.scene)
      {
        continue;
      }
      for (const Contestant& contestant : contestantsNamed(methods, options.instructions))
      {
        context.progress(fmt::format("{} on {} samples of {}", contestant.name, grouped(count), mesh.name));
        addFigures(context, part, { mesh.name, grouped(count), contestant.name, brief(built.count()) },
          { { "mesh", mesh.name }, { "points", count }, { "method", contestant.name },
            { "built_seconds", built.count() } },
          judge(context, contestant, scene, tasks));
      }
    }
  }
  return part;
}

} // namespace touch
} // namespace bench
} // namespace pointhaptics
