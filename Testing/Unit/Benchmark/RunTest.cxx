#include "Benchmark/Harness/Run.h"
#include "Benchmark/Harness/Machine.h"

#include <gtest/gtest.h>

#include <vector>

using namespace pointhaptics::bench;

TEST(Run, KeepsRowsByStudyAndPrintsEachAsItComes)
{
  pointhaptics::bench::Run run;
  std::vector<Json> printed;
  run.print = [&printed](const Json& line) { printed.push_back(line); };
  run.add("b", { { "x", 1 } });
  run.add("a", { { "x", 2 } });
  run.remark("b", "left out");
  run.add("b", { { "x", 3 } });
  EXPECT_EQ(run.parts().dump(),
    R"({"b":{"rows":[{"x":1},{"x":3}],"remarks":["left out"]},"a":{"rows":[{"x":2}],"remarks":[]}})");
  ASSERT_EQ(printed.size(), 4u);
  EXPECT_EQ(printed[1].dump(), R"({"study":"a","x":2})");
  EXPECT_EQ(printed[2].dump(), R"({"study":"b","remark":"left out"})");
  EXPECT_TRUE(run.faults().empty());
  run.fault("wrong");
  EXPECT_EQ(run.faults(), "wrong");
}

TEST(Run, WantsWhatWasAskedForAndChoosesWhatWasGiven)
{
  pointhaptics::bench::Run run;
  EXPECT_TRUE(run.wants("any"));
  run.studies = { "a" };
  EXPECT_TRUE(run.wants("a"));
  EXPECT_FALSE(run.wants("any"));
  EXPECT_EQ(run.chosen(0, 2, 1), 2);
  run.quick = true;
  EXPECT_EQ(run.chosen(0, 2, 1), 1);
  EXPECT_EQ(run.chosen(7, 2, 1), 7);
}

TEST(Machine, CountsTheMemoryThatWorkTouches)
{
  constexpr std::int64_t kBytes = 32 << 20;
  std::vector<char> kept;
  const std::int64_t peak = peakBytesOf([&] { kept.assign(kBytes, 1); });
  if (peak < 0)
  {
    GTEST_SKIP() << "the kernel has no counters";
  }
  EXPECT_GE(peak, kBytes - (1 << 20));
  EXPECT_LE(peak, kBytes + (8 << 20));
}
