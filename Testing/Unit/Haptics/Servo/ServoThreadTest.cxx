#include "Unit/Eventually.h"

#include "Haptics/Servo/ServoThread.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <limits>
#include <thread>

using namespace pointhaptics;

TEST(ServoThread, SleepsUntilTheDeadlineAndNotBefore)
{
  const std::int64_t deadline = steadyNanoseconds() + 2000000;
  sleepUntil(deadline);
  EXPECT_GE(steadyNanoseconds(), deadline);
}

TEST(ServoThread, ReturnsAtOnceFromADeadlineThatHasPassed)
{
  constexpr std::int64_t kLong = 20000000000; // far above what a busy machine takes
  const std::int64_t begin = steadyNanoseconds();
  sleepUntil(begin - kLong);
  EXPECT_LT(steadyNanoseconds(), begin + kLong / 2);
}

#ifdef __SSE2__
TEST(ServoThread, FlushesDenormalsInItsOwnThreadOnly)
{
  const auto halfOfTheSmallest = []
  {
    volatile double number = std::numeric_limits<double>::min();
    number = number * 0.5;
    return number != 0.0;
  };
  bool keptThere = true;
  std::thread thread(
    [&]
    {
      flushDenormalsToZero();
      keptThere = halfOfTheSmallest();
    });
  thread.join();
  EXPECT_FALSE(keptThere);
  EXPECT_TRUE(halfOfTheSmallest());
}
#endif

TEST(ServoThread, SpinsUntilADeadlineAndNotAtAllForOneThatHasPassed)
{
  const std::int64_t begin = steadyNanoseconds();
  spinUntil(begin + 50000);
  EXPECT_GE(steadyNanoseconds(), begin + 50000);
  spinUntil(begin);
  spinUntil(std::numeric_limits<std::int64_t>::min());
}

#ifdef __linux__
namespace
{
/// Microseconds a core may take to wake; -1: the kernel does not say.
std::int32_t allowedWakeTime()
{
  std::ifstream file("/dev/cpu_dma_latency", std::ios::binary);
  std::int32_t result = -1;
  file.read(reinterpret_cast<char*>(&result), sizeof(result));
  return result;
}
}

TEST(ServoThread, KeepsTheCoresAwakeUntilItLetsGo)
{
  const std::int32_t before = allowedWakeTime();
  WakefulCores cores;
  if (before <= 0 || cores.request() != 0)
  {
    GTEST_SKIP() << "no permission to write /dev/cpu_dma_latency, or another program holds it";
  }
  EXPECT_EQ(allowedWakeTime(), 0);
  EXPECT_EQ(cores.request(), 0) << "a second time is no error";
  cores.release();
  // Other programs, tests among them, may hold the same for a while.
  const auto isAsBefore = [&] { return allowedWakeTime() == before; };
  EXPECT_TRUE(trial::eventually(isAsBefore));
  {
    WakefulCores others;
    ASSERT_EQ(others.request(), 0);
  }
  EXPECT_TRUE(trial::eventually(isAsBefore));
}
#endif
