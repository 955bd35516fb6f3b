/// The loops of averaging arrays for every machine.
#include "Core/Resample/Kernel/AttributeKernelBody.h"

namespace pointhaptics
{
namespace simd
{

const AttributeKernels& baselineAttributeKernels()
{
  return kKernels;
}

const AttributeKernels& attributeKernels(InstructionSet wanted) noexcept
{
  switch (usableInstructionSet(wanted))
  {
    case InstructionSet::Avx512:
      return avx512AttributeKernels() ? *avx512AttributeKernels() : baselineAttributeKernels();
    case InstructionSet::Avx2:
      return avx2AttributeKernels() ? *avx2AttributeKernels() : baselineAttributeKernels();
    default:
      return baselineAttributeKernels();
  }
}

} // namespace simd
} // namespace pointhaptics
