/// @file
/// Writes the voxels of partitions into a level, in order.
#pragma once

#include "Core/Resample/Stages/PartitionSums.h"
#include "Core/Resample/Stages/VoxelLevel.h"
#include "Core/Resample/Stages/VoxelSink.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// Threads bring partitions in about their order. A partition is written in place if those before it have
/// been counted by then, as they nearly always are; otherwise it is moved there in the end.
class VoxelWriter
{
public:
  /// Prepares @p level, whose lattice is set, for at most @p room voxels.
  VoxelWriter(Level& level, std::uint32_t partitions, std::size_t room, const MeanArena::Layout& layout,
    int fractionBits, OutputAllocator* allocator);

  /// Says how many voxels a partition has: before it is written, as early as possible.
  void publish(std::uint32_t partition, std::size_t size) { order_.publish(partition, size); }
  /// Writes the voxels of the partition that @p worker has loaded.
  void write(const Kernels& kernels, std::uint32_t partition, std::size_t size, PartitionWorker& worker);
  /// Once all partitions are written.
  void finish();

private:
  struct Late
  {
    std::uint32_t partition;
    std::size_t size;
    MeanArena arena;
  };

  Level& level_;
  MeanArena::Layout layout_;
  int fractionBits_;
  PartitionOrder order_;
  std::mutex mutex_; ///< Of late_.
  std::vector<Late> late_;
};

} // namespace simd
} // namespace pointhaptics
