/// @file
/// The voxels of one lattice, as the partitions left them.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Resample/Stages/VoxelWriter.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>

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
  VoxelWriter writer;
  std::int64_t size = 0;

  /// Of the voxel that has most of them.
  std::int64_t mostPoints() const
  {
    return size == 0 ? 0 : *std::max_element(writer.counts(), writer.counts() + size);
  }
};

/// Gives partitions the offsets of their voxels among all. Threads take partitions in ascending order and
/// find one's voxels before they do anything else with it: a thread that has found them waits, if at all, for
/// one that is finding.
class PartitionOrder
{
public:
  /// The offset of a partition of @p size voxels. @pre those before it are done or at work.
  std::size_t append(std::size_t partition, std::size_t size)
  {
    while (known_.load(std::memory_order_acquire) != partition && !givenUp_)
    {
      std::this_thread::yield();
    }
    if (givenUp_)
    {
      return 0;
    }
    const std::size_t offset = size_;
    size_ += size;
    known_.store(partition + 1, std::memory_order_release);
    return offset;
  }
  /// Of all partitions.
  std::size_t size() const { return size_; }
  /// What is appended is of no use, as a thread could not find voxels: nobody waits any longer.
  void giveUp() { givenUp_ = true; }

private:
  std::size_t size_ = 0;
  std::atomic<std::size_t> known_{ 0 }; ///< Partitions whose end is known.
  std::atomic<bool> givenUp_{ false };
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
