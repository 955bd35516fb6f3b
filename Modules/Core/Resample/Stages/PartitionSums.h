/// @file
/// From the records of a partition to the sums of its voxels, in ascending order.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/Stages/PointBinner.h"
#include "Core/Resample/Stages/RowReader.h"
#include "Core/Resample/Stages/VoxelSink.h"
#include "Core/Resample/VoxelReductions.h"

#include <cstdint>
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
  VoxelReductions reductions; ///< Of the cells, where they are made with the sums.
  std::int64_t points = 0;    ///< In cells; as many or fewer are in their packed sums.

  void clear()
  {
    cellCount = 0;
    overfull.clear();
    reductions = {};
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

/// The request for what is made of rows where points are summed, and the rows.
struct PartitionReductions
{
  const VoxelRequest& request;
  const RowLayout& rows;
};

/// Works on one partition at a time and is used by one thread at a time.
class alignas(kApart) PartitionWorker
{
public:
  /// For partitions of a plan. @p reductions: what load() and accumulate() reduce besides; nothing if null.
  void prepare(const PartitionPlan& plan, bool covariances, const PartitionReductions* reductions);
  /// Frees what is of no use for another plan.
  void finish() { own_.reductions = {}; }
  /// Adds the records of a partition to its @p old sums, which may change. Calls publish(size) as soon as the
  /// number of voxels is known. The voxels are valid until the next call.
  template <typename Publish>
  void load(const Kernels& kernels, const PointRecordPool& pool, std::uint32_t partition,
    AccumulatedPartition& old, Publish&& publish)
  {
    partition_ = partition;
    old_ = &old;
    countOccupied(kernels, pool);
    publish(voxels_.size);
    sumRecords(kernels, pool, old_->cellCount > 0 ? *old_ : own_);
  }
  /// All the voxels in wide sums.
  VoxelRun wide() const;
  /// Writes the voxels, and what prepare() was asked to reduce, to @p arena, from @p offset on.
  void write(const Kernels& kernels, MeanArena& arena, std::size_t offset) const;
  /// Adds the records of a partition to its accumulated sums.
  void accumulate(
    const Kernels& kernels, const PointRecordPool& pool, std::uint32_t partition, AccumulatedPartition& sums);
  /// Calls visit(rows, ranks, count) with the row of each record and the rank of its voxel among the
  /// partition's @p keys (ascending).
  template <typename Visit>
  void rank(const Kernels& kernels, const PointRecordPool& pool, std::uint32_t partition,
    const std::uint64_t* keys, std::size_t size, Visit&& visit)
  {
    makeTables();
    const CellMap map = plan_.cellMap(partition);
    const std::uint64_t firstKey = plan_.firstKey(partition);
    recordCells_.reserve(size);
    for (std::size_t i = 0; i < size; ++i)
    {
      recordCells_[i] = std::uint32_t(keys[i] - firstKey);
    }
    kernels.setOccupied(recordCells_.data(), int(size), occupancy_.data());
    rankOccupied(kernels, { recordCells_.data(), size }, {});
    for (PointRecordPool::Walk block(pool, partition); block.next();)
    {
      std::uint32_t cells[kBlockRecords];
      block.fetchRows();
      kernels.cells(map, block.records(), block.count(), block.recordsAhead(), cells);
      kernels.rank(ranks(), cells, block.count());
      visit(block.rows(), cells, block.count());
    }
    clearOccupancy({ recordCells_.data(), size });
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
  std::size_t rankOccupied(const Kernels& kernels, CellList cells, CellList others);
  void clearOccupancy(CellList cells);
  void countOccupied(const Kernels& kernels, const PointRecordPool& pool);
  void sumRecords(const Kernels& kernels, const PointRecordPool& pool, AccumulatedPartition& to);
  void makeRoom(AccumulatedPartition& sums) const;
  void reduceRows(const PointRecordPool& pool, AccumulatedPartition& sums);

  PartitionPlan plan_;
  std::uint32_t partition_ = 0;
  AccumulatedPartition* old_ = nullptr;
  PartitionVoxels voxels_;
  bool covariances_ = false;
  Buffer<std::uint64_t> occupancy_; ///< Zeros between partitions.
  Buffer<std::uint64_t> touched_; ///< Likewise; a bit for each occupancy word in use, of a sparse partition.
  bool isSparse_ = false;
  Buffer<std::uint32_t> rankTable_;
  Buffer<std::uint32_t> recordCells_;
  AccumulatedPartition own_; ///< Sums that are not accumulated further.
  const PartitionReductions* reductions_ = nullptr;
  const VoxelReductions* reduced_ = nullptr; ///< Of the voxels.
  std::vector<std::uint32_t> places_;        ///< Of the accumulated cells among the voxels.
  std::vector<std::int64_t> counts_;         ///< Of the voxels.
};

} // namespace simd
} // namespace pointhaptics
