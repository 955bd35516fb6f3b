/// @file
/// From the records of a partition to the sums of its voxels, in ascending order.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/Stages/PointBinner.h"
#include "Core/Resample/Stages/VoxelWriter.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics::simd
{

/// Some points of a partition, and their voxels, counted from the first of the partition.
struct PointBlock
{
  const std::uint32_t* payloads = nullptr; ///< Payloads of the records.
  const std::uint32_t* voxels = nullptr;
  int count = 0;
  std::int64_t points[kBlockRecords]; ///< Their numbers, if these are kept.
  /// Offsets of points in their voxels, in quanta, where they are asked for.
  std::array<std::uint64_t, 3> offsets[kBlockRecords + kWidest];
};

/// The voxels of one partition at a time; for one thread at a time.
class alignas(kApart) BinnedVoxels
{
public:
  /// For partitions that @p binner filled for @p request with the points of @p chunks; all must outlive the
  /// work.
  void prepare(const VoxelRequest& request, const Chunks& chunks, const PointBinner& binner);
  /// Finds the voxels of a partition. @return how many there are.
  std::size_t find(std::uint32_t partition);
  /// Sums their points; they are valid until the next find().
  void sum();

  std::size_t size() const { return voxels_.size; }
  std::int64_t count(std::size_t voxel) const
  {
    return isWide_ ? wide_.voxels[voxel].count : packedCount(voxels_.sums[voxel]);
  }
  /// Sums of the points of a voxel, in quanta from its lower corner, rounded.
  std::array<double, 3> sums(std::size_t voxel) const
  {
    return isWide_ ? wide_.voxels[voxel].sums() : WideSums::of(0, voxels_.sums[voxel]).sums();
  }
  /// The voxels in wide sums.
  VoxelRun wide() const;
  /// Writes the voxels from @p offset on.
  void write(const Kernels& kernels, VoxelWriter& writer, std::size_t offset) const;
  /// Calls visit(block) for the blocks of points.
  template <typename Visit>
  void visit(bool withOffsets, const Visit& visit) const
  {
    PointBlock block;
    block.voxels = ranks_.data();
    const bool maps = chunks_->originals() && binner_->payloadLayout().numbered;
    for (PointBinner::Walk from(*binner_, partition_); from.next(); block.voxels += block.count)
    {
      block.payloads = from.payloads();
      block.count = from.count();
      from.copyNumbers(block.points);
      withOffsets ? copyOffsets(from, block) : void();
      for (int i = 0; maps && i < block.count; ++i)
      {
        block.points[i] = chunks_->originals()[block.points[i]];
      }
      visit(block);
    }
  }

private:
  /// A record's voxel and its number among the records.
  struct Key
  {
    std::uint64_t voxel;
    std::uint32_t record;
  };
  const PartitionPlan& plan() const { return binner_->plan(); }
  void findCells();
  void sortKeys();
  void sumPacked();
  void sumWide();
  void copyOffsets(const PointBinner::Walk& from, PointBlock& block) const;

  const VoxelRequest* request_ = nullptr;
  const Chunks* chunks_ = nullptr;
  const PointBinner* binner_ = nullptr;
  const Kernels* kernels_ = nullptr;
  std::uint32_t partition_ = 0;
  std::size_t records_ = 0;
  PartitionVoxels voxels_;
  Buffer<std::uint64_t> occupancy_;
  Buffer<std::uint32_t> rankTable_;
  Buffer<std::uint32_t> ranks_; ///< ranks of the records' voxels; their cells before
  Buffer<std::uint32_t> cells_; ///< Those of the voxels.
  Buffer<Key> keys_;            ///< Where records are sorted; the first ones become those of the voxels.
  Buffer<Key> otherKeys_;
  std::vector<PackedSums> packed_;
  std::vector<SecondMoments> secondMoments_;
  bool isWide_ = false; ///< Packed sums are too small for these points.
  VoxelRun wide_;
};

} // namespace pointhaptics::simd
