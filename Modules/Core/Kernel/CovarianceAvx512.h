/// @file
/// CovarianceBody.h with AVX-512: the six products of a record at once, the covariances of eight voxels.
#pragma once

#include "Core/Kernel/CovarianceBody.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__) && defined(__AVX512IFMA__)
#include <immintrin.h>

namespace pointhaptics
{
namespace kernel
{
namespace
{

/// Adds the products of one record's places to the twelve words of the sums, eight of them and four.
struct TwelveLaneAdder
{
  __m512i masks;
  __m128i toTop; ///< Shifts a place so far that its product with another is split between bits 51 and 52.

  explicit TwelveLaneAdder(int fractionBits)
    : toTop(_mm_cvtsi32_si128(52 - fractionBits))
  {
    const auto fraction = std::int64_t((std::uint64_t(1) << fractionBits) - 1);
    const auto low = std::int64_t(kLowMask);
    masks = _mm512_setr_epi64(fraction, fraction, low, fraction & ~low, 0, 0, 0, 0);
  }
  void add(SplitSeconds& sums, const Record& r) const
  {
    static_assert(sizeof(SplitSeconds) == 96, "high and low follow each other");
    const __m512i words = _mm512_broadcast_i64x2(_mm_load_si128(reinterpret_cast<const __m128i*>(&r)));
    // x, y and the two parts of z.
    const __m512i parts = _mm512_and_si512(
      _mm512_srlv_epi64(words, _mm512_setr_epi64(0, 0, kPositionBits, kPositionBits - kLowBits, 0, 0, 0, 0)),
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

/// Four consecutive words of each of eight structures, from @p offset bytes on: a vector for each word.
template <typename Words>
inline void loadWords(const Words* from, std::size_t offset, __m512i turned[4])
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
inline void storePairs(double* to, __m512d first, __m512d second)
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

/// Operation by operation those of covariance(), for eight voxels. @return which have more than @p most
/// points.
inline unsigned eightCovariances(const CovarianceMap& map, __m512i most, const PackedSums* packed,
  const SplitSeconds* seconds, double* covariances)
{
  __m512i lanes[4];
  __m512i split[12];
  loadWords(packed, 0, lanes);
  loadWords(seconds, 0, split);
  loadWords(seconds, 32, split + 4);
  loadWords(seconds, 64, split + 8);
  const __m512i count = _mm512_srli_epi64(lanes[3], kCountShift);
  const __m512i highOfZ = _mm512_and_si512(lanes[3], _mm512_set1_epi64((std::int64_t(1) << kCountShift) - 1));
  const __m512i sums[3] = { lanes[0], lanes[1],
    _mm512_add_epi64(lanes[2], _mm512_slli_epi64(highOfZ, kLowBits)) };
  const __m512d perPoint = _mm512_div_pd(_mm512_set1_pd(1.0), _mm512_cvtepi64_pd(count));
  const __m512d highUnit = _mm512_set1_pd(double(std::int64_t(1) << map.fractionBits));
  const __m128i shift = _mm_cvtsi32_si128(map.fractionBits);
  __m512i m[3], rest[3];
  __m512d mReal[3], sumReal[3], restReal[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    sumReal[axis] = _mm512_cvtepi64_pd(sums[axis]);
    m[axis] = _mm512_cvttpd_epi64(_mm512_mul_pd(sumReal[axis], perPoint));
    mReal[axis] = _mm512_cvtepi64_pd(m[axis]);
    rest[axis] = _mm512_sub_epi64(sums[axis], _mm512_mullo_epi64(m[axis], count));
    restReal[axis] = _mm512_cvtepi64_pd(rest[axis]);
  }
  const __m512d wordUnit = _mm512_set1_pd(0x1p32);
  __m512d result[6];
  for (int i = 0; i < 6; ++i)
  {
    const int a = kFirstAxis[i];
    const int b = kSecondAxis[i];
    const __m512i sum = _mm512_add_epi64(_mm512_sll_epi64(split[i], shift), split[6 + i]);
    const __m512i bits = _mm512_sub_epi64(
      _mm512_sub_epi64(sum, _mm512_mullo_epi64(m[a], sums[b])), _mm512_mullo_epi64(m[b], rest[a]));
    const __m512d near = _mm512_sub_pd(
      _mm512_mul_pd(_mm512_cvtepi64_pd(split[i]), highUnit), _mm512_mul_pd(mReal[a], sumReal[b]));
    const __m512d turns = _mm512_roundscale_pd(
      _mm512_mul_pd(_mm512_sub_pd(near, _mm512_cvtepi64_pd(bits)), _mm512_set1_pd(0x1p-64)),
      _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
    const __m512d highWord = _mm512_cvtepi32_pd(_mm512_cvtepi64_epi32(_mm512_srli_epi64(bits, 32)));
    const __m512d lowWord = _mm512_cvtepu32_pd(_mm512_cvtepi64_epi32(bits));
    const __m512d high = _mm512_add_pd(_mm512_mul_pd(turns, wordUnit), highWord);
    const __m512d central = _mm512_add_pd(_mm512_mul_pd(high, wordUnit), lowWord);
    const __m512d restProduct = _mm512_mul_pd(_mm512_mul_pd(restReal[a], restReal[b]), perPoint);
    __m512d value = _mm512_mul_pd(_mm512_sub_pd(central, restProduct), perPoint);
    if (a == b)
    {
      value = _mm512_max_pd(_mm512_setzero_pd(), value);
    }
    result[i] = _mm512_mul_pd(_mm512_mul_pd(value, _mm512_set1_pd(map.unit[a])), _mm512_set1_pd(map.unit[b]));
  }
  for (int i = 0; i < 6; i += 2)
  {
    storePairs(covariances + i, result[i], result[i + 1]);
  }
  return _mm512_cmpgt_epi64_mask(count, most);
}

inline int covariancesByEight(const CovarianceMap& map, const PackedSums* sums, const SplitSeconds* seconds,
  int count, double* covariances, int* full)
{
  const __m512i most = _mm512_set1_epi64(mostCovariancePoints(map.fractionBits));
  int found = 0;
  int i = 0;
  for (; i + 8 <= count; i += 8)
  {
    unsigned isFull = eightCovariances(map, most, sums + i, seconds + i, covariances + 6 * i);
    for (; isFull != 0; isFull &= isFull - 1)
    {
      full[found++] = i + __builtin_ctz(isFull);
    }
  }
  return found + covariancesOneByOne(map, sums, seconds, i, count, covariances, full + found);
}

}
} // namespace kernel
} // namespace pointhaptics

#endif
