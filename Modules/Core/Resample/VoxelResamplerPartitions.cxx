/// VoxelResampler on lattices whose voxels can be divided into partitions.
#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <memory>

namespace pointhaptics
{

using namespace simd;

static_assert(kChunkPoints <= kPointsPerReport, "progress is reported after each chunk");

void VoxelResampler::Implementation::prepareStages(const VoxelRequest& request, const Chunks& chunks)
{
  binner_.prepare(request, chunks.pointCount(0));
  accumulated_.resize(binner_.plan().partitions);
  for (AccumulatedPartition& partition : accumulated_)
  {
    partition.clear();
  }
  const bool isOneChunk = chunks.count() == 1;
  const bool areSums = request.representative == Representative::Mean &&
    std::all_of(request.attributes.begin(), request.attributes.end(),
      [](const AttributeRequest& attribute) { return isSum(attribute.statistic); });
  reducesInPass_ = reduces(request) && request.levels == 1 && (isOneChunk || areSums);
  poolHoldsAll_ = isOneChunk && (request.keepPointRecords || (reduces(request) && !reducesInPass_));
  startCounts(request);
}

/// Calls work(worker, partition) for all partitions: each thread takes the next one, so that those before any
/// are done or at work.
template <typename Work>
void VoxelResampler::Implementation::forPartitions(
  const VoxelRequest& request, const Executor& executor, Work&& work)
{
  const PartitionReductions reductions = { request, binner_.rows() };
  while (workers_.size() < std::size_t(std::max(executor.concurrency(), 1)))
  {
    workers_.push_back(std::make_unique<PartitionWorker>());
  }
  for (const std::unique_ptr<PartitionWorker>& worker : workers_)
  {
    worker->prepare(binner_.plan(), request.covariances, reducesInPass_ ? &reductions : nullptr);
  }
  forEachItemWith(
    executor, binner_.plan().partitions,
    [&](std::size_t thread) -> PartitionWorker& { return *workers_[thread]; },
    [&](std::size_t p, PartitionWorker& worker) { work(worker, std::uint32_t(p)); });
  for (const std::unique_ptr<PartitionWorker>& worker : workers_)
  {
    worker->finish();
  }
}

/// Adds the pool's records to the accumulated sums.
void VoxelResampler::Implementation::accumulate(const VoxelRequest& request, const Executor& executor)
{
  const Kernels& kernels = kernelsFor(request.instructions);
  forPartitions(request, executor,
    [&](PartitionWorker& worker, std::uint32_t p)
    { worker.accumulate(kernels, binner_.pool(), p, accumulated_[p]); });
}

/// The pool's records and the accumulated sums become means, or sums, or both where levels are to follow.
void VoxelResampler::Implementation::accumulateAndWrite(const VoxelRequest& request, const Executor& executor)
{
  const Kernels& kernels = kernelsFor(request.instructions);
  const PartitionPlan& plan = binner_.plan();
  const bool keepsSums = keepsRuns_ || request.levels > 1;
  runs_.reset(keepsSums ? plan.partitions : 0, plan.fractionBits);
  std::size_t room = 0;
  for (std::uint32_t p = 0; !keepsRuns_ && p < plan.partitions; ++p)
  {
    room += mostVoxels(plan, binner_.pool().count(p), accumulated_[p].cellCount);
  }
  Level& level = levels[0];
  level.arena.prepare(room, layoutOf(request), level.lattice, plan.fractionBits, request.allocator);
  PartitionOrder order(level.firsts, plan.partitions);
  forPartitions(request, executor,
    [&](PartitionWorker& worker, std::uint32_t p)
    {
      std::size_t offset = 0;
      try
      {
        worker.load(kernels, binner_.pool(), p, accumulated_[p],
          [&](std::size_t size) { offset = order.append(p, keepsRuns_ ? 0 : size); });
      }
      catch (...)
      {
        order.giveUp();
        throw;
      }
      if (!keepsRuns_)
      {
        worker.write(kernels, level.arena, offset);
      }
      if (keepsSums)
      {
        runs_.add(p, worker.wide());
      }
      accumulated_[p].reductions = {};
      accumulated_[p].trim();
    });
  level.size = std::int64_t(level.firsts.back());
}

Status VoxelResampler::Implementation::visitBinned(
  const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer)
{
  const Chunks chunks(request, kChunkPoints, executor);
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    if (!poolHoldsAll_)
    {
      binner_.quantizeAndBin(request, chunks, chunk, true, executor);
    }
    forPartitions(request, executor,
      [&](PartitionWorker& worker, std::uint32_t p)
      {
        const std::size_t firstVoxel = levels[0].firsts[p];
        std::int64_t voxels[kBlockRecords];
        RowReader reader(binner_.rows());
        worker.rank(kernelsFor(request.instructions), binner_.pool(), p, levels[0].arena.keys() + firstVoxel,
          levels[0].firsts[p + 1] - firstVoxel,
          [&](const char* rows, const std::uint32_t* ranks, int count)
          {
            std::transform(ranks, ranks + count, voxels,
              [=](std::uint32_t rank) { return std::int64_t(firstVoxel + rank); });
            visit(reader.read(rows, count), voxels, count);
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
