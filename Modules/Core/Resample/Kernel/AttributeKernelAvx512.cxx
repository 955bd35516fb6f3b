/// The loops of averaging arrays with AVX-512.
#include "Core/Resample/Kernel/AttributeKernelBody.h"

const pointhaptics::simd::AttributeKernels* pointhaptics::simd::avx512AttributeKernels()
{
#if defined(__AVX512F__)
  return &kKernels;
#else
  return nullptr;
#endif
}
