/// @file
/// From the records of a partition to the sums of its voxels, in ascending order.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/Reductions/NearestRecords.h"
#include "Core/Resample/Reductions/VoxelReductions.h"
#include "Core/Resample/Stages/PointBinner.h"
#include "Core/Resample/Stages/VoxelSink.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// The accumulated sums of a partition: cells with packed sums, and what the packed sums of overfull cells
/// could not hold. Second moments exist only if covariances are wanted.
struct alignas(kApart) AccumulatedPartition
{
  std::size_t cellCount = 0; ///< The vectors may have more elements, which are unused.
  std::vector<std::uint32_t> cells;
  std::vector<PackedSums> packed;
  std::vector<SplitSecondMoments> splitSecondMoments;
  VoxelRun overfull;
  std::int64_t points = 0; ///< In cells; as many or fewer are in their packed sums.

  void clear()
  {
    cellCount = 0;
    overfull.clear();
    points = 0;
  }
  /// Frees memory that is mostly unused. The sums are dropped then: call it when they are no longer needed.
  void trim()
  {
    constexpr std::size_t kFewCells = 1024;
    if (packed.capacity() > 2 * cellCount + kFewCells)
    {
      *this = AccumulatedPartition();
    }
  }
  std::size_t bytes() const
  {
    return cells.capacity() * sizeof(std::uint32_t) + packed.capacity() * sizeof(PackedSums) +
      splitSecondMoments.capacity() * sizeof(SplitSecondMoments) + overfull.bytes();
  }
};

/// Points of a partition: their records, their numbers, if these are kept, and those of their voxels.
struct RankedBlock
{
  const PointRecord* records = nullptr;
  const std::uint32_t* payloads = nullptr; ///< Of the records.
  int count = 0;
  std::int64_t points[kBlockRecords];
  std::int64_t voxels[kBlockRecords];
};

/// Works on one partition at a time and is used by one thread at a time.
class alignas(kApart) PartitionWorker
{
public:
  /// For partitions that @p binner filled for @p request; both must outlive the work. @p reduces: load()
  /// makes what the request wants besides sums, too; of each point the voxel goes to @p voxelIndex. All
  /// records are kept then.
  void prepare(
    const VoxelRequest& request, const PointBinner& binner, bool reduces, std::int64_t* voxelIndex);
  /// Frees what is of no use for another plan.
  void finish() { reductions_ = {}; }
  /// Adds the records of a partition to its @p old sums, which may change. Calls publish(size) as soon as the
  /// number of voxels is known, for the number of the first. @return that. The voxels are valid until the
  /// next call.
  template <typename Publish>
  std::size_t load(std::uint32_t partition, AccumulatedPartition& old, Publish&& publish)
  {
    const bool isTooMany = binner_->count(partition) > kMostPackedPoints;
    for (std::size_t pool = 0; isTooMany && pool < binner_->pools(); ++pool)
    {
      accumulate(partition, old, pool);
    }
    partition_ = partition;
    old_ = &old;
    pools_ = { 0, isTooMany ? 0 : binner_->pools() };
    countOccupied();
    firstVoxel_ = publish(voxels_.size);
    sumRecords(old_->cellCount > 0 ? *old_ : own_, reduces_);
    return firstVoxel_;
  }
  /// The number of voxels that load() will publish; for a partition of very many points an upper bound.
  std::size_t countVoxels(std::uint32_t partition, AccumulatedPartition& old);
  /// All the voxels in wide sums.
  VoxelRun wide() const;
  /// What the arrays of the request have in the voxels, where prepare() was asked to reduce them. After
  /// write().
  std::vector<VoxelTally> takeTallies() { return reductions_.takeTallies(); }
  /// Writes the voxels, and what prepare() was asked to reduce, to @p arena, from @p offset on.
  void write(const Kernels& kernels, MeanArena& arena, std::size_t offset) const;
  /// Adds the records that a pool has of a partition to its accumulated sums.
  void accumulate(std::uint32_t partition, AccumulatedPartition& sums, std::size_t pool);
  /// Calls visit(block, next) for the blocks of a partition, whose voxels' @p keys ascend; voxels are counted
  /// from @p firstVoxel. Blocks may be empty: the first one, and what follows the last.
  template <typename Visit>
  void visit(std::uint32_t partition, const std::uint64_t* keys, std::size_t size, std::size_t firstVoxel,
    Visit&& visit)
  {
    makeTables();
    partition_ = partition;
    const std::uint64_t firstKey = plan().firstKey(partition);
    places_.resize(size);
    std::transform(
      keys, keys + size, places_.begin(), [=](std::uint64_t key) { return std::uint32_t(key - firstKey); });
    kernels_->setOccupied(places_.data(), int(size), occupancy_.data());
    rankOccupied({ places_.data(), size }, {});
    rankRecords();
    visitRanked(firstVoxel, visit);
    clearOccupancy({ places_.data(), size });
  }
  std::size_t bytes() const;

private:
  struct CellList
  {
    const std::uint32_t* cells = nullptr;
    std::size_t count = 0;
  };

  void makeTables();
  CellRanks ranks() const;
  const PartitionPlan& plan() const { return binner_->plan(); }
  std::size_t rankOccupied(CellList cells, CellList others);
  void clearOccupancy(CellList cells);
  void countOccupied();
  void sumRecords(AccumulatedPartition& to, bool reduces);
  void makeRoom(AccumulatedPartition& sums) const;
  /// Calls visit(block) for the blocks of the partition.
  template <typename Visit>
  void forBlocks(const Visit& visit) const
  {
    for (std::size_t number = pools_.first; number < pools_.last; ++number)
    {
      const PointRecordPool& pool = binner_->pool(number);
      for (PointRecordPool::Walk block(pool, partition_); block.next();)
      {
        visit(block);
      }
    }
  }
  void rankRecords();
  /// visit() of records whose ranks are known.
  template <typename Visit>
  void visitRanked(std::size_t firstVoxel, const Visit& visit)
  {
    RankedBlock blocks[2]; // One is visited while the next one's tuples are on their way.
    RankedBlock* next = blocks;
    const auto visitOther = [&]
    {
      RankedBlock* const block = next == blocks ? blocks + 1 : blocks;
      visit(*block, *next);
      block->count = 0;
      next = block;
    };
    const std::uint32_t* ranks = recordCells_.data();
    forBlocks(
      [&](const PointRecordPool::Walk& block)
      {
        next->records = block.records();
        next->payloads = block.payloads();
        next->count = block.count();
        std::transform(ranks, ranks + block.count(), next->voxels,
          [=](std::uint32_t rank) { return std::int64_t(firstVoxel + rank); });
        ranks += block.count();
        block.copyNumbers(next->points);
        visitOther();
      });
    visitOther();
  }
  void reduce();
  void reduceVoxels();

  const VoxelRequest* request_ = nullptr;
  const PointBinner* binner_ = nullptr;
  const Kernels* kernels_ = nullptr;
  bool reduces_ = false;
  std::int64_t* voxelIndex_ = nullptr; ///< Or null.
  std::size_t firstVoxel_ = 0;
  std::uint32_t partition_ = 0;
  AccumulatedPartition* old_ = nullptr;
  struct
  {
    std::size_t first;
    std::size_t last;
  } pools_{}; ///< Those at work.
  PartitionVoxels voxels_;
  bool covariances_ = false;
  Buffer<std::uint64_t> occupancy_; ///< Zeros between partitions.
  Buffer<std::uint64_t> touched_; ///< Likewise; a bit for each occupancy word in use, of a sparse partition.
  bool isSparse_ = false;
  Buffer<std::uint32_t> rankTable_;
  Buffer<std::uint32_t> recordCells_; ///< Where asked for, they become ranks.
  AccumulatedPartition own_;          ///< Sums that are not accumulated further.
  VoxelReductions reductions_;        ///< Of the voxels.
  std::optional<NearestRecords> nearest_;
  std::vector<std::uint32_t> places_; ///< Of the accumulated cells among the voxels; of a visit the cells.
  std::vector<std::int64_t> counts_;  ///< Of the voxels.
};

} // namespace simd
} // namespace pointhaptics
