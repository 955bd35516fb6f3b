/// @file
/// The voxels of one lattice, as the partitions left them.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Resample/Stages/VoxelSink.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
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

  /// Of the voxel that has most of them.
  std::int64_t mostPoints() const
  {
    return size == 0 ? 0 : *std::max_element(arena.counts(), arena.counts() + size);
  }
};

/// Gives partitions the offsets of their voxels in the output. Threads take partitions in ascending order and
/// count one's voxels before they do anything else with it: a thread that has counted waits, if at all, for
/// one that is counting.
class PartitionOrder
{
public:
  /// @p firsts: becomes the offset of each partition, and an end.
  PartitionOrder(std::vector<std::size_t>& firsts, std::size_t partitions)
    : firsts_(firsts)
  {
    firsts_.assign(partitions + 1, 0);
  }
  /// The offset of a partition of @p size voxels. @pre those before it are or were being counted.
  std::size_t append(std::size_t partition, std::size_t size)
  {
    while (known_.load(std::memory_order_acquire) != partition && !givenUp_)
    {
      std::this_thread::yield();
    }
    firsts_[partition + 1] = firsts_[partition] + size;
    known_.store(partition + 1, std::memory_order_release);
    return firsts_[partition];
  }
  /// What is appended is of no use, as a thread could not count: nobody waits any longer.
  void giveUp() { givenUp_ = true; }

private:
  std::vector<std::size_t>& firsts_;
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
