/// @file
/// Vectors of 64-bit integers as wide as a Pack, and what turns numbers into them and back. For sources that
/// are compiled once per instruction set, like Packs.h. Every operation gives the same bits on all of them.
///
/// Not google/highway: see Packs.h.
#pragma once

#include "Core/Simd/Packs.h"

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace pointhaptics
{
namespace simd
{
namespace
{

#if defined(__FMA__)
constexpr bool kFuses = true;
#else
constexpr bool kFuses = false;
#endif

using Words = std::uint64_t __attribute__((vector_size(8 * kWidth)));
// Vectors in arrays of numbers. As aliases Clang gives them the alignment of whole vectors.
typedef std::uint64_t WordsAt __attribute__((vector_size(8 * kWidth), aligned(8), may_alias));
typedef float FloatsAt __attribute__((vector_size(4 * kWidth), aligned(4), may_alias));
typedef double DoublesAt __attribute__((vector_size(8 * kWidth), aligned(8), may_alias));
typedef std::int32_t IntsAt __attribute__((vector_size(4 * kWidth), aligned(4), may_alias));

inline Words allWords(std::uint64_t value)
{
  return Words{} + value;
}

inline Words bitsOf(const Pack& v)
{
  return reinterpret_cast<Words>(v);
}

inline Pack fromBits(const Words& v)
{
  return reinterpret_cast<Pack>(v);
}

/// a b + c, rounded once where processors can, twice elsewhere: the same where a b is exact.
inline Pack multiplyAdd(const Pack& a, const Pack& b, const Pack& c)
{
#if defined(__AVX__) && defined(__FMA__)
  return _mm256_fmadd_pd(a, b, c);
#else
  return a * b + c;
#endif
}

/// a b - product, rounded once.
inline Pack productRest(const Pack& a, const Pack& b, const Pack& product)
{
  if constexpr (kFuses)
  {
    return multiplyAdd(a, b, -product);
  }
  Pack rest;
  for (int i = 0; i < kWidth; ++i)
  {
    rest[i] = __builtin_fma(a[i], b[i], -product[i]);
  }
  return rest;
}

/// a / b, correctly rounded, from one of the two doubles next to it, by its exact residual (Markstein 1990).
/// @p reciprocal: 1 / b, correctly rounded. @pre kFuses
inline Pack corrected(const Pack& q, const Pack& a, const Pack& b, const Pack& reciprocal)
{
  return multiplyAdd(multiplyAdd(-q, b, a), reciprocal, q);
}

/// The integer below each number, in the low 52 bits. @pre 0 <= v < 2^52; others give any bits.
inline Words floorBits(const Pack& v)
{
#if defined(__AVX__)
  return bitsOf(Pack(_mm256_floor_pd(v)) + 0x1p52);
#else
  const Pack rounded = v + 0x1p52;
  return bitsOf(rounded) + reinterpret_cast<Words>(rounded - 0x1p52 > v); // A true comparison is -1.
#endif
}

/// Bit i of the result: the highest bit of number i.
inline unsigned highestBits(const Words& v)
{
  return signBits(fromBits(v));
}

/// Converts integers below 2^52.
inline Pack smallToNumbers(const Words& v)
{
  return fromBits(v | std::uint64_t(0x4330000000000000)) - 0x1p52;
}

/// Converts signed integers. The halves are put beside 2^52, 2^63 and 2^84; only their sum is rounded.
inline Pack toNumbers(const Words& v)
{
  const Words low = (v & 0xffffffffu) | std::uint64_t(0x4330000000000000);
  const Words high = (v >> 32) ^ std::uint64_t(0x4530000080000000);
  return (fromBits(high) - (0x1p84 + 0x1p63 + 0x1p52)) + fromBits(low);
}

/// The nearest integer of what is far below 2^51: adding so much leaves no room for a fraction.
inline Pack nearest(const Pack& v)
{
  return (v + 0x1.8p52) - 0x1.8p52;
}

/// Pairs of the numbers of @p a and @p b, one after the other, in two vectors.
inline void storePairs(std::uint64_t* to, const Words& a, const Words& b)
{
#if defined(__AVX__)
  reinterpret_cast<WordsAt*>(to)[0] = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  reinterpret_cast<WordsAt*>(to)[1] = __builtin_shufflevector(a, b, 2, 6, 3, 7);
#else
  reinterpret_cast<WordsAt*>(to)[0] = __builtin_shufflevector(a, b, 0, 2);
  reinterpret_cast<WordsAt*>(to)[1] = __builtin_shufflevector(a, b, 1, 3);
#endif
}

/// kWidth numbers of an array. (GCC's own conversions of vectors go by way of halves.)
inline Pack numbersAt(const double* from)
{
  return *reinterpret_cast<const DoublesAt*>(from);
}
inline Pack numbersAt(const float* from)
{
#if defined(__AVX__)
  return _mm256_cvtps_pd(_mm_loadu_ps(from));
#else
  return Pack{ double(from[0]), double(from[1]) };
#endif
}
/// Converts integers below 2^31.
inline Pack numbersAt(const std::uint32_t* from)
{
#if defined(__AVX__)
  return _mm256_cvtepi32_pd(_mm_loadu_si128(reinterpret_cast<const __m128i_u*>(from)));
#else
  return Pack{ double(from[0]), double(from[1]) };
#endif
}

/// kWidth points, x y z interleaved.
inline void loadPoints(const Pack& a, const Pack& b, const Pack& c, Pack p[3])
{
#if defined(__AVX__)
  const Pack ab = __builtin_shufflevector(a, b, 0, 1, 6, 7);
  const Pack ac = __builtin_shufflevector(a, c, 2, 3, 4, 5);
  const Pack bc = __builtin_shufflevector(b, c, 0, 1, 6, 7);
  p[0] = __builtin_shufflevector(ab, ac, 0, 5, 2, 7);
  p[1] = __builtin_shufflevector(ab, bc, 1, 4, 3, 6);
  p[2] = __builtin_shufflevector(ac, bc, 0, 5, 2, 7);
#else
  p[0] = __builtin_shufflevector(a, b, 0, 3);
  p[1] = __builtin_shufflevector(a, c, 1, 2);
  p[2] = __builtin_shufflevector(b, c, 0, 3);
#endif
}

template <typename Real>
inline void loadPoints(const Real* xyz, Pack p[3])
{
  loadPoints(numbersAt(xyz), numbersAt(xyz + kWidth), numbersAt(xyz + 2 * kWidth), p);
}

/// Stores points, rounded to the type: the inverse of loadPoints().
inline void storePoints(double* xyz, const Pack p[3])
{
  for (int i = 0; i < kWidth; ++i)
  {
    xyz[3 * i] = p[0][i];
    xyz[3 * i + 1] = p[1][i];
    xyz[3 * i + 2] = p[2][i];
  }
}

inline void storePoints(float* xyz, const Pack p[3])
{
  using Floats = float __attribute__((vector_size(4 * kWidth)));
  const auto rounded = [](const Pack& v) -> Floats
  {
#if defined(__AVX__)
    return _mm256_cvtpd_ps(v);
#else
    return Floats{ float(v[0]), float(v[1]) };
#endif
  };
  const Floats x = rounded(p[0]);
  const Floats y = rounded(p[1]);
  const Floats z = rounded(p[2]);
#if defined(__AVX__)
  const Floats xy01 = __builtin_shufflevector(x, y, 0, 4, 1, 5);
  const Floats xy23 = __builtin_shufflevector(x, y, 2, 6, 3, 7);
  const Floats z01xy1 = __builtin_shufflevector(z, xy01, 0, 1, 6, 7);
  const Floats z23xy3 = __builtin_shufflevector(z, xy23, 2, 3, 6, 7);
  FloatsAt* to = reinterpret_cast<FloatsAt*>(xyz);
  to[0] = __builtin_shufflevector(xy01, z01xy1, 0, 1, 4, 6);
  to[1] = __builtin_shufflevector(z01xy1, xy23, 3, 1, 4, 5);
  to[2] = __builtin_shufflevector(z23xy3, z23xy3, 0, 2, 3, 1);
#else
  for (int i = 0; i < kWidth; ++i)
  {
    xyz[3 * i] = x[i];
    xyz[3 * i + 1] = y[i];
    xyz[3 * i + 2] = z[i];
  }
#endif
}

/// Transposes the first four words of kWidth structures of @p stride words.
inline void turnWords(const std::uint64_t* from, std::size_t stride, Words (&to)[4])
{
#if defined(__AVX__)
  const auto at = [=](std::size_t i) { return Words(*reinterpret_cast<const WordsAt*>(from + stride * i)); };
  const Words ab02 = __builtin_shufflevector(at(0), at(1), 0, 4, 2, 6);
  const Words ab13 = __builtin_shufflevector(at(0), at(1), 1, 5, 3, 7);
  const Words cd02 = __builtin_shufflevector(at(2), at(3), 0, 4, 2, 6);
  const Words cd13 = __builtin_shufflevector(at(2), at(3), 1, 5, 3, 7);
  to[0] = __builtin_shufflevector(ab02, cd02, 0, 1, 4, 5);
  to[1] = __builtin_shufflevector(ab13, cd13, 0, 1, 4, 5);
  to[2] = __builtin_shufflevector(ab02, cd02, 2, 3, 6, 7);
  to[3] = __builtin_shufflevector(ab13, cd13, 2, 3, 6, 7);
#else
  for (std::size_t w = 0; w < 4; ++w)
  {
    to[w] = Words{ from[w], from[stride + w] };
  }
#endif
}

/// How many bits are set.
inline std::uint32_t onesOf(std::uint64_t bits)
{
  return std::uint32_t(__builtin_popcountll(bits));
}

}
} // namespace simd
} // namespace pointhaptics
