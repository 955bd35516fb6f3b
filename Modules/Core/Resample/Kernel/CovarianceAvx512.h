/// @file
/// CovarianceBody.h with AVX-512: the six products of a record at once, operations for the covariances
/// of eight voxels.
#pragma once

#include "Core/Resample/Kernel/CovarianceBody.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__) && defined(__AVX512IFMA__)
#include <immintrin.h>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Adds the products of one record's offsets to the twelve words of the sums, eight of them and four.
struct TwelveLaneAdder
{
  __m512i masks;
  __m128i toTop; ///< Shifts an offset so far that its product with another is split between bits 51 and 52.

  explicit TwelveLaneAdder(int fractionBits)
    : toTop(_mm_cvtsi32_si128(52 - fractionBits))
  {
    const auto fraction = std::int64_t((std::uint64_t(1) << fractionBits) - 1);
    const auto low = std::int64_t(kLowMask);
    masks = _mm512_setr_epi64(fraction, fraction, low, fraction & ~low, 0, 0, 0, 0);
  }
  void add(SplitSecondMoments& sums, const PointRecord& r) const
  {
    static_assert(sizeof(SplitSecondMoments) == 96, "high and low follow each other");
    const __m512i words = _mm512_broadcast_i64x2(_mm_load_si128(reinterpret_cast<const __m128i*>(&r)));
    // x, y and the two parts of z.
    const __m512i parts = _mm512_and_si512(
      _mm512_rolv_epi64(words, _mm512_setr_epi64(kPositionBits, kPositionBits, 0, kLowBits, 0, 0, 0, 0)),
      masks);
    // The products in their order, then the first two again.
    const __m512i a =
      _mm512_or_si512(_mm512_permutexvar_epi64(_mm512_setr_epi64(0, 1, 2, 0, 1, 0, 0, 1), parts),
        _mm512_maskz_permutexvar_epi64(0x04, _mm512_set1_epi64(3), parts));
    const __m512i b =
      _mm512_or_si512(_mm512_permutexvar_epi64(_mm512_setr_epi64(0, 1, 2, 1, 2, 2, 0, 1), parts),
        _mm512_maskz_permutexvar_epi64(0x34, _mm512_set1_epi64(3), parts));
    const __m512i top = _mm512_sll_epi64(a, toTop);
    const __m512i zero = _mm512_setzero_si512();
    const __m512i high = _mm512_madd52hi_epu64(zero, top, b);
    const __m512i low = _mm512_srl_epi64(_mm512_madd52lo_epu64(zero, top, b), toTop);
    auto* first = sums.high;
    auto* second = reinterpret_cast<__m256i*>(sums.low + 2);
    _mm512_storeu_si512(
      first, _mm512_add_epi64(_mm512_loadu_si512(first), _mm512_mask_blend_epi64(0xC0, high, low)));
    _mm256_storeu_si256(second,
      _mm256_add_epi64(
        _mm256_loadu_si256(second), _mm512_castsi512_si256(_mm512_alignr_epi64(zero, low, 2))));
  }
};

/// What covariancesTogether() needs beside the operations of Avx512.
struct CovarianceAvx512
{
  static __m512i subtractBits(__m512i a, __m512i b) { return _mm512_sub_epi64(a, b); }
  static __m512i leftBy(__m512i a, __m128i bits) { return _mm512_sll_epi64(a, bits); }
  /// a b, modulo 2^64.
  static __m512i product(__m512i a, __m512i b) { return _mm512_mullo_epi64(a, b); }
  /// The integer below @p a, which is not negative; @p real: the same.
  static __m512i truncated(__m512d a, __m512d& real)
  {
    const __m512i whole = _mm512_cvttpd_epi64(a);
    real = _mm512_cvtepi64_pd(whole);
    return whole;
  }
  /// The lower 32 bits of each lane, without a sign.
  static __m512d lowerWord(__m512i a) { return _mm512_cvtepu32_pd(_mm512_cvtepi64_epi32(a)); }
  /// The upper 32 bits, with a sign.
  static __m512d upperWord(__m512i a)
  {
    return _mm512_cvtepi32_pd(_mm512_cvtepi64_epi32(_mm512_srli_epi64(a, 32)));
  }
  /// Four consecutive words of each of eight structures, from @p offset bytes on: a vector for each word.
  template <typename Words>
  static void loadWords(const Words* from, std::size_t offset, __m512i turned[4])
  {
    const auto load = [&](std::size_t i)
    {
      const auto* at = reinterpret_cast<const char*>(from + i) + offset;
      const auto* low = reinterpret_cast<const __m256i*>(at);
      const auto* high = reinterpret_cast<const __m256i*>(at + 4 * sizeof(Words));
      return _mm512_inserti64x4(_mm512_castsi256_si512(_mm256_loadu_si256(low)), _mm256_loadu_si256(high), 1);
    };
    const __m512i a = load(0);
    const __m512i b = load(1);
    const __m512i c = load(2);
    const __m512i d = load(3);
    const __m512i ab02 = _mm512_unpacklo_epi64(a, b);
    const __m512i ab13 = _mm512_unpackhi_epi64(a, b);
    const __m512i cd02 = _mm512_unpacklo_epi64(c, d);
    const __m512i cd13 = _mm512_unpackhi_epi64(c, d);
    const __m512i front = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i back = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    turned[0] = _mm512_permutex2var_epi64(ab02, front, cd02);
    turned[1] = _mm512_permutex2var_epi64(ab13, front, cd13);
    turned[2] = _mm512_permutex2var_epi64(ab02, back, cd02);
    turned[3] = _mm512_permutex2var_epi64(ab13, back, cd13);
  }

  /// Two numbers of each of eight voxels, into every sixth place.
  static void storePairs(double* to, __m512d first, __m512d second)
  {
    const __m512d even = _mm512_unpacklo_pd(first, second);
    const __m512d odd = _mm512_unpackhi_pd(first, second);
    _mm_storeu_pd(to, _mm512_extractf64x2_pd(even, 0));
    _mm_storeu_pd(to + 6, _mm512_extractf64x2_pd(odd, 0));
    _mm_storeu_pd(to + 12, _mm512_extractf64x2_pd(even, 1));
    _mm_storeu_pd(to + 18, _mm512_extractf64x2_pd(odd, 1));
    _mm_storeu_pd(to + 24, _mm512_extractf64x2_pd(even, 2));
    _mm_storeu_pd(to + 30, _mm512_extractf64x2_pd(odd, 2));
    _mm_storeu_pd(to + 36, _mm512_extractf64x2_pd(even, 3));
    _mm_storeu_pd(to + 42, _mm512_extractf64x2_pd(odd, 3));
  }
};

}
} // namespace simd
} // namespace pointhaptics

#endif
