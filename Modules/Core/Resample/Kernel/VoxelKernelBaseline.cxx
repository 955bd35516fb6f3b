/// The loops of resampling for every machine.
#include "Core/Resample/Kernel/VoxelKernelBody.h"

namespace pointhaptics
{
namespace simd
{

const Kernels& baselineKernels()
{
  return kKernels;
}

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

} // namespace simd
} // namespace pointhaptics
