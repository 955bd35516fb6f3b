/// The loops of resampling for every machine.
#include "Core/Resample/Kernel/VoxelKernelBody.h"

namespace pointhaptics::simd
{

const Kernels& baselineKernels()
{
  return kKernels;
}

const Kernels& kernelsFor(InstructionSet wanted)
{
  return loopsFor(wanted, baselineKernels, avx2Kernels);
}

} // namespace pointhaptics::simd
