#include "Benchmark/Harness/PeakMemory.h"
#include "Benchmark/Resample/Clouds.h"
#include "Benchmark/Resample/Studies.h"

#include <fmt/format.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <algorithm>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

struct MemoryCase
{
  std::int64_t points;
  std::int64_t dimension;
};

std::string megabytes(double bytes)
{
  return brief(bytes / 1e6);
}

/// The promise of the design: bytes beyond input and output.
double promisedBytes(std::int64_t points, std::int64_t voxels)
{
  return 64.0 * double(voxels) + 16.0 * double(std::min<std::int64_t>(points, 5000000));
}

/// Expected active voxels, counted once a case.
std::int64_t voxelsOf(const ResampleTask& task)
{
  Lattice lattice;
  lattice.origin = task.workspace.minimum;
  lattice.spacing = { task.leaf, task.leaf, task.leaf };
  lattice.dimensions = { task.dimension, task.dimension, task.dimension };
  return std::int64_t(expectedMeans(viewOf(task.cloud), lattice).keys.size());
}

void addRow(const MemoryCase& memoryCase, const std::string& name, std::int64_t voxels, int threads,
  const PeakMemory& memory, ReportPart& part)
{
  const double output = double(memory.result);
  const double beyond = std::max(0.0, double(memory.peakBytes) - output);
  const double kept = std::max(0.0, double(memory.keptBytes) - output);
  part.table.rows.push_back(
    { grouped(memoryCase.points), grouped(memoryCase.dimension), name, megabytes(output), megabytes(beyond),
      megabytes(kept), brief(beyond / double(voxels)), brief(beyond / double(memoryCase.points)),
      brief(beyond / promisedBytes(memoryCase.points, voxels)), brief(1e3 * memory.seconds) });
  part.rows.push_back({ { "points", memoryCase.points }, { "dimension", memoryCase.dimension },
    { "threads", threads }, { "contestant", name }, { "voxels", voxels }, { "output_bytes", output },
    { "beyond_bytes", beyond }, { "kept_bytes", kept }, { "bytes_per_voxel", beyond / double(voxels) },
    { "bytes_per_point", beyond / double(memoryCase.points) },
    { "promised_bytes", promisedBytes(memoryCase.points, voxels) }, { "cold_seconds", memory.seconds } });
}

void measureCase(const MemoryCase& memoryCase, StudyContext& context, ReportPart& part)
{
  const auto cloud = sphereCloud(memoryCase.points, PointOrder::Random);
  const ResampleTask task = taskOn(cloud, memoryCase.dimension);
  const std::int64_t voxels = voxelsOf(task);
  const int threads = mostThreads(context);
  for (std::unique_ptr<Rival>& rival : allRivals(context))
  {
    if (const std::string why = rival->refusal(task); !why.empty())
    {
      part.remarks.push_back(fmt::format("Left out ({}, {}): {}: {}", grouped(memoryCase.points),
        grouped(memoryCase.dimension), rival->name(), why));
      continue;
    }
    rival->load(task);
    PeakMemory memory;
    std::string message;
    const auto work = [&rival, threads]
    {
      vtkSMPTools::Initialize(threads);
      rival->run();
      return rival->resultBytes();
    };
    if (measurePeakMemory(work, memory, message))
    {
      addRow(memoryCase, rival->name(), voxels, threads, memory, part);
    }
    else
    {
      part.remarks.push_back(rival->name() + ": " + message);
    }
    rival.reset();
  }
}

} // namespace

ReportPart studyMemory(StudyContext& context)
{
  ReportPart part;
  part.title = "Memory, and the very first call";
  part.text = fmt::format(

    "Each contestant runs one update in a process of its own, with {} threads.\n"
    "\n"
    "- beyond: the kernel's high-water mark of resident memory during the update, less what was\n"
    "  resident before, less the result. Whole pages count, and what malloc keeps; memory reserved\n"
    "  but never touched does not, nor does the contestant's own copy of the input.\n"
    "- kept: what is still held after the update beyond input and result.\n"
    "- promise: 64 bytes an active voxel, and 16 bytes a point of the first five million.\n"
    "- cold call: the time of the first call in a fresh process.",
    mostThreads(context));
  part.table.header = { "points", "voxels on an axis", "contestant", "result MB", "beyond MB", "kept MB",
    "bytes/active voxel", "bytes/point", "x promise", "cold call ms" };
  const auto& options = context.options;
  std::vector<MemoryCase> cases = { { options.voxelPoints, options.dimension },
    { options.voxelPoints, options.dimensions.back() }, { options.zoomPoints, options.dimension } };
  for (const MemoryCase& memoryCase : cases)
  {
    context.progress(
      fmt::format("memory of {} points, {} voxels on an axis", memoryCase.points, memoryCase.dimension));
    measureCase(memoryCase, context, part);
  }
  return part;
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
