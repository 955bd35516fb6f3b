/// The loops with AVX-512: eight points at a time.
#include "Core/Resample/Kernel/CovarianceAvx512.h"
#include "Core/Resample/Kernel/FourLaneAdder.h"
#include "Core/Resample/Kernel/VoxelKernelBody.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__) &&                                \
  defined(__AVX512VPOPCNTDQ__) && defined(__AVX512IFMA__)
#include <immintrin.h>

namespace pointhaptics
{
namespace simd
{
namespace
{

struct Avx512 : CovarianceAvx512
{
  static constexpr int width = 8;
  static constexpr unsigned full = 255;
  using Doubles = __m512d;
  using Bits = __m512i;
  using Mask = __mmask8;
  using Shift = __m128i;
  static constexpr bool hasFusedMultiply = true;
  static constexpr bool countsOnes = true;
  static constexpr int groupsTogether = 1;
  static constexpr int quantizedAtOnce = 128;
  static constexpr int binnedPerTurn = 8;
  static constexpr bool binsMeanwhile = true;

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
    const __m512 a = _mm512_loadu_ps(xyz);
    const __m512 b = _mm512_castps256_ps512(_mm256_loadu_ps(xyz + 16));
    const auto take = [&](int i0, int i1, int i2, int i3, int i4, int i5, int i6, int i7)
    {
      const __m512i which = _mm512_castsi256_si512(_mm256_setr_epi32(i0, i1, i2, i3, i4, i5, i6, i7));
      return _mm512_cvtps_pd(_mm512_castps512_ps256(_mm512_permutex2var_ps(a, which, b)));
    };
    x = take(0, 3, 6, 9, 12, 15, 18, 21);
    y = take(1, 4, 7, 10, 13, 16, 19, 22);
    z = take(2, 5, 8, 11, 14, 17, 20, 23);
  }
  static void load(const double* xyz, Doubles& x, Doubles& y, Doubles& z)
  {
    deinterleave(_mm512_loadu_pd(xyz), _mm512_loadu_pd(xyz + 8), _mm512_loadu_pd(xyz + 16), x, y, z);
  }
  static Doubles add(Doubles a, Doubles b) { return _mm512_add_pd(a, b); }
  static Doubles subtract(Doubles a, Doubles b) { return _mm512_sub_pd(a, b); }
  static Doubles multiply(Doubles a, Doubles b) { return _mm512_mul_pd(a, b); }
  /// a / b, correctly rounded, from one of the two doubles next to it, by its exact residual (Markstein
  /// 1990). @p reciprocal: 1 / b, correctly rounded.
  static Doubles corrected(Doubles q, Doubles a, Doubles b, Doubles reciprocal)
  {
    return _mm512_fmadd_pd(_mm512_fnmadd_pd(q, b, a), reciprocal, q);
  }
  /// a b + c, rounded once here, twice without a fused multiplication: the same where a b is exact.
  static Doubles multiplyAdd(Doubles a, Doubles b, Doubles c) { return _mm512_fmadd_pd(a, b, c); }
  static Doubles multiplyRest(Doubles a, Doubles b, Doubles product)
  {
    return _mm512_fmsub_pd(a, b, product);
  }
  /// 0 <= a < limit, a not -0: as numbers, what is not has larger bits.
  static Mask below(Mask given, Doubles a, Doubles limit)
  {
    return _mm512_mask_cmplt_epu64_mask(given, _mm512_castpd_si512(a), _mm512_castpd_si512(limit));
  }
  static Mask finite(Doubles a)
  {
    return _mm512_cmp_pd_mask(_mm512_sub_pd(a, a), _mm512_setzero_pd(), _CMP_EQ_OQ);
  }
  static Mask both(Mask a, Mask b) { return Mask(a & b); }
  static unsigned toUnsigned(Mask a) { return a; }
  static Bits floorBits(Doubles u)
  {
    constexpr int kDown = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;
    return _mm512_castpd_si512(_mm512_add_round_pd(u, all(kToBits), kDown));
  }
  static Bits addBits(Bits a, Bits b) { return _mm512_add_epi64(a, b); }
  static Bits multiply32(Bits a, Bits b) { return _mm512_mul_epu32(a, b); }
  static Bits onlyPosition(Bits a) { return _mm512_and_si512(a, allBits(kPositionMask)); }
  static Bits withLowBits(Bits high, Bits a)
  {
    return _mm512_ternarylogic_epi64(allBits(kLowMask), high, a, 0xEC);
  }
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
    return _mm512_cvtepi32_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
  }
  static void store(double* to, Doubles a) { _mm512_store_pd(to, a); }
  static Doubles quotient(Doubles a, Doubles b) { return _mm512_div_pd(a, b); }
  static Doubles least(Doubles a, Doubles b) { return _mm512_min_pd(b, a); }
  static Doubles most(Doubles a, Doubles b) { return _mm512_max_pd(b, a); }
  static Doubles choose(Mask mask, Doubles a, Doubles b) { return _mm512_mask_blend_pd(mask, b, a); }
  static void store(std::uint64_t* to, Bits a) { _mm512_storeu_si512(to, a); }
  static void storeRecords(PointRecord* to, Bits first, Bits second)
  {
    _mm512_storeu_si512(
      to, _mm512_permutex2var_epi64(first, _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11), second));
    _mm512_storeu_si512(
      to + 4, _mm512_permutex2var_epi64(first, _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15), second));
  }

  template <bool inLayer>
  static void cells(const CellMap& map, const PointRecord* records, int count, std::uint32_t* cells)
  {
    const __m512i lowMask = allBits(kLowMask);
    const __m512i columns = allBits(map.columns);
    const __m512i rows = allBits(map.rowsPerLayer);
    const __m512i firstRow = allBits(inLayer ? map.firstInLayer : map.firstRow);
    const __m512i upperRows = allBits(map.upperRows);
    const __m128i toIndex = shift(kLowBits + map.fractionBits);
    const __m128i toLayer = shift(map.fractionBits - kLowBits);
    const __m512i even = _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14);
    const __m512i odd = _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15);
    int i = 0;
    for (; i + 8 <= count; i += 8)
    {
      const __m512i a = _mm512_loadu_si512(records + i);
      const __m512i b = _mm512_loadu_si512(records + i + 4);
      const __m512i first = _mm512_permutex2var_epi64(a, even, b);
      const __m512i second = _mm512_permutex2var_epi64(a, odd, b);
      const __m512i x = _mm512_srl_epi64(first, toIndex);
      const __m512i y = _mm512_srl_epi64(second, toIndex);
      __m512i row = y;
      if (!inLayer)
      {
        const __m512i z = _mm512_srl_epi64(_mm512_and_si512(second, lowMask), toLayer);
        row = _mm512_add_epi64(y, _mm512_mul_epu32(z, rows));
        row = _mm512_mask_add_epi64(row, _mm512_cmplt_epi64_mask(row, firstRow), row, upperRows);
      }
      row = _mm512_sub_epi64(row, firstRow);
      const __m512i cell = _mm512_add_epi64(x, _mm512_mul_epu32(row, columns));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(cells + i), _mm512_cvtepi64_epi32(cell));
    }
    for (; i < count; ++i)
    {
      cells[i] = cellOf<inLayer>(map, records[i]);
    }
  }

  static std::uint32_t rankWords(const CellRanks& ranks)
  {
    static_assert(kOccupancyGroup == 16, "two vectors of words, one of sums");
    const __m512i zero = _mm512_setzero_si512();
    const __m512i last = _mm512_set1_epi32(15);
    const __m512i lowHalves = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    __m512i sum = zero;
    for (std::size_t w = 0; w < ranks.words; w += kOccupancyGroup)
    {
      const __m512i counts =
        _mm512_permutex2var_epi32(_mm512_popcnt_epi64(_mm512_loadu_si512(ranks.occupancy + w)), lowHalves,
          _mm512_popcnt_epi64(_mm512_loadu_si512(ranks.occupancy + w + 8)));
      // Sums over one, two, four, eight and sixteen words.
      __m512i sums = _mm512_add_epi32(counts, _mm512_alignr_epi32(counts, zero, 15));
      sums = _mm512_add_epi32(sums, _mm512_alignr_epi32(sums, zero, 14));
      sums = _mm512_add_epi32(sums, _mm512_alignr_epi32(sums, zero, 12));
      sums = _mm512_add_epi32(sums, _mm512_alignr_epi32(sums, zero, 8));
      _mm512_storeu_si512(ranks.rankTable + w, _mm512_add_epi32(sum, _mm512_sub_epi32(sums, counts)));
      sum = _mm512_add_epi32(sum, _mm512_permutexvar_epi32(last, sums));
    }
    return std::uint32_t(_mm_cvtsi128_si32(_mm512_castsi512_si128(sum)));
  }
  static std::uint32_t ones(std::uint64_t bits) { return std::uint32_t(__builtin_popcountll(bits)); }

  /// The four lanes of eight sums.
  static void loadPacked(const PackedSums* from, Bits lanes[4])
  {
    const __m512i a = _mm512_loadu_si512(from);
    const __m512i b = _mm512_loadu_si512(from + 2);
    const __m512i c = _mm512_loadu_si512(from + 4);
    const __m512i d = _mm512_loadu_si512(from + 6);
    const __m512i first = _mm512_setr_epi64(0, 4, 8, 12, 1, 5, 9, 13);
    const __m512i second = _mm512_setr_epi64(2, 6, 10, 14, 3, 7, 11, 15);
    const __m512i xyLow = _mm512_permutex2var_epi64(a, first, b);
    const __m512i xyHigh = _mm512_permutex2var_epi64(c, first, d);
    const __m512i zLow = _mm512_permutex2var_epi64(a, second, b);
    const __m512i zHigh = _mm512_permutex2var_epi64(c, second, d);
    lanes[0] = _mm512_shuffle_i64x2(xyLow, xyHigh, 0x44);
    lanes[1] = _mm512_shuffle_i64x2(xyLow, xyHigh, 0xEE);
    lanes[2] = _mm512_shuffle_i64x2(zLow, zHigh, 0x44);
    lanes[3] = _mm512_shuffle_i64x2(zLow, zHigh, 0xEE);
  }
  static Doubles toDoubles(Bits a) { return _mm512_cvtepi64_pd(a); }
  static Doubles smallToDoubles(Bits a) { return toDoubles(a); }
  static constexpr bool areSmall(const Bits*) { return false; } // To ask is not worth it.
  static Doubles nearest(Doubles a)
  {
    return _mm512_roundscale_pd(a, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
  }
  static void storeCounts(std::int64_t* to, Bits counts) { _mm512_storeu_si512(to, counts); }
  static void storeInterleaved(float* to, const Doubles xyz[3])
  {
    const __m512 xy =
      _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(xyz[0])), _mm512_cvtpd_ps(xyz[1]), 1);
    const __m512 z = _mm512_castps256_ps512(_mm512_cvtpd_ps(xyz[2]));
    _mm512_storeu_ps(to,
      _mm512_permutex2var_ps(
        xy, _mm512_setr_epi32(0, 8, 16, 1, 9, 17, 2, 10, 18, 3, 11, 19, 4, 12, 20, 5), z));
    const __m512i rest = _mm512_setr_epi32(13, 21, 6, 14, 22, 7, 15, 23, 0, 0, 0, 0, 0, 0, 0, 0);
    _mm256_storeu_ps(to + 16, _mm512_castps512_ps256(_mm512_permutex2var_ps(xy, rest, z)));
  }
  static void storeInterleaved(double* to, const Doubles xyz[3])
  {
    const auto take = [&](__m512i ofXy, __m512i withZ)
    { return _mm512_permutex2var_pd(_mm512_permutex2var_pd(xyz[0], ofXy, xyz[1]), withZ, xyz[2]); };
    _mm512_storeu_pd(
      to, take(_mm512_setr_epi64(0, 8, 0, 1, 9, 0, 2, 10), _mm512_setr_epi64(0, 1, 8, 3, 4, 9, 6, 7)));
    _mm512_storeu_pd(to + 8,
      take(_mm512_setr_epi64(0, 3, 11, 0, 4, 12, 0, 5), _mm512_setr_epi64(10, 1, 2, 11, 4, 5, 12, 7)));
    _mm512_storeu_pd(to + 16,
      take(_mm512_setr_epi64(13, 0, 6, 14, 0, 7, 15, 0), _mm512_setr_epi64(0, 13, 2, 3, 14, 5, 6, 15)));
  }

  static int covariances(const CovarianceMap& map, const PackedSums* sums,
    const SplitSecondMoments* secondMoments, int count, double* covariances, int* full)
  {
    return covariancesInVectors<Avx512>(map, sums, secondMoments, count, covariances, full);
  }

  using Adder = FourLaneAdder;
  using ProductAdder = TwelveLaneAdder;
};

}

const Kernels* avx512Kernels()
{
  static const Kernels kernels = makeKernels<Avx512>();
  return &kernels;
}

} // namespace simd
} // namespace pointhaptics

#else

const pointhaptics::simd::Kernels* pointhaptics::simd::avx512Kernels()
{
  return nullptr;
}

#endif
