/// @file
/// The voxels of one lattice, as the partitions left them.
#pragma once

#include "Core/Executor.h"
#include "Core/Kernel/VoxelSink.h"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace kernel
{

/// Elements worth a thread of their own to copy.
constexpr std::int64_t kCopyGrain = 1 << 14;

/// So many partitions at once that threads find work to the end.
inline std::int64_t grainFor(std::int64_t count, const Executor& executor)
{
  return std::max<std::int64_t>(1, count / (16 * executor.concurrency()));
}

/// The voxels of one lattice.
struct Level
{
  Lattice lattice;
  MeanArena arena;
  /// Where those of each partition begin, and an end.
  std::vector<std::size_t> firsts;
  std::int64_t size = 0;
  std::vector<std::int64_t> parents;
};

/// Tells partitions where their voxels go, as soon as all before them have told how many theirs are.
class PartitionOrder
{
public:
  explicit PartitionOrder(std::uint32_t partitions)
    : sizes_(partitions, kUnknown)
    , firsts_(1, 0)
  {
    firsts_.reserve(std::size_t(partitions) + 1);
  }
  static constexpr std::size_t kUnknown = ~std::size_t(0);

  void tell(std::uint32_t partition, std::size_t size)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    sizes_[partition] = size;
    while (firsts_.size() <= sizes_.size() && sizes_[firsts_.size() - 1] != kUnknown)
    {
      firsts_.push_back(firsts_.back() + sizes_[firsts_.size() - 1]);
    }
  }
  /// Or kUnknown.
  std::size_t first(std::uint32_t partition)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return partition < firsts_.size() ? firsts_[partition] : kUnknown;
  }
  /// @pre all have told.
  std::vector<std::size_t> take() { return std::move(firsts_); }

private:
  std::mutex mutex_;
  std::vector<std::size_t> sizes_;
  std::vector<std::size_t> firsts_; ///< Of those that are known, and what comes next.
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

} // namespace kernel
} // namespace pointhaptics
