/// @file
/// One record into the four lanes of its cell's sums with one 256-bit addition. Internal linkage, like all
/// that sources of several instruction sets share.
#pragma once

#include "Core/Resample/Kernel/VoxelKernel.h"

#if defined(__AVX2__)
#include <immintrin.h>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// The offsets of a record's point in its voxel: x, y, low bits of z, high bits of z.
struct RecordParts
{
  __m256i masks;

  explicit RecordParts(int fractionBits)
  {
    const auto fraction = std::int64_t((std::uint64_t(1) << fractionBits) - 1);
    masks = _mm256_setr_epi64x(fraction, fraction, std::int64_t(kLowMask), fraction >> kLowBits);
  }
  __m256i of(const PointRecord& r) const
  {
    const __m256i words = _mm256_broadcastsi128_si256(_mm_load_si128(reinterpret_cast<const __m128i*>(&r)));
    return _mm256_and_si256(_mm256_srlv_epi64(words, _mm256_setr_epi64x(kLowBits, kLowBits, 0, 0)), masks);
  }
};

struct FourLaneAdder
{
  RecordParts parts;

  explicit FourLaneAdder(int fractionBits)
    : parts(fractionBits)
  {
  }
  void add(PackedSums& sums, const PointRecord& r) const
  {
    const __m256i lanes =
      _mm256_or_si256(parts.of(r), _mm256_setr_epi64x(0, 0, 0, std::int64_t(1) << kCountShift));
    auto* to = reinterpret_cast<__m256i*>(sums.lanes);
    _mm256_storeu_si256(to, _mm256_add_epi64(_mm256_loadu_si256(to), lanes));
  }
};

}
} // namespace simd
} // namespace pointhaptics

#endif
