/// @file
/// The newest value of a small struct, from one writing thread to any number of reading ones; nobody waits
/// for a lock.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace pointhaptics
{

/// A sequence lock whose payload is atomic words, so that a read that meets a write is a retry and never a
/// data race. Values in between may be skipped by a reader. T is trivially copyable; a copy of a few hundred
/// bytes costs some tens of nanoseconds.
template <typename T>
class LatestValue
{
  static_assert(std::is_trivially_copyable<T>::value, "the value is copied word by word");

public:
  /// Holds a default T at version 0.
  LatestValue() noexcept { store(T()); }

  /// The one writing thread. Wait-free.
  void write(const T& value) noexcept
  {
    const std::uint64_t version = version_.load(std::memory_order_relaxed);
    version_.store(version + 1, std::memory_order_relaxed);
    store(value);
    version_.store(version + 2, std::memory_order_release);
  }

  /// Any thread. Wait-free: false where a write was met half way; @p value is then unchanged. @p version, if
  /// given, becomes the version of the value, which grows with each write.
  bool tryRead(T& value, std::uint64_t* version = nullptr) const noexcept
  {
    const std::uint64_t before = version_.load(std::memory_order_acquire);
    if (before & 1)
    {
      return false;
    }
    std::array<std::uint64_t, kWords> copy;
    for (std::size_t i = 0; i < kWords; ++i)
    {
      // Acquire: whoever sees a word of a newer write sees that write's odd version below.
      copy[i] = words_[i].load(std::memory_order_acquire);
    }
    if (version_.load(std::memory_order_relaxed) != before)
    {
      return false;
    }
    std::memcpy(static_cast<void*>(&value), copy.data(), sizeof(T));
    if (version)
    {
      *version = before;
    }
    return true;
  }

  /// Any thread but a real-time one: tries again until a read meets no write.
  T read() const noexcept
  {
    T value;
    while (!tryRead(value))
    {
    }
    return value;
  }

  /// Any thread. Differs from the version of an earlier read where a newer value is there or on its way.
  std::uint64_t version() const noexcept { return version_.load(std::memory_order_relaxed); }

private:
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;

  void store(const T& value) noexcept
  {
    std::array<std::uint64_t, kWords> copy{};
    std::memcpy(copy.data(), &value, sizeof(T));
    for (std::size_t i = 0; i < kWords; ++i)
    {
      // Release: puts the odd version before every word of the new value.
      words_[i].store(copy[i], std::memory_order_release);
    }
  }

  std::atomic<std::uint64_t> version_{ 0 };
  std::array<std::atomic<std::uint64_t>, kWords> words_;
};

} // namespace pointhaptics
