#include "FrameBudget.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

using pointhaptics::FrameBudget;

namespace
{

/// Seconds of a frame, by its points.
using Machine = std::function<double(std::int64_t points)>;

/// Draws @p frames frames, each with as many points as fit, and returns how many fit in the end.
std::int64_t settle(FrameBudget& budget, const Machine& machine, int frames)
{
  for (int i = 0; i < frames; ++i)
  {
    budget.add(budget.points(), machine(budget.points()));
  }
  return budget.points();
}

TEST(FrameBudget, FillsTheFrameOfASlowMachineAndOfAFastOne)
{
  for (const double perPoint : { 2.5e-7, 1e-9 })
  {
    FrameBudget budget(1.0 / 30.0);
    const Machine machine = [perPoint](std::int64_t points) { return 0.012 + perPoint * double(points); };
    const std::int64_t points = settle(budget, machine, 60);
    EXPECT_LE(machine(points), 1.0 / 30.0) << perPoint;
    EXPECT_GE(machine(points), 0.8 / 30.0) << perPoint;
  }
}

TEST(FrameBudget, FollowsAMachineThatGetsBusy)
{
  FrameBudget budget(1.0 / 30.0);
  double load = 1.0;
  const Machine machine = [&load](std::int64_t points) { return load * (0.008 + 2e-7 * double(points)); };
  const std::int64_t before = settle(budget, machine, 40);
  load = 2.0;
  const std::int64_t during = settle(budget, machine, 40);
  EXPECT_LT(during, before / 2);
  EXPECT_LE(machine(during), 1.0 / 30.0);
  load = 1.0;
  EXPECT_NEAR(double(settle(budget, machine, 60)), double(before), 0.1 * double(before));
}

TEST(FrameBudget, NeverGoesBelowTheFewestPoints)
{
  FrameBudget budget(1.0 / 30.0);
  EXPECT_EQ(settle(
              budget, [](std::int64_t) { return 0.2; }, 50),
    FrameBudget::kFewestPoints);
}

TEST(FrameBudget, OneSlowFrameDoesNotThrowItFar)
{
  FrameBudget budget(1.0 / 30.0);
  const Machine machine = [](std::int64_t points) { return 0.010 + 2e-7 * double(points); };
  const std::int64_t before = settle(budget, machine, 40);
  budget.add(before, 1.0);
  EXPECT_GE(budget.points(), before / 4);
  EXPECT_NEAR(double(settle(budget, machine, 60)), double(before), 0.1 * double(before));
}

TEST(FrameBudget, LeavesOutWhatIsNoMeasurement)
{
  FrameBudget budget;
  for (const double seconds :
    { 0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    budget.add(1000, seconds);
  }
  budget.add(0, 0.01);
  EXPECT_EQ(budget.points(), FrameBudget::kFirstPoints);
}

} // namespace
