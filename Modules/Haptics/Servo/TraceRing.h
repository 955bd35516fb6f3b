/// @file
/// A queue of fixed capacity from one thread to another; a full queue loses the newest entry and counts it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// push() is for one thread, take() for one other; neither waits. Memory is allocated and touched by resize()
/// only.
template <typename T>
class TraceRing
{
public:
  /// Empties the ring and sets its capacity, at least 1. Not beside push() or take().
  void resize(std::size_t capacity)
  {
    entries_.assign(capacity > 0 ? capacity : 1, T());
    written_.store(0, std::memory_order_relaxed);
    taken_.store(0, std::memory_order_relaxed);
    lost_.store(0, std::memory_order_relaxed);
  }

  /// Writing thread; wait-free, no allocation. False: the ring is full (or was never sized); @p value is lost
  /// and counted.
  bool push(const T& value) noexcept
  {
    const std::uint64_t written = written_.load(std::memory_order_relaxed);
    if (written - taken_.load(std::memory_order_acquire) >= entries_.size())
    {
      lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return false;
    }
    entries_[std::size_t(written % entries_.size())] = value;
    written_.store(written + 1, std::memory_order_release);
    return true;
  }

  /// Reading thread. Moves all entries to the end of @p values, oldest first.
  void take(std::vector<T>& values)
  {
    const std::uint64_t written = written_.load(std::memory_order_acquire);
    std::uint64_t taken = taken_.load(std::memory_order_relaxed);
    for (; taken < written; ++taken)
    {
      values.push_back(entries_[std::size_t(taken % entries_.size())]);
    }
    taken_.store(taken, std::memory_order_release);
  }

  /// Any thread.
  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

private:
  std::vector<T> entries_;
  std::atomic<std::uint64_t> written_{ 0 };
  std::atomic<std::uint64_t> taken_{ 0 };
  std::atomic<std::uint64_t> lost_{ 0 };
};

} // namespace pointhaptics
