#include "Haptics/ServoThread.h"

#include <gtest/gtest.h>

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
  const std::int64_t begin = steadyNanoseconds();
  sleepUntil(begin - 1000000000);
  EXPECT_GE(steadyNanoseconds(), begin);
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
