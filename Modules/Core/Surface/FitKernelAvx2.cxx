/// The loops of the fit with AVX2: two vectors of four.
#include "Core/Surface/FitKernelBody.h"

const pointhaptics::simd::FitKernels* pointhaptics::simd::avx2FitKernels()
{
#if defined(__AVX2__)
  return &kKernels;
#else
  return nullptr;
#endif
}
