/// @file
/// Where the voxels of each partition go in the result.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>

namespace pointhaptics
{
namespace simd
{

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
  /// Voxels of all partitions.
  std::size_t size() const { return size_; }
  /// Lets all threads go on after one of them failed; offsets are then of no use.
  void giveUp() { givenUp_ = true; }

private:
  std::size_t size_ = 0;
  std::atomic<std::size_t> known_{ 0 }; ///< Partitions whose end is known.
  std::atomic<bool> givenUp_{ false };
};

} // namespace simd
} // namespace pointhaptics
