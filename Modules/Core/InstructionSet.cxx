#include "Core/InstructionSet.h"

#include "Core/Kernel/VoxelKernel.h"

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
  // The machine first: the functions that hand out kernels are built of the same instructions as they.
  if (!atMostAvx2 && machineHasAvx512() && kernel::avx512Kernels())
  {
    return InstructionSet::Avx512;
  }
  return machineHasAvx2() && kernel::avx2Kernels() ? InstructionSet::Avx2 : InstructionSet::Baseline;
}

namespace kernel
{

const Kernels& kernelsFor(InstructionSet wanted)
{
  switch (usableInstructionSet(wanted))
  {
    case InstructionSet::Avx512:
      return *avx512Kernels();
    case InstructionSet::Avx2:
      return *avx2Kernels();
    default:
      return baselineKernels();
  }
}

} // namespace kernel
} // namespace pointhaptics
