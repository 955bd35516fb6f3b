/// The loops of neighbour search for every machine.
#include "Core/Neighbors/NeighborKernelBody.h"

namespace pointhaptics::simd
{

const NeighborKernels& baselineNeighborKernels()
{
  return kKernels;
}

const NeighborKernels& neighborKernels(InstructionSet wanted) noexcept
{
  return loopsFor(wanted, baselineNeighborKernels, avx2NeighborKernels);
}

} // namespace pointhaptics::simd
