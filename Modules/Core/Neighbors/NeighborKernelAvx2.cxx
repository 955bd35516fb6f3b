/// The loops with AVX2: four numbers at a time.
#include "Core/Neighbors/NeighborKernelBody.h"

#if defined(__AVX2__)
#include <immintrin.h>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// The chosen of four lanes first, for each choice; and the same for pairs of 32-bit words.
struct Choices
{
  alignas(16) std::uint32_t lanes[16][4] = {};
  alignas(32) std::uint32_t words[16][8] = {};

  constexpr Choices()
  {
    for (unsigned bits = 0; bits < 16; ++bits)
    {
      unsigned to = 0;
      for (unsigned lane = 0; lane < 4; ++lane)
      {
        if ((bits >> lane & 1u) != 0)
        {
          lanes[bits][to] = lane;
          words[bits][2 * to] = 2 * lane;
          words[bits][2 * to + 1] = 2 * lane + 1;
          ++to;
        }
      }
    }
  }
};
constexpr Choices kChoices;

struct Avx2
{
  static constexpr int width = 4;
  using Doubles = __m256d;
  using Counts = __m256i;
  using Mask = __m256d;

  static Doubles all(double value) { return _mm256_set1_pd(value); }
  static Doubles load(const double* from) { return _mm256_loadu_pd(from); }
  static void store(double* to, Doubles values) { _mm256_storeu_pd(to, values); }
  static Doubles add(Doubles a, Doubles b) { return _mm256_add_pd(a, b); }
  static Doubles subtract(Doubles a, Doubles b) { return _mm256_sub_pd(a, b); }
  static Doubles multiply(Doubles a, Doubles b) { return _mm256_mul_pd(a, b); }
  static Doubles maximum(Doubles a, Doubles b) { return _mm256_max_pd(a, b); }
  static Mask atMost(Doubles a, Doubles b) { return _mm256_cmp_pd(a, b, _CMP_LE_OQ); }
  static unsigned bits(Mask mask) { return unsigned(_mm256_movemask_pd(mask)); }
  static void compress(double* to, unsigned bits, Doubles values)
  {
    const __m256i words = _mm256_load_si256(reinterpret_cast<const __m256i*>(kChoices.words[bits]));
    _mm256_storeu_ps(reinterpret_cast<float*>(to), _mm256_permutevar8x32_ps(_mm256_castpd_ps(values), words));
  }
  static void lanes(std::uint32_t* to, unsigned bits, std::uint32_t first)
  {
    const __m128i chosen = _mm_load_si128(reinterpret_cast<const __m128i*>(kChoices.lanes[bits]));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_add_epi32(chosen, _mm_set1_epi32(int(first))));
  }
  static Counts none() { return _mm256_setzero_si256(); }
  static Counts countLess(Counts counts, Doubles a, Doubles b)
  {
    return _mm256_sub_epi64(counts, _mm256_castpd_si256(_mm256_cmp_pd(a, b, _CMP_LT_OQ)));
  }
  static void store(std::int64_t* to, Counts counts)
  {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), counts);
  }
};

}

const NeighborKernels* avx2NeighborKernels()
{
  static const NeighborKernels kernels = makeNeighborKernels<Avx2>();
  return &kernels;
}

} // namespace simd
} // namespace pointhaptics

#else

const pointhaptics::simd::NeighborKernels* pointhaptics::simd::avx2NeighborKernels()
{
  return nullptr;
}

#endif
