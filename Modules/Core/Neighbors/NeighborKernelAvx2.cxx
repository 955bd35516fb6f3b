/// The loops of neighbour search with AVX2.
#include "Core/Neighbors/NeighborKernelBody.h"

const pointhaptics::simd::NeighborKernels* pointhaptics::simd::avx2NeighborKernels()
{
#if defined(__AVX2__)
  return &kKernels;
#else
  return nullptr;
#endif
}
