/// @file
/// Memory in use, for tests of what an object keeps.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>

#include <malloc.h>

/// Skips a test where a sanitizer has an allocator of its own; Clang does not say so in all versions.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(__clang__)
#define SKIP_WITHOUT_HEAP() GTEST_SKIP() << "the sanitizer allocates"
#else
#define SKIP_WITHOUT_HEAP() static_cast<void>(0)
#endif

namespace pointhaptics
{

/// Bytes that the process holds by malloc() and the like.
inline std::size_t heapBytes()
{
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

} // namespace pointhaptics
