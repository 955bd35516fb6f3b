#include "Core/Simd/InstructionSet.h"

#include "Core/Resample/Kernel/VoxelKernel.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace
{

using namespace pointhaptics;

constexpr InstructionSet kAll[] = { InstructionSet::Baseline, InstructionSet::Avx2 };

std::string nameOf(InstructionSet set)
{
  return set == InstructionSet::Baseline ? "Baseline" : "Avx2";
}

TEST(InstructionSets, AreNeverAboveTheWantedOneAndAutomaticIsTheBestHeld)
{
  for (const InstructionSet wanted : kAll)
  {
    const InstructionSet usable = usableInstructionSet(wanted);
    EXPECT_LE(usable, wanted);
    EXPECT_EQ(usableInstructionSet(usable), usable) << "what stands in is held";
  }
  const std::vector<InstructionSet> held = heldInstructionSets();
  ASSERT_FALSE(held.empty());
  EXPECT_EQ(held.front(), InstructionSet::Baseline);
  EXPECT_EQ(usableInstructionSet(), held.back());
  EXPECT_EQ(usableInstructionSet(InstructionSet::Avx2), held.back());
}

/// Skipped here means: what the tests say of all instruction sets was not tried with this one.
class InstructionSetHeld : public ::testing::TestWithParam<InstructionSet>
{
};

TEST_P(InstructionSetHeld, HasLoopsOfItsOwn)
{
  const InstructionSet set = GetParam();
  if (usableInstructionSet(set) != set)
  {
    GTEST_SKIP() << "this machine, or this build, has no " << nameOf(set) << ": it has "
                 << nameOf(usableInstructionSet(set)) << " instead, and the tests leave it out";
  }
  EXPECT_EQ(
    &simd::kernelsFor(set) == &simd::kernelsFor(InstructionSet::Baseline), set == InstructionSet::Baseline);
  const std::vector<InstructionSet> held = heldInstructionSets();
  EXPECT_EQ(std::count(held.begin(), held.end(), set), 1);
}

INSTANTIATE_TEST_SUITE_P(Sets, InstructionSetHeld, ::testing::ValuesIn(kAll),
  [](const ::testing::TestParamInfo<InstructionSet>& test) { return nameOf(test.param); });

} // namespace
