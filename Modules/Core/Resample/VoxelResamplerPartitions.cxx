/// VoxelResampler on lattices whose voxels can be divided into partitions.
#include "Core/Base/PointBlocks.h"
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
    , attributes_{ owner.reducers_, owner.firstAttribute_, owner.rows_, owner.binnedRows_ }
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
      worker_ = std::make_unique<Worker>();
    }
    worker_->prepare(owner_.plan_, covariances);
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
  Worker& operator*() const { return *worker_; }

private:
  Implementation& owner_;
  PartitionAttributes attributes_;
  std::unique_ptr<Worker> worker_;
};

/// Partitions that are whole layers of the next coarser lattice together.
class VoxelResampler::Implementation::PartitionGroups
{
public:
  explicit PartitionGroups(const PartitionPlan& plan)
    : partitions_(plan.partitions)
    , size_(plan.layerShift > 0 ? 1 : 2 * plan.blocksPerLayer)
    , done_((partitions_ - 1) / size_ + 1)
  {
  }
  std::uint32_t count() const { return std::uint32_t(done_.size()); }
  std::uint32_t groupOf(std::uint32_t partition) const { return partition / size_; }
  std::uint32_t begin(std::uint32_t group) const { return group * size_; }
  std::uint32_t end(std::uint32_t group) const { return std::min((group + 1) * size_, partitions_); }
  /// Marks a partition as done. @return true if it is the last of its group: what other threads wrote to the
  /// group's other partitions is visible then.
  bool finish(std::uint32_t partition)
  {
    const std::uint32_t group = groupOf(partition);
    return ++done_[group] == end(group) - begin(group);
  }

private:
  std::uint32_t partitions_;
  std::uint32_t size_;
  std::vector<std::atomic<std::uint32_t>> done_;
};

namespace
{

/// So many points may be in one voxel before the sums of their offsets could need more than 62 bits.
std::int64_t mostPointsOfBatch(int indexBits)
{
  return (std::int64_t(1) << (62 - kPositionBits + indexBits)) - 1;
}
static_assert(
  kChunkPoints < std::int64_t(1) << (62 - kPositionBits + kMinimumIndexBits), "a batch must hold a chunk");
static_assert(kChunkPoints <= kPointsPerReport, "progress is reported after each chunk");

/// The kernels' partition loops for points with other fields between them, block by block. With
/// PointRecordWriter::slots there is one range of one block at most, as slots count from its first point.
void partitionStrided(const Kernels& kernels, const PointQuantizer& quantizer, const PointView& points,
  const PointRange* ranges, std::int64_t count, PointRecordWriter& writer)
{
  for (std::int64_t r = 0; r < count; ++r)
  {
    if (points.floats())
    {
      forPointBlocks(points.floats(), points, ranges[r].begin, ranges[r].end,
        [&](const float* xyz, std::int64_t size)
        {
          const PointRange block = { 0, size };
          kernels.partitionFloats(quantizer, xyz, &block, 1, writer);
        });
      continue;
    }
    forPointBlocks(points.doubles(), points, ranges[r].begin, ranges[r].end,
      [&](const double* xyz, std::int64_t size)
      {
        const PointRange block = { 0, size };
        kernels.partitionDoubles(quantizer, xyz, &block, 1, writer);
      });
  }
}

/// The slots of the records of up to kMost points.
class RowSlots
{
public:
  static constexpr std::int64_t kMost = 1024;
  static_assert(kMost <= kPointBlock, "slots count from the first point of a block");

  /// Room for as many as that.
  std::uint32_t* clear()
  {
    std::fill(slots_, slots_ + kMost, kOutside);
    return slots_;
  }
  /// Writes the rows of the points inside beside their records.
  void copy(const RowLayout& layout, PointRange points, const PointIndex* index, char* rows) const
  {
    std::int64_t numbers[kMost];
    std::uint32_t slots[kMost];
    int inside = 0;
    for (std::int64_t i = points.begin; i < points.end; ++i)
    {
      slots[inside] = slots_[i - points.begin];
      numbers[inside] = index ? index->original(i) : i;
      inside += slots[inside] != kOutside;
    }
    layout.copy(numbers, slots, inside, rows);
  }

private:
  static constexpr std::uint32_t kOutside = ~std::uint32_t(0);
  std::uint32_t slots_[kMost];
};

std::int64_t pointsOf(const Chunks& chunks)
{
  std::int64_t sum = 0;
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    sum += chunks.pointCount(chunk);
  }
  return sum;
}

}

Status VoxelResampler::Implementation::runPlanned(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  halved_ = finerLattice(request.lattice, halvings_);
  const int indexBits = indexBitsOf(halved_);
  const Chunks chunks(request, kChunkPoints, executor);
  plan_ = makePlan(halved_, indexBits, chunks.count() == 0 ? 0 : chunks.pointCount(0));
  quantizer_ = makeQuantizer(request.transform, halved_, indexBits, kPositionBits);
  quantizer_.blocksPerLayer = plan_.blocksPerLayer;
  quantizer_.rowShift = plan_.rowShift;
  quantizer_.layerShift = plan_.layerShift;
  accumulated_.resize(plan_.partitions);
  for (AccumulatedPartition& partition : accumulated_)
  {
    partition.clear();
  }
  const std::int64_t mostPoints = mostPointsOfBatch(indexBits);
  const bool inBatches = keepsRuns_ || halvings_ > 0 || pointsOf(chunks) > mostPoints;
  reducesInPass_ = !reducers_.empty() && request.levels == 1 && !inBatches &&
    (chunks.count() <= 1 ||
      std::all_of(reducers_.begin(), reducers_.end(), [](const auto& reducer) { return reducer.isSum(); }));
  const bool holdsAll = (request.keepPointRecords || (!reducers_.empty() && !reducesInPass_)) &&
    chunks.count() == 1 && !inBatches;
  runs_.reset(inBatches ? plan_.partitions : 0, plan_.fractionBits);
  std::int64_t batchPoints = 0;
  std::int64_t inside = 0;
  invalid = request.index ? request.points.size() - finitePoints(*request.index) : 0;
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    fillPool(request, chunks, chunk, holdsAll || reducesInPass_, executor);
    inside += pool_.inside();
    invalid += pool_.invalid();
    batchPoints += chunks.pointCount(chunk);
    const bool isLast = chunk + 1 == chunks.count();
    if (inBatches && (isLast || batchPoints + chunks.pointCount(chunk + 1) > mostPoints))
    {
      closeBatch(request, executor);
      batchPoints = 0;
    }
    else
    {
      isLast ? finish(request, executor) : accumulateChunk(request, executor);
    }
    if (observer && !observer->report(fractionOfFinest(request) * double(chunk + 1) / double(chunks.count())))
    {
      return Status::Aborted;
    }
  }
  clipped = request.points.size() - inside - invalid;
  poolHoldsAll_ = holdsAll;
  if (inBatches)
  {
    return finishRuns(request, executor, observer);
  }
  if (request.levels == 1)
  {
    return Status::Ok;
  }
  return addLevels(request, std::move(runs_), 1, executor, observer);
}

void VoxelResampler::Implementation::chooseRows(const VoxelRequest& request)
{
  // Wider rows cost more memory than their locality is worth.
  constexpr std::size_t kMostBinnedBytes = 64;
  rows_.choose(request.tuples);
  binnedRows_.choose(rows_.bytes() > kMostBinnedBytes ? std::vector<TupleSource>(1) : request.tuples);
}

/// @param withRows for visitPointsByVoxel().
void VoxelResampler::Implementation::fillPool(const VoxelRequest& request, const Chunks& chunks,
  std::size_t chunk, bool withRows, const Executor& executor)
{
  if (withRows)
  {
    chooseRows(request);
  }
  pool_.prepare(
    chunks.pointCount(chunk), plan_.partitions, executor.concurrency(), withRows ? binnedRows_.bytes() : 0);
  const Kernels& kernels = kernelsFor(request.instructions);
  const PointRange* pieces = chunks.pieces(chunk);
  const PointView& points = chunks.points();
  const auto quantize = [&](const PointRange* ranges, std::int64_t count, PointRecordWriter& writer)
  {
    if (points.stride() != 3)
    {
      partitionStrided(kernels, quantizer_, points, ranges, count, writer);
      return;
    }
    points.floats() ? kernels.partitionFloats(quantizer_, points.floats(), ranges, count, writer)
                    : kernels.partitionDoubles(quantizer_, points.doubles(), ranges, count, writer);
  };
  const auto quantizeWithRows = [&](PointRange piece, PointRecordWriter& writer)
  {
    RowSlots slots;
    while (piece.begin < piece.end)
    {
      const PointRange part = { piece.begin, std::min(piece.begin + RowSlots::kMost, piece.end) };
      writer.slots = slots.clear();
      quantize(&part, 1, writer);
      slots.copy(binnedRows_, part, request.index, pool_.rows());
      piece.begin = part.end;
    }
  };
  forRange(executor, chunks.pieceCount(chunk), grainFor(chunks.pieceCount(chunk), executor),
    [&](std::int64_t first, std::int64_t last)
    {
      const PointRecordPool::Lease lease(pool_);
      if (!withRows)
      {
        quantize(pieces + first, last - first, lease.writer());
        return;
      }
      for (std::int64_t i = first; i < last; ++i)
      {
        quantizeWithRows(pieces[i], lease.writer());
      }
    });
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
      for (std::uint32_t p = next++; p < plan_.partitions; p = next++)
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
    [&](PartitionWorker& worker, std::uint32_t p) { worker.accumulate(kernels, pool_, p, accumulated_[p]); });
}

/// Adds the pool's records and the accumulated sums to the runs.
void VoxelResampler::Implementation::closeBatch(const VoxelRequest& request, const Executor& executor)
{
  const Kernels& kernels = kernelsFor(request.instructions);
  forPartitions(request, executor,
    [&](PartitionWorker& worker, std::uint32_t p)
    {
      VoxelRun run;
      worker.load(kernels, pool_, p, accumulated_[p], false, [](std::size_t) {});
      worker.forBatches([&](const MomentBatch<std::int64_t>& batch) { run.append(halved_, batch); });
      runs_.add(p, std::move(run));
      accumulated_[p].clear();
    });
}

/// Means of the pool's records and the accumulated sums; with levels, sums of the next level too.
void VoxelResampler::Implementation::finish(const VoxelRequest& request, const Executor& executor)
{
  const Kernels& kernels = kernelsFor(request.instructions);
  std::size_t room = 0;
  bool hasAccumulated = false;
  for (std::uint32_t p = 0; p < plan_.partitions; ++p)
  {
    room += mostVoxels(plan_, pool_.count(p), accumulated_[p].cellCount);
    hasAccumulated = hasAccumulated || accumulated_[p].cellCount > 0;
  }
  VoxelWriter writer(levels[0], plan_.partitions, room,
    { request.singlePrecision, request.keys, request.covariances,
      reducesInPass_ ? attributeBytes() : std::vector<std::size_t>() },
    plan_.fractionBits, request.allocator);
  const bool makesCoarse = request.levels > 1;
  PartitionGroups groups(plan_);
  if (makesCoarse)
  {
    runs_.reset(groups.count(), plan_.fractionBits + 1);
  }
  forPartitions(request, executor,
    [&](Worker& worker, std::uint32_t p)
    {
      std::size_t size = 0;
      worker.load(kernels, pool_, p, accumulated_[p], makesCoarse,
        [&](std::size_t known)
        {
          size = known;
          writer.publish(p, size);
        });
      writer.write(kernels, p, size, worker);
      if (makesCoarse && groups.finish(p))
      {
        coarsen(request, groups, groups.groupOf(p), worker);
      }
      else if (hasAccumulated && !makesCoarse)
      {
        accumulated_[p].attributes.clear();
        accumulated_[p].trim();
      }
    });
  writer.finish();
}

/// Adds the voxels of the next level that a group of partitions, which are all done, makes.
void VoxelResampler::Implementation::coarsen(
  const VoxelRequest& request, const PartitionGroups& groups, std::uint32_t group, Worker& worker)
{
  const CoarseVoxels coarsening(request.lattice, plan_.fractionBits, request.covariances);
  const std::uint32_t begin = groups.begin(group);
  const std::uint32_t end = groups.end(group);
  runs_.add(group, coarsening.ofPartitions(plan_, accumulated_, begin, end, worker.coarse));
  for (std::uint32_t p = begin; p < end; ++p)
  {
    accumulated_[p] = AccumulatedPartition();
  }
}

Status VoxelResampler::Implementation::visitPlanned(
  const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer)
{
  const Chunks chunks(request, kChunkPoints, executor);
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    if (!poolHoldsAll_)
    {
      fillPool(request, chunks, chunk, true, executor);
    }
    forRange(executor, plan_.partitions, grainFor(plan_.partitions, executor),
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
  RowReader reader(rows_, binnedRows_);
  worker.rank(kernelsFor(request.instructions), pool_, partition, level.arena.keys() + first,
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
