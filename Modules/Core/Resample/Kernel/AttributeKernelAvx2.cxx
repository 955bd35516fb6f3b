/// The loops of averaging arrays with AVX2.
#include "Core/Resample/Kernel/AttributeKernelBody.h"

const pointhaptics::kernel::AttributeKernels* pointhaptics::kernel::avx2AttributeKernels()
{
#if defined(__AVX2__)
  return &kKernels;
#else
  return nullptr;
#endif
}
