/// VoxelResampler on lattices whose voxels can be divided into partitions.
#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/Stages/VoxelRuns.h"
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>

namespace pointhaptics
{

using namespace simd;

/// So many chunks are kept until all points are summed, each 20 to 52 bytes a point.
constexpr std::size_t kMostHeldChunks = 16;

static_assert(kChunkPoints <= kPointsPerReport, "progress is reported after each chunk");

void VoxelResampler::Implementation::prepareStages(const VoxelRequest& request, const Chunks& chunks)
{
  binner_.prepare(request, chunks.pointCount(0));
  accumulated_.resize(binner_.plan().partitions);
  for (AccumulatedPartition& partition : accumulated_)
  {
    partition.clear();
  }
  holdsAll_ = wantsPoints(request) &&
    (chunks.count() <= kMostHeldChunks || request.representative != Representative::Mean);
  startCounts(request);
}

/// Calls work(worker, partition) for the partitions from @p first to before @p last: each thread takes the
/// next one, so that those before any are done or at work.
template <typename Work>
void VoxelResampler::Implementation::forPartitions(
  const VoxelRequest& request, std::uint32_t first, std::uint32_t last, const Executor& executor, Work&& work)
{
  while (workers_.size() < std::size_t(std::max(executor.concurrency(), 1)))
  {
    workers_.push_back(std::make_unique<PartitionWorker>());
  }
  for (const std::unique_ptr<PartitionWorker>& worker : workers_)
  {
    worker->prepare(request, binner_, holdsAll_, voxelIndex.data());
  }
  try
  {
    forEachItemWith(
      executor, last - first, [&](std::size_t thread) -> PartitionWorker& { return *workers_[thread]; },
      [&](std::size_t p, PartitionWorker& worker) { work(worker, first + std::uint32_t(p)); });
  }
  catch (...)
  {
    workers_.clear(); // The next run finds no occupancy bits of this one.
    throw;
  }
  for (const std::unique_ptr<PartitionWorker>& worker : workers_)
  {
    worker->finish();
  }
}

/// Adds the records of a chunk to the accumulated sums.
void VoxelResampler::Implementation::accumulate(const VoxelRequest& request, const Executor& executor)
{
  forPartitions(request, 0, binner_.plan().partitions, executor,
    [&](PartitionWorker& worker, std::uint32_t p) { worker.accumulate(p, accumulated_[p], 0); });
}

/// Makes room for the voxels: for as many as there may be, of which what is not written is never touched, or,
/// where a machine or a limit counts that, too, for as many as there are.
void VoxelResampler::Implementation::makeOutput(const VoxelRequest& request, const Executor& executor)
{
  const PartitionPlan& plan = binner_.plan();
  MeanArena& arena = levels[0].arena;
  const auto prepare = [&](std::size_t room)
  { arena.prepare(room, layoutOf(request), levels[0].lattice, plan.fractionBits, request.allocator); };
  std::size_t most = 0;
  for (std::uint32_t p = 0; writesMeans(request) && p < plan.partitions; ++p)
  {
    most += mostVoxels(plan, binner_.count(p), accumulated_[p].cellCount);
  }
  try
  {
    prepare(most);
  }
  catch (const std::bad_alloc&)
  {
    arena = MeanArena();
    std::atomic<std::size_t> voxels{ 0 };
    forPartitions(request, 0, plan.partitions, executor,
      [&](PartitionWorker& worker, std::uint32_t p) { voxels += worker.countVoxels(p, accumulated_[p]); });
    prepare(voxels);
  }
}

/// The records that are kept and the accumulated sums become means, or sums, or both where levels are to
/// follow.
/// @p rounds: of partitions, with a report after each. @return false where @p observer ended the work.
bool VoxelResampler::Implementation::accumulateAndWrite(
  const VoxelRequest& request, std::size_t rounds, const Executor& executor, ProgressObserver* observer)
{
  const Kernels& kernels = kernelsFor(request.instructions);
  const PartitionPlan& plan = binner_.plan();
  std::vector<VoxelRun> runs(keepsSums_ || request.levels > 1 ? plan.partitions : 0);
  const bool writes = writesMeans(request);
  makeOutput(request, executor);
  Level& level = levels[0];
  PartitionOrder order(level.firsts, plan.partitions);
  const auto write = [&](PartitionWorker& worker, std::uint32_t p)
  {
    std::size_t offset = 0;
    try
    {
      offset =
        worker.load(p, accumulated_[p], [&](std::size_t size) { return order.append(p, writes ? size : 0); });
    }
    catch (...)
    {
      order.giveUp();
      throw;
    }
    if (writes)
    {
      worker.write(kernels, level.arena, offset);
    }
    if (!runs.empty())
    {
      runs[p] = worker.wide();
      if (keepsTallies(request) && holdsAll_ && runs[p].size() > 0)
      {
        runs[p].tallies = worker.takeTallies();
      }
    }
    accumulated_[p].trim();
  };
  for (std::size_t round = 0; round < rounds; ++round)
  {
    const auto firstOf = [=](std::size_t r) { return std::uint32_t(plan.partitions * r / rounds); };
    forPartitions(request, firstOf(round), firstOf(round + 1), executor, write);
    if (observer && !observer->report(double(round + 1) / double(rounds)))
    {
      return false;
    }
  }
  level.size = std::int64_t(level.firsts.back());
  sums_ = concatenated(runs, executor);
  return true;
}

Status VoxelResampler::Implementation::visitBinned(
  const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer)
{
  const Chunks chunks(request, kChunkPoints, executor);
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    binner_.quantizeAndBin(request, chunks, chunk, PointBinner::Keep::Numbers, executor);
    forPartitions(request, 0, binner_.plan().partitions, executor,
      [&](PartitionWorker& worker, std::uint32_t p)
      {
        const std::size_t first = levels[0].firsts[p];
        worker.visit(p, levels[0].arena.keys() + first, levels[0].firsts[p + 1] - first, first,
          [&](const RankedBlock& block, const RankedBlock&)
          {
            if (block.count > 0)
            {
              visit(block.points, block.voxels, block.count);
            }
          });
      });
    if (observer && !observer->report(double(chunk + 1) / double(chunks.count())))
    {
      return Status::Aborted;
    }
  }
  return Status::Ok;
}

} // namespace pointhaptics
