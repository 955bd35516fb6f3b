#include "Core/Simd/InstructionSet.h"

namespace pointhaptics
{

InstructionSet usableInstructionSet(InstructionSet wanted) noexcept
{
#if defined(__x86_64__) || defined(__i386__)
  // For such machines every build has the loops of both sets.
  const bool hasAvx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
#else
  const bool hasAvx2 = false;
#endif
  return hasAvx2 && wanted != InstructionSet::Baseline ? InstructionSet::Avx2 : InstructionSet::Baseline;
}

} // namespace pointhaptics
