/// VoxelResampler on lattices whose voxels can be divided into partitions.
#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/Stages/VoxelWriter.h"
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace pointhaptics
{

using namespace simd;

/// A worker nobody else uses, for as long as this lives.
class VoxelResampler::Implementation::WorkerLease
{
public:
  WorkerLease(Implementation& owner, bool covariances)
    : owner_(owner)
    , attributes_{ owner.reducers_, owner.firstAttribute_, owner.binner_.rows(), owner.binner_.binnedRows() }
  {
    {
      const std::lock_guard<std::mutex> lock(owner_.mutex_);
      if (!owner_.idle_.empty())
      {
        worker_ = std::move(owner_.idle_.back());
        owner_.idle_.pop_back();
      }
    }
    if (!worker_)
    {
      worker_ = std::make_unique<PartitionWorker>();
    }
    worker_->prepare(owner_.binner_.plan(), covariances);
    worker_->reduce(owner_.reducesInPass_ ? &attributes_ : nullptr);
  }
  ~WorkerLease()
  {
    worker_->reduce(nullptr);
    const std::lock_guard<std::mutex> lock(owner_.mutex_);
    owner_.idle_.push_back(std::move(worker_));
  }
  WorkerLease(const WorkerLease&) = delete;
  WorkerLease& operator=(const WorkerLease&) = delete;
  PartitionWorker& operator*() const { return *worker_; }

private:
  Implementation& owner_;
  PartitionAttributes attributes_;
  std::unique_ptr<PartitionWorker> worker_;
};

static_assert(kChunkPoints <= kPointsPerReport, "progress is reported after each chunk");

Status VoxelResampler::Implementation::runBinned(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  const Chunks chunks(request, kChunkPoints, executor);
  binner_.prepare(request, chunks.count() == 0 ? 0 : chunks.pointCount(0));
  const PartitionPlan& plan = binner_.plan();
  accumulated_.resize(plan.partitions);
  for (AccumulatedPartition& partition : accumulated_)
  {
    partition.clear();
  }
  reducesInPass_ = !reducers_.empty() && request.levels == 1 &&
    (chunks.count() <= 1 ||
      std::all_of(reducers_.begin(), reducers_.end(), [](const auto& reducer) { return reducer.isSum(); }));
  const bool holdsAll =
    (request.keepPointRecords || (!reducers_.empty() && !reducesInPass_)) && chunks.count() == 1;
  runs_.reset(0, plan.fractionBits);
  std::int64_t inside = 0;
  invalid = request.index ? request.points.size() - finitePoints(*request.index) : 0;
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    binner_.bin(request, chunks, chunk, holdsAll || reducesInPass_, executor);
    inside += binner_.pool().inside();
    invalid += binner_.pool().invalid();
    chunk + 1 == chunks.count() ? finish(request, executor) : accumulateChunk(request, executor);
    if (observer && !observer->report(fractionOfFinest(request) * double(chunk + 1) / double(chunks.count())))
    {
      return Status::Aborted;
    }
  }
  clipped = request.points.size() - inside - invalid;
  poolHoldsAll_ = holdsAll;
  return request.levels > 1 ? addLevels(request, 1, executor, observer) : Status::Ok;
}

/// Calls work(worker, partition) for all partitions: each thread takes the next one, so that those before any
/// are done or at work.
template <typename Work>
void VoxelResampler::Implementation::forPartitions(
  const VoxelRequest& request, const Executor& executor, Work&& work)
{
  std::atomic<std::uint32_t> next{ 0 };
  forRange(executor, executor.concurrency(), 1,
    [&](std::int64_t, std::int64_t)
    {
      const WorkerLease lease(*this, request.covariances);
      for (std::uint32_t p = next++; p < binner_.plan().partitions; p = next++)
      {
        work(*lease, p);
      }
    });
}

/// Adds the pool's records to the accumulated sums.
void VoxelResampler::Implementation::accumulateChunk(const VoxelRequest& request, const Executor& executor)
{
  const Kernels& kernels = kernelsFor(request.instructions);
  forPartitions(request, executor,
    [&](PartitionWorker& worker, std::uint32_t p)
    { worker.accumulate(kernels, binner_.pool(), p, accumulated_[p]); });
}

/// The pool's records and the accumulated sums become means, or sums, or both where levels are to follow.
void VoxelResampler::Implementation::finish(const VoxelRequest& request, const Executor& executor)
{
  const Kernels& kernels = kernelsFor(request.instructions);
  const bool keepsSums = keepsRuns_ || request.levels > 1;
  const int fractionBits = binner_.plan().fractionBits;
  const bool isCoarse = !keepsRuns_ && request.levels > 1;
  runs_.reset(keepsSums ? binner_.plan().partitions : 0, fractionBits + int(isCoarse));
  std::size_t room = 0;
  for (std::uint32_t p = 0; !keepsRuns_ && p < binner_.plan().partitions; ++p)
  {
    room += mostVoxels(binner_.plan(), binner_.pool().count(p), accumulated_[p].cellCount);
  }
  VoxelWriter writer(levels[0], binner_.plan().partitions, room,
    { request.singlePrecision, request.keys, request.covariances,
      reducesInPass_ ? attributeBytes() : std::vector<std::size_t>() },
    binner_.plan().fractionBits, request.allocator);
  forPartitions(request, executor,
    [&](PartitionWorker& worker, std::uint32_t p)
    {
      std::size_t size = 0;
      worker.load(kernels, binner_.pool(), p, accumulated_[p],
        [&](std::size_t known)
        {
          size = keepsRuns_ ? 0 : known;
          writer.publish(p, size);
        });
      if (!keepsRuns_)
      {
        writer.write(kernels, p, size, worker);
      }
      if (keepsSums)
      {
        runs_.add(
          p, isCoarse ? sumCoarseVoxels(worker.wide(), request.lattice, fractionBits) : worker.wide());
      }
      accumulated_[p].attributes.clear();
      accumulated_[p].trim();
    });
  writer.finish();
  if (isCoarse)
  {
    joinLayers(executor);
  }
}

/// The runs of partitions, which have parts of coarse layers, become those of whole ones.
void VoxelResampler::Implementation::joinLayers(const Executor& executor)
{
  const std::size_t together = binner_.plan().layerShift > 0 ? 1 : 2 * binner_.plan().blocksPerLayer;
  VoxelRuns layers;
  layers.reset((runs_.ranges() - 1) / together + 1, runs_.fractionBits());
  forEachItem(executor, layers.ranges(),
    [&](std::size_t layer)
    {
      for (std::size_t p = layer * together; p < std::min((layer + 1) * together, runs_.ranges()); ++p)
      {
        if (runs_.size(p) > 0)
        {
          layers.add(layer, runs_.run(p));
        }
      }
      layers.join(layer);
    });
  runs_ = std::move(layers);
}

Status VoxelResampler::Implementation::visitBinned(
  const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer)
{
  const Chunks chunks(request, kChunkPoints, executor);
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    if (!poolHoldsAll_)
    {
      binner_.bin(request, chunks, chunk, true, executor);
    }
    forRange(executor, binner_.plan().partitions, grainFor(binner_.plan().partitions, executor),
      [&](std::int64_t begin, std::int64_t end)
      {
        const WorkerLease lease(*this, false);
        for (auto p = std::uint32_t(begin); p < std::uint32_t(end); ++p)
        {
          visitPartition(request, *lease, p, std::int64_t(levels[0].firsts[p]), visit);
        }
      });
    if (observer && !observer->report(double(chunk + 1) / double(chunks.count())))
    {
      return Status::Aborted;
    }
  }
  return Status::Ok;
}

/// Visits the points of the pool in a partition. Its voxels get numbers from @p firstVoxel on.
void VoxelResampler::Implementation::visitPartition(const VoxelRequest& request, PartitionWorker& worker,
  std::uint32_t partition, std::int64_t firstVoxel, const Visitor& visit)
{
  const Level& level = levels[0];
  const std::size_t first = level.firsts[partition];
  std::int64_t voxels[kBlockRecords];
  RowReader reader(binner_.rows(), binner_.binnedRows());
  worker.rank(kernelsFor(request.instructions), binner_.pool(), partition, level.arena.keys() + first,
    level.firsts[partition + 1] - first,
    [&](const char* rows, const std::uint32_t* ranks, int count)
    {
      for (int i = 0; i < count; ++i)
      {
        voxels[i] = firstVoxel + ranks[i];
      }
      visit(reader.read(rows, count), voxels, count);
    });
}

void VoxelResampler::Implementation::visitPointsByVoxelSet(
  const VoxelRequest& request, const SetWork& work, const Executor& executor)
{
  const std::vector<std::size_t>& firsts = levels[0].firsts;
  forPartitions(request, executor,
    [&](PartitionWorker& worker, std::uint32_t p)
    {
      if (firsts[p + 1] > firsts[p])
      {
        work(std::int64_t(firsts[p]), std::int64_t(firsts[p + 1] - firsts[p]),
          [&](const Visitor& visit) { visitPartition(request, worker, p, 0, visit); });
      }
    });
}

} // namespace pointhaptics
