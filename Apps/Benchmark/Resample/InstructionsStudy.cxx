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

Rivals instructionSets(const StudyContext& context)
{
  Rivals rivals;
  rivals.push_back(makeOurs());
  for (const InstructionSet set : { InstructionSet::Avx512, InstructionSet::Avx2, InstructionSet::Baseline })
  {
    OursSettings settings;
    settings.name = fmt::format("ours, {}", instructionSetName(set));
    settings.instructionSet = set;
    rivals.push_back(makeOurs(settings));
  }
  for (const std::string& word : context.options.rivals)
  {
    if (word == "pcl")
    {
      rivals.push_back(makeRival(word));
    }
  }
  return rivals;
}

} // namespace

ReportPart studyInstructions(StudyContext& context)
{
  ReportPart part;
  part.title = "Instruction sets";
  part.text =
    fmt::format("The paths of one build, chosen at run time; \"ours\" chooses by itself. Random order, "
                "{} voxels on an axis.",
      context.options.dimension);
  setRaceHeader(part, { "points", "threads" });
  for (const std::int64_t count : { context.options.voxelPoints, context.options.zoomPoints })
  {
    const auto cloud = sphereCloud(count, PointOrder::Random);
    const ResampleTask task = taskOn(cloud, context.options.dimension);
    for (const int threads : context.options.threads)
    {
      context.progress(fmt::format("instruction sets, {} points, {} threads", count, threads));
      const RaceTable race = raceOn(task, instructionSets(context), threads, context);
      addRace(part, race, count, { grouped(count), std::to_string(threads) },
        { { "points", count }, { "order", "random" }, { "dimension", task.dimension },
          { "threads", threads } });
    }
  }
  return part;
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
