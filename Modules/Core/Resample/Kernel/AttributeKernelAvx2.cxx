/// The loops of averaging arrays with AVX2.
#include "Core/Resample/Kernel/AttributeKernelBody.h"

const pointhaptics::simd::AttributeKernels* pointhaptics::simd::avx2AttributeKernels()
{
#if defined(__AVX2__)
  return &kKernels;
#else
  return nullptr;
#endif
}
