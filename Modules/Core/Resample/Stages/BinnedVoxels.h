/// @file
/// From the records of a partition to the sums of its voxels, in ascending order.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/Stages/PointBinner.h"
#include "Core/Resample/Stages/VoxelWriter.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics::simd
{

/// Some points of a partition, and their voxels, counted from the first of the partition.
struct BinnedBlock
{
  const PointRecord* records = nullptr;
  const std::uint32_t* payloads = nullptr; ///< Payloads of the records.
  std::uint64_t fractionMask = 0;
  int count = 0;
  std::int64_t points[kBlockRecords]; ///< Their numbers, if these are kept.
  std::int64_t voxels[kBlockRecords];

  /// Offset of a point in its voxel, in quanta.
  std::array<double, 3> offset(int i) const
  {
    const PointRecord& r = records[i];
    return { double(std::int64_t(xFraction(r, fractionMask))),
      double(std::int64_t(yFraction(r, fractionMask))), double(std::int64_t(zFraction(r, fractionMask))) };
  }
};

/// The voxels of one partition at a time; for one thread at a time.
class alignas(kApart) BinnedVoxels
{
public:
  using Source = PointBinner;

  /// For partitions that @p binner filled for @p request, which must outlive the work.
  void prepare(const VoxelRequest& request, const PointBinner& binner);
  /// Finds the voxels of a partition. @return how many there are.
  std::size_t find(std::uint32_t partition);
  /// Sums their points; they are valid until the next find(). What was found is to be summed or dropped.
  void sum();
  void drop();

  std::size_t size() const { return voxels_.size; }
  std::int64_t count(std::size_t voxel) const
  {
    return isWide_ ? wide_.voxels[voxel].count : packedCount(voxels_.sums[voxel]);
  }
  /// Sums of the points of a voxel, in quanta from its lower corner, rounded.
  std::array<double, 3> sums(std::size_t voxel) const
  {
    if (isWide_)
    {
      return wide_.voxels[voxel].sums();
    }
    const PackedSums& packed = voxels_.sums[voxel];
    return { double(std::int64_t(packed.lanes[0])), double(std::int64_t(packed.lanes[1])),
      double(packedZ(packed)) };
  }
  /// The voxels in wide sums.
  VoxelRun wide() const;
  /// Writes the voxels from @p offset on.
  void write(const Kernels& kernels, VoxelWriter& writer, std::size_t offset) const;
  /// Calls visit(block) for the blocks of points.
  template <typename Visit>
  void visit(const Visit& visit) const;
  std::size_t bytes() const;

private:
  const PartitionPlan& plan() const { return binner_->plan(); }
  CellRanks ranks() const;
  void makeTables();
  void rankOccupied();
  void sumPacked();
  void sumWide();
  /// Calls visit(block, cells) for the blocks of the partition.
  template <typename Visit>
  void forBlocks(const Visit& visit)
  {
    std::uint32_t* cells = recordCells_.data();
    for (PointRecordPool::Walk block(binner_->pool(), partition_); block.next(); cells += block.count())
    {
      visit(block, cells);
    }
  }

  const PointBinner* binner_ = nullptr;
  const Kernels* kernels_ = nullptr;
  bool covariances_ = false;
  std::uint32_t partition_ = 0;
  std::size_t records_ = 0;
  PartitionVoxels voxels_;
  Buffer<std::uint64_t> occupancy_; ///< Zeros between partitions.
  Buffer<std::uint64_t> touched_; ///< Likewise; a bit for each occupancy word in use, of a sparse partition.
  bool isSparse_ = false;
  Buffer<std::uint32_t> rankTable_;
  Buffer<std::uint32_t> recordCells_; ///< They become ranks.
  std::vector<std::uint32_t> cells_;
  std::vector<PackedSums> packed_;
  std::vector<SecondMoments> secondMoments_;
  bool isWide_ = false; ///< There may be too many points in a voxel for packed sums.
  VoxelRun wide_;
};

template <typename Visit>
void BinnedVoxels::visit(const Visit& visit) const
{
  BinnedBlock block;
  block.fractionMask = (std::uint64_t(1) << plan().fractionBits) - 1;
  const std::uint32_t* ranks = recordCells_.data();
  for (PointRecordPool::Walk from(binner_->pool(), partition_); from.next(); ranks += from.count())
  {
    block.records = from.records();
    block.payloads = from.payloads();
    block.count = from.count();
    std::copy(ranks, ranks + from.count(), block.voxels);
    from.copyNumbers(block.points);
    visit(block);
  }
}

} // namespace pointhaptics::simd
