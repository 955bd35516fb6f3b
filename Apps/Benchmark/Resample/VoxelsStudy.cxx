#include "Benchmark/Resample/Clouds.h"
#include "Benchmark/Resample/Studies.h"

#include <fmt/format.h>
#include <vtkPolyData.h>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

Rivals withAllThatIsAsked()
{
  Rivals rivals;
  const auto add = [&rivals](const char* name, bool covariance, bool attributes, int levels)
  {
    OursSettings settings;
    settings.name = name;
    settings.covariance = covariance;
    settings.attributes = attributes;
    settings.levels = levels;
    rivals.push_back(makeOurs(settings));
  };
  add("points alone", false, false, 1);
  add("with covariance", true, false, 1);
  add("with three arrays", false, true, 1);
  add("with both", true, true, 1);
  add("with three coarser levels", false, false, 4);
  return rivals;
}

} // namespace

ReportPart studyVoxels(StudyContext& context)
{
  const std::int64_t count = context.options.voxelPoints;
  const int threads = mostThreads(context);
  ReportPart part;
  part.title = "Against the size of the voxels";
  part.text = fmt::format("{} points in random order, {} threads. A lattice of 4096 voxels on an axis is one "
                          "that no dense array could hold.",
    grouped(count), threads);
  setRaceHeader(part, { "voxels on an axis" });
  const auto cloud = sphereCloud(count, PointOrder::Random);
  std::vector<Series> lines;
  for (const std::int64_t dimension : context.options.dimensions)
  {
    context.progress(fmt::format("{} voxels on an axis", dimension));
    const RaceTable race = raceOn(taskOn(cloud, dimension), allRivals(context), threads, context);
    addRace(part, race, count, { grouped(dimension) },
      { { "points", count }, { "order", "random" }, { "dimension", dimension }, { "threads", threads } });
    for (const RaceRow& row : race.rows)
    {
      addPoint(lines, row.name, double(dimension), 1e3 * row.seconds.median);
    }
  }
  part.charts.push_back({ "resample-voxels", fmt::format("Update of {} points", grouped(count)),
    { "voxels on an axis of the workspace", true,
      std::vector<double>(context.options.dimensions.begin(), context.options.dimensions.end()) },
    { "time (ms)", true }, lines });
  return part;
}

ReportPart studyAttributes(StudyContext& context)
{
  const int threads = mostThreads(context);
  ReportPart part;
  part.title = "With covariance, what a point carries, coarser levels";
  part.text =
    fmt::format("Random order, {} voxels on an axis, {} threads. Arrays: colours (3 unsigned char), "
                "normals (3 float), intensity (1 float). Means and counts are checked here, covariance and "
                "arrays in the tests of the filter.",
      context.options.dimension, threads);
  setRaceHeader(part, { "points" }, "points alone");
  for (const std::int64_t count : { context.options.voxelPoints, context.options.zoomPoints })
  {
    context.progress(fmt::format("{} points with covariance and arrays", count));
    const auto cloud = sphereCloud(count, PointOrder::Random);
    addAttributes(cloud);
    const RaceTable race =
      raceOn(taskOn(cloud, context.options.dimension), withAllThatIsAsked(), threads, context);
    addRace(part, race, count, { grouped(count) },
      { { "points", count }, { "order", "random" }, { "dimension", context.options.dimension },
        { "threads", threads } });
  }
  return part;
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
