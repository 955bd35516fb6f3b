/// The loops with AVX-512: eight numbers at a time.
#include "Core/Neighbors/NeighborKernelBody.h"

#if defined(__AVX512F__) && defined(__AVX512VL__) && defined(__AVX512DQ__)
#include <immintrin.h>

namespace pointhaptics
{
namespace simd
{
namespace
{

struct Avx512
{
  static constexpr int width = 8;
  using Doubles = __m512d;
  using Counts = __m512i;
  using Mask = __mmask8;

  static Doubles all(double value) { return _mm512_set1_pd(value); }
  static Doubles load(const double* from) { return _mm512_loadu_pd(from); }
  static void store(double* to, Doubles values) { _mm512_storeu_pd(to, values); }
  static Doubles add(Doubles a, Doubles b) { return _mm512_add_pd(a, b); }
  static Doubles subtract(Doubles a, Doubles b) { return _mm512_sub_pd(a, b); }
  static Doubles multiply(Doubles a, Doubles b) { return _mm512_mul_pd(a, b); }
  static Doubles maximum(Doubles a, Doubles b) { return _mm512_max_pd(a, b); }
  static Mask atMost(Doubles a, Doubles b) { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ); }
  static unsigned bits(Mask mask) { return mask; }
  // To a register and from there: compressing straight into memory is slow on some processors.
  static void compress(double* to, unsigned bits, Doubles values)
  {
    _mm512_storeu_pd(to, _mm512_maskz_compress_pd(__mmask8(bits), values));
  }
  static void lanes(std::uint32_t* to, unsigned bits, std::uint32_t first)
  {
    const __m256i numbers =
      _mm256_add_epi32(_mm256_set1_epi32(int(first)), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_maskz_compress_epi32(__mmask8(bits), numbers));
  }
  static Counts none() { return _mm512_setzero_si512(); }
  static Counts countLess(Counts counts, Doubles a, Doubles b)
  {
    return _mm512_mask_sub_epi64(counts, _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ), counts, _mm512_set1_epi64(-1));
  }
  static void store(std::int64_t* to, Counts counts) { _mm512_storeu_si512(to, counts); }
};

}

const NeighborKernels* avx512NeighborKernels()
{
  static const NeighborKernels kernels = makeNeighborKernels<Avx512>();
  return &kernels;
}

} // namespace simd
} // namespace pointhaptics

#else

const pointhaptics::simd::NeighborKernels* pointhaptics::simd::avx512NeighborKernels()
{
  return nullptr;
}

#endif
