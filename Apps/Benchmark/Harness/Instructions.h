/// @file
/// The instruction sets that a run can be held to, with their names.
#pragma once

#include "Core/Simd/InstructionSet.h"

namespace pointhaptics::bench
{

struct NamedInstructionSet
{
  InstructionSet set;
  const char* word; ///< On the command line.
  const char* name; ///< In tables.
};

/// The fastest first.
constexpr NamedInstructionSet kInstructionSets[] = { { InstructionSet::Avx2, "avx2", "AVX2" },
  { InstructionSet::Baseline, "baseline", "baseline" } };

/// Whether this machine has all of @p wanted; true for the best that it has.
inline bool hasInstructions(InstructionSet wanted) noexcept
{
  return wanted == InstructionSet::Automatic || usableInstructionSet(wanted) == wanted;
}

/// As in tables, of what is used where @p wanted is asked for.
inline const char* usedInstructions(InstructionSet wanted) noexcept
{
  const InstructionSet used = usableInstructionSet(wanted);
  const char* name = "";
  for (const NamedInstructionSet& one : kInstructionSets)
  {
    name = one.set == used ? one.name : name;
  }
  return name;
}

} // namespace pointhaptics::bench
