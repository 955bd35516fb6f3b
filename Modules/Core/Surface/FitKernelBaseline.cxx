/// The loops of the fit for every machine.
#include "Core/Surface/FitKernelBody.h"

namespace pointhaptics
{
namespace simd
{

const FitKernels& baselineFitKernels()
{
  return kKernels;
}

const FitKernels& fitKernels(InstructionSet wanted) noexcept
{
  return loopsFor(wanted, baselineFitKernels, avx2FitKernels);
}

} // namespace simd
} // namespace pointhaptics
