/// The loops with AVX2 and FMA: four points at a time.
#include "Core/Resample/Kernel/CovarianceAvx2.h"
#include "Core/Resample/Kernel/FourLaneAdder.h"
#include "Core/Resample/Kernel/VoxelKernelBody.h"

#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>

namespace pointhaptics
{
namespace simd
{
namespace
{

struct Avx2 : CovarianceAvx2
{
  static constexpr int width = 4;
  static constexpr unsigned full = 15;
  using Doubles = __m256d;
  using Bits = __m256i;
  using Mask = __m256i;
  using Shift = __m128i;
  static constexpr bool hasFusedMultiply = true;
  static constexpr bool countsOnes = true;
  static constexpr int groupsTogether = 8;
  static constexpr int quantizedAtOnce = 256;
  static constexpr int binnedPerTurn = 16;
  static constexpr bool binsMeanwhile = false;

  static Doubles all(double value) { return _mm256_set1_pd(value); }
  static Bits allBits(std::uint64_t value) { return _mm256_set1_epi64x(std::int64_t(value)); }
  static Shift shift(int bits) { return _mm_cvtsi32_si128(bits); }
  static Mask allTrue() { return _mm256_set1_epi64x(-1); }
  /// a b c are x0 y0 z0 x1, y1 z1 x2 y2, z2 x3 y3 z3.
  static void deinterleave(__m256d a, __m256d b, __m256d c, Doubles& x, Doubles& y, Doubles& z)
  {
    const __m256d ab = _mm256_permute2f128_pd(a, b, 0x30);
    const __m256d ac = _mm256_permute2f128_pd(a, c, 0x21);
    const __m256d bc = _mm256_permute2f128_pd(b, c, 0x30);
    x = _mm256_shuffle_pd(ab, ac, 0xA);
    y = _mm256_shuffle_pd(ab, bc, 0x5);
    z = _mm256_shuffle_pd(ac, bc, 0xA);
  }
  static void load(const float* xyz, Doubles& x, Doubles& y, Doubles& z)
  {
    deinterleave(_mm256_cvtps_pd(_mm_loadu_ps(xyz)), _mm256_cvtps_pd(_mm_loadu_ps(xyz + 4)),
      _mm256_cvtps_pd(_mm_loadu_ps(xyz + 8)), x, y, z);
  }
  static void load(const double* xyz, Doubles& x, Doubles& y, Doubles& z)
  {
    deinterleave(_mm256_loadu_pd(xyz), _mm256_loadu_pd(xyz + 4), _mm256_loadu_pd(xyz + 8), x, y, z);
  }
  static Doubles add(Doubles a, Doubles b) { return _mm256_add_pd(a, b); }
  static Doubles subtract(Doubles a, Doubles b) { return _mm256_sub_pd(a, b); }
  static Doubles multiply(Doubles a, Doubles b) { return _mm256_mul_pd(a, b); }
  /// a / b, correctly rounded, from one of the two doubles next to it, by its exact residual (Markstein
  /// 1990). @p reciprocal: 1 / b, correctly rounded.
  static Doubles corrected(Doubles q, Doubles a, Doubles b, Doubles reciprocal)
  {
    return _mm256_fmadd_pd(_mm256_fnmadd_pd(q, b, a), reciprocal, q);
  }
  /// a b + c, rounded once here, twice without a fused multiplication: the same where a b is exact.
  static Doubles multiplyAdd(Doubles a, Doubles b, Doubles c) { return _mm256_fmadd_pd(a, b, c); }
  static Doubles multiplyRest(Doubles a, Doubles b, Doubles product)
  {
    return _mm256_fmsub_pd(a, b, product);
  }
  /// 0 <= a < limit, a not -0. Only the signs of a mask count.
  static Mask below(Mask given, Doubles a, Doubles limit)
  {
    const __m256d isBelow = _mm256_andnot_pd(a, _mm256_cmp_pd(a, limit, _CMP_LT_OQ));
    return both(given, _mm256_castpd_si256(isBelow));
  }
  static Mask finite(Doubles a)
  {
    return _mm256_castpd_si256(_mm256_cmp_pd(_mm256_sub_pd(a, a), _mm256_setzero_pd(), _CMP_EQ_OQ));
  }
  static Mask both(Mask a, Mask b) { return _mm256_and_si256(a, b); }
  static unsigned toUnsigned(Mask a) { return unsigned(_mm256_movemask_pd(_mm256_castsi256_pd(a))); }
  static Bits floorBits(Doubles u)
  {
    return _mm256_castpd_si256(_mm256_add_pd(_mm256_floor_pd(u), all(kToBits)));
  }
  static Bits addBits(Bits a, Bits b) { return _mm256_add_epi64(a, b); }
  static Bits multiply32(Bits a, Bits b) { return _mm256_mul_epu32(a, b); }
  static Bits onlyPosition(Bits a) { return _mm256_and_si256(a, allBits(kPositionMask)); }
  static Bits withLowBits(Bits high, Bits a)
  {
    return _mm256_or_si256(high, _mm256_and_si256(a, allBits(kLowMask)));
  }
  static Bits right(Bits a, Shift bits) { return _mm256_srl_epi64(a, bits); }
  template <int bits>
  static Bits rightBy(Bits a)
  {
    return _mm256_srli_epi64(a, bits);
  }
  template <int bits>
  static Bits left(Bits a)
  {
    return _mm256_slli_epi64(a, bits);
  }
  /// Signed. The halves are put beside 2^52, 2^63 and 2^84; only their sum is rounded.
  static Doubles toDoubles(Bits value)
  {
    const __m256i low = _mm256_blend_epi32(value, _mm256_set1_epi64x(0x4330000000000000), 0xAA);
    const __m256i high =
      _mm256_xor_si256(_mm256_srli_epi64(value, 32), _mm256_set1_epi64x(0x4530000080000000));
    const __m256d offset = _mm256_set1_pd(0x1p84 + 0x1p63 + 0x1p52);
    return _mm256_add_pd(_mm256_sub_pd(_mm256_castsi256_pd(high), offset), _mm256_castsi256_pd(low));
  }
  /// Of what is below 2^52.
  static Doubles smallToDoubles(Bits value)
  {
    const __m256d toBits = _mm256_set1_pd(kToBits);
    return _mm256_sub_pd(_mm256_or_pd(_mm256_castsi256_pd(value), toBits), toBits);
  }
  static bool areSmall(const Bits values[3])
  {
    const __m256i any = _mm256_or_si256(_mm256_or_si256(values[0], values[1]), values[2]);
    return _mm256_testz_si256(any, allBits(~((std::uint64_t(1) << 52) - 1)));
  }
  static Doubles fromInts(const std::int64_t* from)
  {
    return toDoubles(_mm256_load_si256(reinterpret_cast<const __m256i*>(from)));
  }
  static Doubles fromInts(const std::int32_t* from)
  {
    return _mm256_cvtepi32_pd(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
  }
  static void store(double* to, Doubles a) { _mm256_store_pd(to, a); }
  static Doubles quotient(Doubles a, Doubles b) { return _mm256_div_pd(a, b); }
  static Doubles least(Doubles a, Doubles b) { return _mm256_min_pd(b, a); }
  static Doubles most(Doubles a, Doubles b) { return _mm256_max_pd(b, a); }
  static Doubles choose(Mask mask, Doubles a, Doubles b)
  {
    return _mm256_blendv_pd(b, a, _mm256_castsi256_pd(mask));
  }
  static void store(std::uint64_t* to, Bits a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a); }
  static void storeRecords(PointRecord* to, Bits first, Bits second)
  {
    const __m256i even = _mm256_unpacklo_epi64(first, second);
    const __m256i odd = _mm256_unpackhi_epi64(first, second);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permute2x128_si256(even, odd, 0x20));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + 2), _mm256_permute2x128_si256(even, odd, 0x31));
  }

  template <bool inLayer>
  static void cells(const CellMap& map, const PointRecord* records, int count, std::uint32_t* cells)
  {
    const __m128i toIndex = shift(kLowBits + map.fractionBits);
    int i = 0;
    if (inLayer)
    {
      static_assert(kMaximumIndexBits < 15, "indices must fit signed numbers of 16 bits");
      const __m256i columns = _mm256_set1_epi32(int(1 + (map.columns << 16)));
      const __m256i firstCell = _mm256_set1_epi32(int(map.columns * map.firstInLayer));
      const auto indices = [&](int record)
      {
        const auto* from = reinterpret_cast<const __m256i*>(records + record);
        return _mm256_castsi256_ps(_mm256_srl_epi64(_mm256_load_si256(from), toIndex));
      };
      // x y of records 0 and 2, 1 and 3 after `first`.
      const auto four = [&](int first)
      { return _mm256_castps_si256(_mm256_shuffle_ps(indices(first), indices(first + 2), 0x88)); };
      for (; i + 8 <= count; i += 8)
      {
        const __m256i xy = _mm256_packus_epi32(four(i), four(i + 4));
        const __m256i cell = _mm256_sub_epi32(_mm256_madd_epi16(xy, columns), firstCell);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(cells + i),
          _mm256_permutevar8x32_epi32(cell, _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7)));
      }
    }
    else
    {
      const __m256i lowMask = allBits(kLowMask);
      const __m256i columns = allBits(map.columns);
      const __m256i rows = allBits(map.rowsPerLayer);
      const __m256i firstRow = allBits(map.firstRow);
      const __m256i upperRows = allBits(map.upperRows);
      const __m128i toLayer = shift(map.fractionBits - kLowBits);
      for (; i + 4 <= count; i += 4)
      {
        const __m256i a = _mm256_load_si256(reinterpret_cast<const __m256i*>(records + i));
        const __m256i b = _mm256_load_si256(reinterpret_cast<const __m256i*>(records + i + 2));
        const __m256i first = _mm256_unpacklo_epi64(a, b);
        const __m256i second = _mm256_unpackhi_epi64(a, b);
        const __m256i x = _mm256_srl_epi64(first, toIndex);
        const __m256i y = _mm256_srl_epi64(second, toIndex);
        const __m256i z = _mm256_srl_epi64(_mm256_and_si256(second, lowMask), toLayer);
        __m256i row = _mm256_add_epi64(y, _mm256_mul_epu32(z, rows));
        row = _mm256_add_epi64(row, _mm256_and_si256(_mm256_cmpgt_epi64(firstRow, row), upperRows));
        row = _mm256_sub_epi64(row, firstRow);
        const __m256i cell = _mm256_add_epi64(x, _mm256_mul_epu32(row, columns));
        // Lanes are records 0 2 1 3; their low halves go to the front.
        const __m256i packed = _mm256_permutevar8x32_epi32(cell, _mm256_setr_epi32(0, 4, 2, 6, 0, 4, 2, 6));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(cells + i), _mm256_castsi256_si128(packed));
      }
    }
    for (; i < count; ++i)
    {
      cells[i] = cellOf<inLayer>(map, records[i]);
    }
  }

  static std::uint32_t rankWords(const CellRanks& ranks)
  {
    std::uint32_t sum = 0;
    for (std::size_t group = 0; group < ranks.words; group += kOccupancyGroup)
    {
      for (std::size_t w = group; w < group + kOccupancyGroup; ++w) // unrolled
      {
        sum = rankWord<Avx2>(ranks, w, sum);
      }
    }
    return sum;
  }
  static std::uint32_t ones(std::uint64_t bits) { return std::uint32_t(__builtin_popcountll(bits)); }

  /// The four lanes of four sums.
  static void loadPacked(const PackedSums* from, Bits lanes[4]) { loadWords(from, 0, lanes); }
  static Doubles nearest(Doubles a)
  {
    return _mm256_round_pd(a, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
  }
  static void storeCounts(std::int64_t* to, Bits counts)
  {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), counts);
  }
  static void storeInterleaved(float* to, const Doubles xyz[3])
  {
    const __m128 x = _mm256_cvtpd_ps(xyz[0]);
    const __m128 y = _mm256_cvtpd_ps(xyz[1]);
    const __m128 z = _mm256_cvtpd_ps(xyz[2]);
    const __m128 xy01 = _mm_unpacklo_ps(x, y);
    const __m128 xy23 = _mm_unpackhi_ps(x, y);
    const __m128 z01xy1 = _mm_shuffle_ps(z, xy01, _MM_SHUFFLE(3, 2, 1, 0));
    const __m128 z23xy3 = _mm_shuffle_ps(z, xy23, _MM_SHUFFLE(3, 2, 3, 2));
    _mm_storeu_ps(to, _mm_shuffle_ps(xy01, z01xy1, _MM_SHUFFLE(2, 0, 1, 0)));
    _mm_storeu_ps(to + 4, _mm_shuffle_ps(z01xy1, xy23, _MM_SHUFFLE(1, 0, 1, 3)));
    _mm_storeu_ps(to + 8, _mm_shuffle_ps(z23xy3, z23xy3, _MM_SHUFFLE(1, 3, 2, 0)));
  }
  static void storeInterleaved(double* to, const Doubles xyz[3])
  {
    alignas(32) double parts[3][width];
    for (int axis = 0; axis < 3; ++axis)
    {
      _mm256_store_pd(parts[axis], xyz[axis]);
    }
    for (int i = 0; i < 3 * width; ++i)
    {
      to[i] = parts[i % 3][i / 3];
    }
  }

  static int covariances(const CovarianceMap& map, const PackedSums* sums,
    const SplitSecondMoments* secondMoments, int count, double* covariances, int* full)
  {
    return covariancesInVectors<Avx2>(map, sums, secondMoments, count, covariances, full);
  }

  using Adder = FourLaneAdder;
  using ProductAdder = TwoVectorAdder;
};

}

const Kernels* avx2Kernels()
{
  static const Kernels kernels = makeKernels<Avx2>();
  return &kernels;
}

} // namespace simd
} // namespace pointhaptics

#else

const pointhaptics::simd::Kernels* pointhaptics::simd::avx2Kernels()
{
  return nullptr;
}

#endif
