#include "Benchmark/Resample/Clouds.h"
#include "Benchmark/Resample/Studies.h"

#include <fmt/format.h>
#include <vtkPolyData.h>

#include <string>
#include <utility>
#include <vector>

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
  const auto add = [&rivals](const char* name, auto&& choose)
  {
    OursSettings settings;
    settings.name = name;
    choose(settings);
    rivals.push_back(makeOurs(settings));
  };
  const std::vector<std::string> three = { kColors, kNormals, kIntensity };
  add("points alone", [](OursSettings&) {});
  add("with covariance", [](OursSettings& s) { s.covariance = true; });
  add("with three arrays", [&](OursSettings& s) { s.arrays = three; });
  add("with both",
    [&](OursSettings& s)
    {
      s.covariance = true;
      s.arrays = three;
    });
  add("with a label", [](OursSettings& s) { s.arrays = { kLabels }; });
  add("with the voxel of each point", [](OursSettings& s) { s.voxelIndex = true; });
  const std::pair<const char*, Representative> others[] = { { "nearest to the mean",
                                                              Representative::NearestToMean },
    { "nearest to the centre", Representative::NearestToCenter }, { "median", Representative::Median } };
  for (const auto& other : others)
  {
    add(other.first, [&](OursSettings& s) { s.representative = other.second; });
    add((other.first + std::string(", three arrays")).c_str(),
      [&](OursSettings& s)
      {
        s.representative = other.second;
        s.arrays = three;
      });
  }
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
  part.title = "With covariance, arrays, other representatives";
  part.text =
    fmt::format("Random order, {} voxels on an axis, {} threads. Arrays: colours (3 unsigned char), "
                "normals (3 float), intensity (1 float). Means and counts are checked here, of other "
                "representatives that they lie in their voxels; covariance, arrays and the choice of the "
                "representative in the tests of the filter.",
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
