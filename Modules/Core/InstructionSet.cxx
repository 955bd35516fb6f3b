#include "Core/InstructionSet.h"

#include "Core/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace
{

bool machineHasAvx2() noexcept
{
#if defined(__x86_64__) || defined(__i386__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

bool machineHasAvx512() noexcept
{
#if defined(__x86_64__) || defined(__i386__)
  return machineHasAvx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
    __builtin_cpu_supports("avx512vpopcntdq");
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
  if (!atMostAvx2 && kernel::avx512Kernels() && machineHasAvx512())
  {
    return InstructionSet::Avx512;
  }
  return kernel::avx2Kernels() && machineHasAvx2() ? InstructionSet::Avx2 : InstructionSet::Baseline;
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
