/// The loops of the fit with AVX-512: one vector of eight.
#include "Core/Surface/FitKernelBody.h"

const pointhaptics::kernel::FitKernels* pointhaptics::kernel::avx512FitKernels()
{
#if defined(__AVX512F__)
  return &kKernels;
#else
  return nullptr;
#endif
}
