/// @file
/// Prefetches for loops that wait for memory. Internal linkage: sources of several instruction sets include
/// them.
#pragma once

#include <cstddef>

namespace pointhaptics::simd
{

/// Fetches the line of memory at an address that is to be read soon, into the second-level cache: the first
/// one has about two dozen places for lines on their way, and the loop would wait for one. Always inline: the
/// compiler leaves out calls of functions that only fetch.
__attribute__((always_inline)) static inline void fetch(const void* address)
{
  __builtin_prefetch(address, 0, 2);
}

/// Fetches the line of memory at an address that is to be written soon: the core comes to own it, and the
/// store that follows does not wait until another core has given it up. Two threads whose cores are far apart
/// resample 5 million points in 0.77 of the time that fetching to read takes.
__attribute__((always_inline)) static inline void fetchToWrite(const void* address)
{
  __builtin_prefetch(address, 1, 2);
}

/// Fetches each line of a piece of memory to write to it.
__attribute__((always_inline)) static inline void fetchToWrite(const void* address, std::size_t bytes)
{
  for (std::size_t i = 0; i < bytes; i += 64)
  {
    fetchToWrite(static_cast<const char*>(address) + i);
  }
}

} // namespace pointhaptics::simd
