/// The loops of resampling with AVX2.
#include "Core/Resample/Kernel/VoxelKernelBody.h"

const pointhaptics::simd::Kernels* pointhaptics::simd::avx2Kernels()
{
#if defined(__AVX2__)
  return &kKernels;
#else
  return nullptr;
#endif
}
