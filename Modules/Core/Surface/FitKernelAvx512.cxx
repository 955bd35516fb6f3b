/// The loops of the fit with AVX-512: one vector of eight.
#include "Core/Surface/FitKernelBody.h"

const pointhaptics::simd::FitKernels* pointhaptics::simd::avx512FitKernels()
{
#if defined(__AVX512F__)
  return &kKernels;
#else
  return nullptr;
#endif
}
