/// The loops with AVX-512: eight points at a time.
#include "Core/Kernel/FourLaneAdder.h"
#include "Core/Kernel/VoxelKernelBody.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__) && defined(__AVX512VBMI2__)
#include <immintrin.h>

namespace pointhaptics
{
namespace kernel
{
namespace
{

struct Avx512
{
  static constexpr int width = 8;
  static constexpr unsigned full = 255;
  using Doubles = __m512d;
  using Bits = __m512i;
  using Mask = __mmask8;
  using Shift = __m128i;

  static Doubles all(double value) { return _mm512_set1_pd(value); }
  static Bits allBits(std::uint64_t value) { return _mm512_set1_epi64(std::int64_t(value)); }
  static Shift shift(int bits) { return _mm_cvtsi32_si128(bits); }
  static Mask allTrue() { return Mask(full); }
  /// a b c hold 8 points, interleaved.
  static void deinterleave(__m512d a, __m512d b, __m512d c, Doubles& x, Doubles& y, Doubles& z)
  {
    const __m512d xs = _mm512_permutex2var_pd(a, _mm512_setr_epi64(0, 3, 6, 9, 12, 15, 0, 0), b);
    const __m512d ys = _mm512_permutex2var_pd(a, _mm512_setr_epi64(1, 4, 7, 10, 13, 0, 0, 0), b);
    const __m512d zs = _mm512_permutex2var_pd(a, _mm512_setr_epi64(2, 5, 8, 11, 14, 0, 0, 0), b);
    x = _mm512_permutex2var_pd(xs, _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 10, 13), c);
    y = _mm512_permutex2var_pd(ys, _mm512_setr_epi64(0, 1, 2, 3, 4, 8, 11, 14), c);
    z = _mm512_permutex2var_pd(zs, _mm512_setr_epi64(0, 1, 2, 3, 4, 9, 12, 15), c);
  }
  static void load(const float* xyz, Doubles& x, Doubles& y, Doubles& z)
  {
    deinterleave(_mm512_cvtps_pd(_mm256_loadu_ps(xyz)), _mm512_cvtps_pd(_mm256_loadu_ps(xyz + 8)),
      _mm512_cvtps_pd(_mm256_loadu_ps(xyz + 16)), x, y, z);
  }
  static void load(const double* xyz, Doubles& x, Doubles& y, Doubles& z)
  {
    deinterleave(_mm512_loadu_pd(xyz), _mm512_loadu_pd(xyz + 8), _mm512_loadu_pd(xyz + 16), x, y, z);
  }
  static Doubles add(Doubles a, Doubles b) { return _mm512_add_pd(a, b); }
  static Doubles subtract(Doubles a, Doubles b) { return _mm512_sub_pd(a, b); }
  static Doubles multiply(Doubles a, Doubles b) { return _mm512_mul_pd(a, b); }
  /// a / b, correctly rounded: two corrections of a times the rounded reciprocal, each by its exact residual
  /// (Markstein 1990).
  static Doubles divide(Doubles a, Doubles b, Doubles reciprocal)
  {
    __m512d q = _mm512_mul_pd(a, reciprocal);
    q = _mm512_fmadd_pd(_mm512_fnmadd_pd(q, b, a), reciprocal, q);
    return _mm512_fmadd_pd(_mm512_fnmadd_pd(q, b, a), reciprocal, q);
  }
  static Mask notNegative(Doubles a) { return _mm512_cmp_pd_mask(a, _mm512_setzero_pd(), _CMP_GE_OQ); }
  static Mask less(Doubles a, Doubles b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ); }
  static Mask finite(Doubles a)
  {
    return _mm512_cmp_pd_mask(_mm512_sub_pd(a, a), _mm512_setzero_pd(), _CMP_EQ_OQ);
  }
  static Mask both(Mask a, Mask b) { return Mask(a & b); }
  static unsigned toUnsigned(Mask a) { return a; }
  static Bits floorBits(Doubles u, Doubles magic)
  {
    const __m512d down = _mm512_add_round_pd(u, magic, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
    return _mm512_and_si512(_mm512_castpd_si512(down), allBits(kPositionMask));
  }
  static Bits addBits(Bits a, Bits b) { return _mm512_add_epi64(a, b); }
  static Bits multiply32(Bits a, Bits b) { return _mm512_mul_epu32(a, b); }
  static Bits either(Bits a, Bits b) { return _mm512_or_si512(a, b); }
  static Bits right(Bits a, Shift bits) { return _mm512_srl_epi64(a, bits); }
  template <int bits>
  static Bits rightBy(Bits a)
  {
    return _mm512_srli_epi64(a, bits);
  }
  template <int bits>
  static Bits left(Bits a)
  {
    return _mm512_slli_epi64(a, bits);
  }
  static Doubles fromInts(const std::int64_t* from) { return _mm512_cvtepi64_pd(_mm512_load_si512(from)); }
  static Doubles fromInts(const std::int32_t* from)
  {
    return _mm512_cvtepi32_pd(_mm256_load_si256(reinterpret_cast<const __m256i*>(from)));
  }
  static void store(float* to, Doubles a) { _mm256_store_ps(to, _mm512_cvtpd_ps(a)); }
  static void store(double* to, Doubles a) { _mm512_store_pd(to, a); }
  static Doubles quotient(Doubles a, Doubles b) { return _mm512_div_pd(a, b); }
  static Doubles least(Doubles a, Doubles b) { return _mm512_min_pd(b, a); }
  static Doubles most(Doubles a, Doubles b) { return _mm512_max_pd(b, a); }
  static Doubles choose(Mask mask, Doubles a, Doubles b) { return _mm512_mask_blend_pd(mask, b, a); }
  static void storeBits(std::uint64_t* to, Bits a) { _mm512_store_si512(to, a); }
  /// Records 0 2 4 6, then 1 3 5 7.
  static int slot(int i) { return (i & 1) * 4 + (i >> 1); }
  static void storeRecords(Record* to, Bits first, Bits second)
  {
    _mm512_store_si512(to, _mm512_unpacklo_epi64(first, second));
    _mm512_store_si512(to + 4, _mm512_unpackhi_epi64(first, second));
  }

  static void cells(const CellMap& map, const Record* records, int count, std::uint32_t* cells)
  {
    const __m512i mask = allBits(kPositionMask);
    const __m512i columns = allBits(map.columns);
    const __m512i rows = allBits(map.rowsPerLayer);
    const __m512i firstRow = allBits(map.firstRow);
    const __m512i upperRows = allBits(map.upperRows);
    const __m128i fraction = shift(map.fractionBits);
    const __m128i high = shift(kPositionBits - kLowBits + map.fractionBits);
    const __m512i even = _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14);
    const __m512i odd = _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15);
    int i = 0;
    for (; i + 8 <= count; i += 8)
    {
      const __m512i a = _mm512_loadu_si512(records + i);
      const __m512i b = _mm512_loadu_si512(records + i + 4);
      const __m512i first = _mm512_permutex2var_epi64(a, even, b);
      const __m512i second = _mm512_permutex2var_epi64(a, odd, b);
      const __m512i x = _mm512_srl_epi64(_mm512_and_si512(first, mask), fraction);
      const __m512i y = _mm512_srl_epi64(_mm512_and_si512(second, mask), fraction);
      const __m512i z = _mm512_srl_epi64(second, high);
      const __m512i low = _mm512_add_epi64(y, _mm512_mul_epu32(z, rows));
      const __mmask8 below = _mm512_cmplt_epi64_mask(low, firstRow);
      const __m512i row = _mm512_sub_epi64(_mm512_mask_add_epi64(low, below, low, upperRows), firstRow);
      const __m512i cell = _mm512_add_epi64(x, _mm512_mul_epu32(row, columns));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(cells + i), _mm512_cvtepi64_epi32(cell));
    }
    for (; i < count; ++i)
    {
      cells[i] = cellOf(map, records[i]);
    }
  }

  /// The numbers of the set bits, packed.
  static std::size_t listBits(std::uint64_t bits, std::uint32_t first, std::uint32_t* cells)
  {
    alignas(64) static const std::uint8_t numbers[64] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14,
      15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40,
      41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63 };
    const int count = __builtin_popcountll(bits);
    const __m512i packed = _mm512_maskz_compress_epi8(bits, _mm512_load_si512(numbers));
    const __m512i base = _mm512_set1_epi32(int(first));
    _mm512_storeu_si512(cells, _mm512_add_epi32(base, _mm512_cvtepu8_epi32(_mm512_castsi512_si128(packed))));
    if (count > 16)
    {
      _mm512_storeu_si512(
        cells + 16, _mm512_add_epi32(base, _mm512_cvtepu8_epi32(_mm512_extracti32x4_epi32(packed, 1))));
      _mm512_storeu_si512(
        cells + 32, _mm512_add_epi32(base, _mm512_cvtepu8_epi32(_mm512_extracti32x4_epi32(packed, 2))));
      _mm512_storeu_si512(
        cells + 48, _mm512_add_epi32(base, _mm512_cvtepu8_epi32(_mm512_extracti32x4_epi32(packed, 3))));
    }
    return std::size_t(count);
  }

  using Adder = FourLaneAdder;
};

}

const Kernels* avx512Kernels()
{
  static const Kernels kernels = makeKernels<Avx512>();
  return &kernels;
}

} // namespace kernel
} // namespace pointhaptics

#else

const pointhaptics::kernel::Kernels* pointhaptics::kernel::avx512Kernels()
{
  return nullptr;
}

#endif
