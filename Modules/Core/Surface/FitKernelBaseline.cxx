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
  switch (usableInstructionSet(wanted))
  {
    case InstructionSet::Avx512:
      return avx512FitKernels() ? *avx512FitKernels() : baselineFitKernels();
    case InstructionSet::Avx2:
      return avx2FitKernels() ? *avx2FitKernels() : baselineFitKernels();
    default:
      return baselineFitKernels();
  }
}

} // namespace simd
} // namespace pointhaptics
