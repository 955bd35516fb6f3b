/// @file
/// The voxels of one lattice, as the partitions left them.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Resample/Stages/VoxelSink.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// Elements worth a thread of their own to copy.
constexpr std::int64_t kCopyGrain = 1 << 14;

/// The voxels of one lattice.
struct Level
{
  Lattice lattice;
  MeanArena arena;
  /// Where those of each partition begin, and an end.
  std::vector<std::size_t> firsts;
  std::int64_t size = 0;
  std::vector<std::int64_t> parents;

  /// Of the voxel that has most of them.
  std::int64_t mostPoints() const
  {
    return size == 0 ? 0 : *std::max_element(arena.counts(), arena.counts() + size);
  }
};

/// The offset of each partition's first voxel in the output. It is known as soon as all partitions before it
/// have published how many voxels they have. Threads may publish and read at the same time; none waits.
class PartitionOrder
{
public:
  explicit PartitionOrder(std::uint32_t partitions)
    : sizes_(partitions)
    , firsts_(std::size_t(partitions) + 1)
  {
    for (std::atomic<std::size_t>& size : sizes_)
    {
      size.store(kUnknown, std::memory_order_relaxed);
    }
    for (std::atomic<std::size_t>& first : firsts_)
    {
      first.store(kUnknown, std::memory_order_relaxed);
    }
    firsts_[0] = 0;
  }
  static constexpr std::size_t kUnknown = ~std::size_t(0);

  void publish(std::uint32_t partition, std::size_t size)
  {
    // Of two threads that store a partition's size and its offset, the later one sees both and continues.
    sizes_[partition] = size;
    for (std::size_t p = partition; p < sizes_.size() && firsts_[p + 1] == kUnknown; ++p)
    {
      const std::size_t first = firsts_[p];
      const std::size_t known = sizes_[p];
      if (first == kUnknown || known == kUnknown)
      {
        return;
      }
      firsts_[p + 1] = first + known;
    }
  }
  /// Or kUnknown.
  std::size_t first(std::uint32_t partition) const { return firsts_[partition]; }
  /// The offsets of all partitions, and the total. @pre all sizes are published.
  std::vector<std::size_t> take() const { return { firsts_.begin(), firsts_.end() }; }

private:
  std::vector<std::atomic<std::size_t>> sizes_;
  std::vector<std::atomic<std::size_t>> firsts_; ///< Of those that are known, and what comes next.
};

/// Copies an array unless it is there already.
template <typename T>
void copyArray(const T* from, std::int64_t count, T* to, const Executor& executor)
{
  if (from != to)
  {
    forRange(executor, count, kCopyGrain,
      [&](std::int64_t begin, std::int64_t end) { std::copy(from + begin, from + end, to + begin); });
  }
}

} // namespace simd
} // namespace pointhaptics
