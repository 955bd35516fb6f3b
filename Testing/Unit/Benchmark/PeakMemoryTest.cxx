#include "Benchmark/Harness/PeakMemory.h"

#include <gtest/gtest.h>

#include <memory>
#include <new>

using namespace pointhaptics::bench;

// The address sanitizer keeps what is freed; the thread sanitizer has a thread of its own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif

TEST(PeakMemory, SeesWhatTheWorkTouchesAndGivesBack)
{
  constexpr std::int64_t kBytes = 64 << 20;
  PeakMemory memory;
  std::string message;
  const auto work = []
  {
    const auto bytes = std::make_unique<volatile char[]>(kBytes);
    for (std::int64_t i = 0; i < kBytes; i += 512)
    {
      bytes[std::size_t(i)] = 1;
    }
    return std::int64_t(42);
  };
  if (kIsSanitized)
  {
    GTEST_SKIP() << "a sanitizer's memory is in the count";
  }
  ASSERT_TRUE(measurePeakMemory(work, memory, message)) << message;
  EXPECT_EQ(memory.result, 42);
  EXPECT_GT(memory.peakBytes, kBytes - (kBytes >> 4)); // the kernel counts in lots of pages
  EXPECT_LT(memory.peakBytes, kBytes + (kBytes >> 1));
  EXPECT_LT(memory.keptBytes, kBytes >> 1);
  EXPECT_GT(memory.seconds, 0.0);
}

TEST(PeakMemory, WorkThatThrowsIsAFailureNotAResult)
{
  PeakMemory memory;
  std::string message;
  const auto work = []() -> std::int64_t { throw std::bad_alloc(); };
  EXPECT_FALSE(measurePeakMemory(work, memory, message));
  EXPECT_FALSE(message.empty());
}
