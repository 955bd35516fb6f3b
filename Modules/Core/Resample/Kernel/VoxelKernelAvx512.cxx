/// The loops of resampling with AVX-512.
#include "Core/Resample/Kernel/VoxelKernelBody.h"

const pointhaptics::simd::Kernels* pointhaptics::simd::avx512Kernels()
{
#if defined(__AVX512F__)
  return &kKernels;
#else
  return nullptr;
#endif
}
