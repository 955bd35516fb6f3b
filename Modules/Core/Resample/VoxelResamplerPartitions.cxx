/// VoxelResampler on lattices whose voxels can be divided into partitions.
#include "Core/Base/PointBlocks.h"
#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/Stages/VoxelWriter.h"
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <atomic>
#include <type_traits>
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
      worker_ = std::make_unique<PartitionWorker>();
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
  PartitionWorker& operator*() const { return *worker_; }

private:
  Implementation& owner_;
  PartitionAttributes attributes_;
  std::unique_ptr<PartitionWorker> worker_;
};

namespace
{

static_assert(kChunkPoints <= kPointsPerReport, "progress is reported after each chunk");

/// Copies the rows of points beside their records.
struct RowCopier
{
  const RowLayout& layout;
  const PointIndex* index;
  char* rows;
  std::int64_t first; ///< Point that the writer counts from.

  static void copy(const void* context, const std::uint32_t* points, const std::uint32_t* slots, int count)
  {
    const auto& self = *static_cast<const RowCopier*>(context);
    std::int64_t numbers[kBlockRecords];
    std::transform(points, points + count, numbers,
      [&](std::uint32_t point)
      { return self.index ? self.index->original(self.first + point) : self.first + point; });
    self.layout.copy(numbers, slots, count, self.rows);
  }
};

/// Bins ranges of points: all at once, or, with rows or where other fields lie between points, one by one.
void binRanges(const Kernels& kernels, const PointQuantizer& quantizer, const PointView& points,
  const PointRange* ranges, std::int64_t count, RowCopier& rows, PointRecordWriter& writer)
{
  const auto bin = [&](const auto* xyz, const PointRange* some, std::int64_t number)
  {
    if constexpr (std::is_same_v<decltype(xyz), const float*>)
    {
      kernels.partitionFloats(quantizer, xyz, some, number, writer);
    }
    else
    {
      kernels.partitionDoubles(quantizer, xyz, some, number, writer);
    }
  };
  const auto binAll = [&](const auto* xyz)
  {
    const bool atOnce = points.stride() == 3 && !writer.binned;
    if (atOnce)
    {
      bin(xyz, ranges, count);
    }
    for (std::int64_t r = 0; !atOnce && r < count; ++r)
    {
      rows.first = ranges[r].begin;
      forPointBlocks(xyz, points, ranges[r].begin, ranges[r].end,
        [&](const auto* block, std::int64_t size)
        {
          const PointRange all = { 0, size };
          bin(block, &all, 1);
          rows.first += size;
        });
    }
  };
  points.floats() ? binAll(points.floats()) : binAll(points.doubles());
}

}

Status VoxelResampler::Implementation::runPlanned(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  const int indexBits = indexBitsOf(request.lattice);
  const Chunks chunks(request, kChunkPoints, executor);
  plan_ = makePlan(request.lattice, indexBits, chunks.count() == 0 ? 0 : chunks.pointCount(0));
  quantizer_ = makeQuantizer(request.transform, request.lattice, indexBits, kPositionBits);
  quantizer_.blocksPerLayer = plan_.blocksPerLayer;
  quantizer_.rowShift = plan_.rowShift;
  quantizer_.layerShift = plan_.layerShift;
  accumulated_.resize(plan_.partitions);
  for (AccumulatedPartition& partition : accumulated_)
  {
    partition.clear();
  }
  reducesInPass_ = !reducers_.empty() && request.levels == 1 &&
    (chunks.count() <= 1 ||
      std::all_of(reducers_.begin(), reducers_.end(), [](const auto& reducer) { return reducer.isSum(); }));
  const bool holdsAll =
    (request.keepPointRecords || (!reducers_.empty() && !reducesInPass_)) && chunks.count() == 1;
  runs_.reset(0, plan_.fractionBits);
  std::int64_t inside = 0;
  invalid = request.index ? request.points.size() - finitePoints(*request.index) : 0;
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    fillPool(request, chunks, chunk, holdsAll || reducesInPass_, executor);
    inside += pool_.inside();
    invalid += pool_.invalid();
    chunk + 1 == chunks.count() ? finish(request, executor) : accumulateChunk(request, executor);
    if (observer && !observer->report(fractionOfFinest(request) * double(chunk + 1) / double(chunks.count())))
    {
      return Status::Aborted;
    }
  }
  clipped = request.points.size() - inside - invalid;
  poolHoldsAll_ = holdsAll;
  return request.levels > 1 ? addLevels(request, executor, observer) : Status::Ok;
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
  const PointRange* pieces = chunks.pieces(chunk);
  forRange(executor, chunks.pieceCount(chunk), grainFor(chunks.pieceCount(chunk), executor),
    [&](std::int64_t first, std::int64_t last)
    {
      const PointRecordPool::Lease lease(pool_);
      RowCopier rows = { binnedRows_, request.index, pool_.rows(), 0 };
      lease.writer().binned = withRows ? &RowCopier::copy : nullptr;
      lease.writer().context = &rows;
      binRanges(kernelsFor(request.instructions), quantizer_, chunks.points(), pieces + first, last - first,
        rows, lease.writer());
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

/// The pool's records and the accumulated sums become means, or sums, or both where levels are to follow.
void VoxelResampler::Implementation::finish(const VoxelRequest& request, const Executor& executor)
{
  const Kernels& kernels = kernelsFor(request.instructions);
  const bool keepsSums = keepsRuns_ || request.levels > 1;
  runs_.reset(keepsSums ? plan_.partitions : 0, plan_.fractionBits);
  std::size_t room = 0;
  for (std::uint32_t p = 0; !keepsRuns_ && p < plan_.partitions; ++p)
  {
    room += mostVoxels(plan_, pool_.count(p), accumulated_[p].cellCount);
  }
  VoxelWriter writer(levels[0], plan_.partitions, room,
    { request.singlePrecision, request.keys, request.covariances,
      reducesInPass_ ? attributeBytes() : std::vector<std::size_t>() },
    plan_.fractionBits, request.allocator);
  forPartitions(request, executor,
    [&](PartitionWorker& worker, std::uint32_t p)
    {
      std::size_t size = 0;
      worker.load(kernels, pool_, p, accumulated_[p],
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
        runs_.add(p, worker.wide());
        accumulated_[p] = AccumulatedPartition();
      }
      accumulated_[p].attributes.clear();
      accumulated_[p].trim();
    });
  writer.finish();
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
