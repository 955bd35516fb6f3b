/// @file
/// CovarianceBody.h with AVX2: the six products of a record in two vectors, operations for the covariances of
/// four voxels.
#pragma once

#include "Core/Resample/Kernel/CovarianceBody.h"
#include "Core/Resample/Kernel/FourLaneAdder.h"

#if defined(__AVX2__)
#include <immintrin.h>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Adds the products of one record's offsets to the twelve words of the sums. There is a product of 32 bits
/// only: offsets are cut in half, and the products of the halves put together.
struct TwoVectorAdder
{
  RecordParts recordParts;
  __m256i lowerMask;  ///< Of an offset's lower half.
  __m256i middleMask; ///< Of what of the middle products lies below the sums' border.
  __m128i half;       ///< Bits of the lower half: as many as the upper one has, or one more.
  __m128i upperHalf;
  __m128i odd; ///< Whether it is one more.

  explicit TwoVectorAdder(int fractionBits)
    : recordParts(fractionBits)
  {
    const int lower = (fractionBits + 1) / 2;
    const int upper = fractionBits - lower;
    lowerMask = _mm256_set1_epi64x((std::int64_t(1) << lower) - 1);
    middleMask = _mm256_set1_epi64x((std::int64_t(1) << upper) - 1);
    half = _mm_cvtsi32_si128(lower);
    upperHalf = _mm_cvtsi32_si128(upper);
    odd = _mm_cvtsi32_si128(lower - upper);
  }
  void add(SplitSecondMoments& sums, const PointRecord& r) const
  {
    // x, y and the two parts of z.
    const __m256i parts = _mm256_sllv_epi64(recordParts.of(r), _mm256_setr_epi64x(0, 0, 0, kLowBits));
    // x, y, z and z again.
    const __m256i fractions = _mm256_or_si256(parts, _mm256_permute4x64_epi64(parts, 0xB4));
    const __m256i upper = _mm256_srl_epi64(fractions, half);
    const __m256i lower = _mm256_and_si256(fractions, lowerMask);
    // x, y, z and x with x, y, z and y.
    __m256i high, low;
    const __m256i upperXy = _mm256_permute2x128_si256(upper, upper, 0x00);
    const __m256i lowerXy = _mm256_permute2x128_si256(lower, lower, 0x00);
    multiply(_mm256_blend_epi32(upper, _mm256_unpacklo_epi64(upperXy, upperXy), 0xC0),
      _mm256_blend_epi32(lower, _mm256_unpacklo_epi64(lowerXy, lowerXy), 0xC0),
      _mm256_blend_epi32(upper, upperXy, 0xC0), _mm256_blend_epi32(lower, lowerXy, 0xC0), high, low);
    addTo<__m256i>(sums.high, high);
    addTo<__m256i>(sums.low, low);
    // y and x with z; the upper halves of these vectors are not used.
    multiply(_mm256_shuffle_epi32(upper, 0x4E), _mm256_shuffle_epi32(lower, 0x4E),
      _mm256_permute2x128_si256(upper, upper, 0x01), _mm256_permute2x128_si256(lower, lower, 0x01), high,
      low);
    addTo<__m128i>(sums.high + 4, _mm256_castsi256_si128(high));
    addTo<__m128i>(sums.low + 4, _mm256_castsi256_si128(low));
  }

private:
  /// The products of two offsets each, split at the bits of an offset.
  void multiply(
    __m256i upperA, __m256i lowerA, __m256i upperB, __m256i lowerB, __m256i& high, __m256i& low) const
  {
    const __m256i lowest = _mm256_mul_epu32(lowerA, lowerB);
    const __m256i middle =
      _mm256_add_epi64(_mm256_add_epi64(_mm256_mul_epu32(upperA, lowerB), _mm256_mul_epu32(lowerA, upperB)),
        _mm256_srl_epi64(lowest, half));
    high = _mm256_add_epi64(
      _mm256_sll_epi64(_mm256_mul_epu32(upperA, upperB), odd), _mm256_srl_epi64(middle, upperHalf));
    low = _mm256_or_si256(
      _mm256_sll_epi64(_mm256_and_si256(middle, middleMask), half), _mm256_and_si256(lowest, lowerMask));
  }
  template <typename Vector>
  static void addTo(std::uint64_t* sums, Vector terms)
  {
    auto* to = reinterpret_cast<Vector*>(sums);
    if constexpr (sizeof(Vector) == sizeof(__m256i))
    {
      _mm256_storeu_si256(to, _mm256_add_epi64(_mm256_loadu_si256(to), terms));
    }
    else
    {
      _mm_storeu_si128(to, _mm_add_epi64(_mm_loadu_si128(to), terms));
    }
  }
};

/// What covariancesTogether() needs beside the operations of Avx2.
struct CovarianceAvx2
{
  static __m256i subtractBits(__m256i a, __m256i b) { return _mm256_sub_epi64(a, b); }
  static __m256i leftBy(__m256i a, __m128i bits) { return _mm256_sll_epi64(a, bits); }
  /// a b, modulo 2^64.
  static __m256i product(__m256i a, __m256i b)
  {
    const __m256i crossed = _mm256_add_epi64(
      _mm256_mul_epu32(_mm256_srli_epi64(a, 32), b), _mm256_mul_epu32(a, _mm256_srli_epi64(b, 32)));
    return _mm256_add_epi64(_mm256_mul_epu32(a, b), _mm256_slli_epi64(crossed, 32));
  }
  /// The integer below @p a, which is neither negative nor above 2^52; @p real: the same.
  static __m256i truncated(__m256d a, __m256d& real)
  {
    const __m256d toBits = _mm256_set1_pd(kToBits);
    real = _mm256_round_pd(a, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
    return _mm256_xor_si256(_mm256_castpd_si256(_mm256_add_pd(real, toBits)), _mm256_castpd_si256(toBits));
  }
  /// The lower 32 bits of each lane, without a sign.
  static __m256d lowerWord(__m256i a)
  {
    const __m256i bits = _mm256_blend_epi32(a, _mm256_set1_epi64x(0x4330000000000000), 0xAA);
    return _mm256_sub_pd(_mm256_castsi256_pd(bits), _mm256_set1_pd(0x1p52));
  }
  /// The upper 32 bits, with a sign.
  static __m256d upperWord(__m256i a)
  {
    const __m256i flipped = _mm256_xor_si256(a, _mm256_set1_epi64x(std::int64_t(0x8000000000000000)));
    return _mm256_sub_pd(lowerWord(_mm256_srli_epi64(flipped, 32)), _mm256_set1_pd(0x1p31));
  }
  /// Four consecutive words of each of four structures, from @p offset bytes on: a vector for each word.
  template <typename Words>
  static void loadWords(const Words* from, std::size_t offset, __m256i turned[4])
  {
    const auto load = [&](std::size_t i)
    {
      const auto* at = reinterpret_cast<const char*>(from + i) + offset;
      return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at));
    };
    const __m256i ab02 = _mm256_unpacklo_epi64(load(0), load(1));
    const __m256i ab13 = _mm256_unpackhi_epi64(load(0), load(1));
    const __m256i cd02 = _mm256_unpacklo_epi64(load(2), load(3));
    const __m256i cd13 = _mm256_unpackhi_epi64(load(2), load(3));
    turned[0] = _mm256_permute2x128_si256(ab02, cd02, 0x20);
    turned[1] = _mm256_permute2x128_si256(ab13, cd13, 0x20);
    turned[2] = _mm256_permute2x128_si256(ab02, cd02, 0x31);
    turned[3] = _mm256_permute2x128_si256(ab13, cd13, 0x31);
  }
  /// Two numbers of each of four voxels, into every sixth place.
  static void storePairs(double* to, __m256d first, __m256d second)
  {
    const __m256d even = _mm256_unpacklo_pd(first, second);
    const __m256d odd = _mm256_unpackhi_pd(first, second);
    _mm_storeu_pd(to, _mm256_castpd256_pd128(even));
    _mm_storeu_pd(to + 6, _mm256_castpd256_pd128(odd));
    _mm_storeu_pd(to + 12, _mm256_extractf128_pd(even, 1));
    _mm_storeu_pd(to + 18, _mm256_extractf128_pd(odd, 1));
  }
};

}
} // namespace simd
} // namespace pointhaptics

#endif
