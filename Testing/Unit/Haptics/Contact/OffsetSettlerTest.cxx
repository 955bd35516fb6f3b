#include "Haptics/Contact/OffsetSettler.h"

#include "Unit/Core/RandomClouds.h"

#include <gtest/gtest.h>

using namespace pointhaptics;

TEST(OffsetSettler, PassesWhatFollowsTheHandBitForBit)
{
  trial::Random random(1);
  OffsetSettler settler;
  Vec3 offset;
  for (int i = 0; i < 1000; ++i)
  {
    const double moved = random.uniform(0.0, 1e-3);
    offset += (OffsetSettler::kFreeSteps * moved) * random.direction();
    ASSERT_EQ(settler.settle(offset, moved, 1e-4), offset);
    ASSERT_FALSE(settler.settling());
  }
}

TEST(OffsetSettler, SpreadsAJumpEvenlyAndEndsItExactly)
{
  OffsetSettler settler;
  const Vec3 offset{ 0.0, 0.0, 1e-3 };
  double last = 0.0;
  for (int i = 1; i <= 10; ++i)
  {
    const Vec3 felt = settler.settle(offset, 0.0, 1e-4);
    EXPECT_NEAR(felt.z - last, 1e-4, 1e-9) << i;
    last = felt.z;
  }
  EXPECT_EQ(settler.settle(offset, 0.0, 1e-4), offset);
  EXPECT_FALSE(settler.settling());
}

TEST(OffsetSettler, TurnsWithoutGettingWeaker)
{
  OffsetSettler settler;
  const Vec3 before{ 0.0, 0.0, 1e-3 };
  const Vec3 after = 1.2e-3 * Vec3(std::sin(1.3), 0.0, std::cos(1.3));
  settler.resumeFrom(before);
  Vec3 last = before;
  int ticks = 0;
  for (; last != after; ++ticks)
  {
    const Vec3 felt = settler.settle(after, 0.0, 1e-4);
    ASSERT_GT(norm(felt), norm(last)) << ticks;
    ASSERT_LE(norm(felt - last), 1e-4 + 1e-11) << ticks;
    last = felt;
  }
  EXPECT_EQ(ticks, 16) << "the length of the arc";
}

TEST(OffsetSettler, NeverStepsFurtherThanTheHandAndTheLimitAllow)
{
  constexpr double kShrink = 5e-5;
  trial::Random random(2);
  OffsetSettler settler;
  Vec3 offset;
  Vec3 felt;
  bool settled = false;
  for (int i = 0; i < 20000; ++i)
  {
    const double moved = random.below(3) == 0 ? 0.0 : random.uniform(0.0, 1e-4);
    offset = random.below(100) == 0 ? random.uniform(0.0, 0.01) * random.direction() : offset;
    const Vec3 next = settler.settle(offset, moved, kShrink);
    ASSERT_LE(norm(next - felt), OffsetSettler::kFreeSteps * moved + kShrink + 1e-11) << i;
    felt = next;
    settled = settled || (i > 0 && !settler.settling());
  }
  EXPECT_TRUE(settled) << "jumps end between two others";
}

TEST(OffsetSettler, NeverPullsAHandInThatComesOut)
{
  OffsetSettler settler;
  Vec3 felt = settler.settle({ 0.0, 0.0, 1e-3 }, 0.0, 1e-4);
  for (int i = 1; i < 10; ++i)
  {
    const Vec3 next = settler.settle({ 1e-4 * i, 0.0, 1e-3 - 1e-4 * i }, 2e-4, 1e-5);
    EXPECT_GE(dot(next, Vec3(1e-4 * i, 0.0, 1e-3 - 1e-4 * i)), 0.0) << i;
    EXPECT_LE(norm(next - felt), OffsetSettler::kFreeSteps * 2e-4 + 1e-5 + 1e-11) << i;
    felt = next;
  }
}

TEST(OffsetSettler, AnInfiniteLimitLetsEverythingThrough)
{
  OffsetSettler settler;
  EXPECT_EQ(settler.settle({ 1, 2, 3 }, 0.0, INFINITY), Vec3(1, 2, 3));
  EXPECT_EQ(settler.settle({ -1, 2, 3 }, 0.0, INFINITY), Vec3(-1, 2, 3));
}

TEST(OffsetSettler, ResumesFromWhatWasFelt)
{
  OffsetSettler settler;
  EXPECT_EQ(settler.settle({ 0, 0, 1e-3 }, 1.0, 1e-4), Vec3(0, 0, 1e-3));
  settler.resumeFrom(Vec3());
  EXPECT_NEAR(settler.settle({ 0, 0, 1e-3 }, 0.0, 1e-4).z, 1e-4, 1e-9) << "grows again from nothing";
}
