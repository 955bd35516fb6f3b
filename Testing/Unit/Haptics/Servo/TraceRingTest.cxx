#include "Haptics/Servo/TraceRing.h"

#include <gtest/gtest.h>

#include <thread>

using namespace pointhaptics;

TEST(TraceRing, LosesAndCountsEverythingBeforeItIsSized)
{
  TraceRing<int> ring;
  EXPECT_FALSE(ring.push(1));
  EXPECT_EQ(ring.lost(), 1u);
  std::vector<int> values;
  ring.take(values);
  EXPECT_TRUE(values.empty());
}

TEST(TraceRing, GivesEntriesInOrderAndAppends)
{
  TraceRing<int> ring;
  ring.resize(3);
  std::vector<int> values = { -1 };
  for (int round = 0; round < 5; ++round)
  {
    EXPECT_TRUE(ring.push(2 * round));
    EXPECT_TRUE(ring.push(2 * round + 1));
    ring.take(values);
  }
  EXPECT_EQ(values, (std::vector<int>{ -1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 }));
  EXPECT_EQ(ring.lost(), 0u);
}

TEST(TraceRing, KeepsTheOldestAndCountsTheLostWhenFull)
{
  TraceRing<int> ring;
  ring.resize(3);
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_EQ(ring.push(i), i < 3);
  }
  std::vector<int> values;
  ring.take(values);
  EXPECT_EQ(values, (std::vector<int>{ 0, 1, 2 }));
  EXPECT_EQ(ring.lost(), 2u);
  EXPECT_TRUE(ring.push(5));
}

TEST(TraceRing, StartsAnewWhenResized)
{
  TraceRing<int> ring;
  ring.resize(1);
  ring.push(1);
  ring.push(2);
  ring.resize(2);
  EXPECT_EQ(ring.lost(), 0u);
  std::vector<int> values;
  ring.take(values);
  EXPECT_TRUE(values.empty());
}

TEST(TraceRing, LosesNothingUncountedBetweenTwoThreads)
{
  constexpr std::uint64_t kPushes = 200000;
  TraceRing<std::uint64_t> ring;
  ring.resize(64);
  std::thread writer(
    [&]
    {
      for (std::uint64_t i = 1; i <= kPushes; ++i)
      {
        ring.push(i);
      }
    });
  std::vector<std::uint64_t> values;
  while (values.size() + ring.lost() < kPushes)
  {
    ring.take(values);
  }
  writer.join();
  ring.take(values);
  EXPECT_EQ(values.size() + ring.lost(), kPushes);
  for (std::size_t i = 1; i < values.size(); ++i)
  {
    ASSERT_GT(values[i], values[i - 1]);
  }
}
