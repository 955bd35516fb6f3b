#include "Core/Simd/InstructionSet.h"

namespace pointhaptics
{
namespace
{

bool machineHasAvx2() noexcept
{
#if defined(__x86_64__) || defined(__i386__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
    __builtin_cpu_supports("bmi2");
#else
  return false;
#endif
}

bool machineHasAvx512() noexcept
{
#if defined(__x86_64__) || defined(__i386__)
  return machineHasAvx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
    __builtin_cpu_supports("avx512vpopcntdq") && __builtin_cpu_supports("avx512ifma");
#else
  return false;
#endif
}

}

InstructionSet usableInstructionSet(InstructionSet wanted) noexcept
{
  const bool atMostAvx2 = wanted == InstructionSet::Avx2;
  if (wanted == InstructionSet::Baseline)
  {
    return InstructionSet::Baseline;
  }
  // For such machines every build has the loops of both sets.
  if (!atMostAvx2 && machineHasAvx512())
  {
    return InstructionSet::Avx512;
  }
  return machineHasAvx2() ? InstructionSet::Avx2 : InstructionSet::Baseline;
}

} // namespace pointhaptics
