/// @file
/// For tests that compare instruction sets: only those that are really run, not one that another stands in
/// for.
#pragma once

#include "Core/Simd/InstructionSet.h"

#include <gtest/gtest.h>

#include <vector>

namespace pointhaptics
{

/// Instruction sets of this machine and this build; the baseline first, which all have.
inline std::vector<InstructionSet> heldInstructionSets()
{
  std::vector<InstructionSet> held;
  for (const InstructionSet set : { InstructionSet::Baseline, InstructionSet::Avx2 })
  {
    if (usableInstructionSet(set) == set)
    {
      held.push_back(set);
    }
  }
  return held;
}

}

/// Leaves a test that compares the others with the baseline.
#define SKIP_WITHOUT_OTHER_INSTRUCTION_SETS()                                                                \
  if (::pointhaptics::heldInstructionSets().size() == 1)                                                     \
  GTEST_SKIP() << "this machine, or this build, has the baseline's instructions only: nothing to compare"
