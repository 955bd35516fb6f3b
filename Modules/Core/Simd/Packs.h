/// @file
/// Vectors as wide as the processor's registers for loops that take eight lanes at a time, and sums over such
/// loops that are the same bits whatever the width. For sources that are compiled once per instruction set;
/// all is in an anonymous namespace, so that the linker cannot choose one set's version for the others.
///
/// A Pack has 4 numbers with AVX, else 2 (SSE2, NEON, whatever the compiler has for 16 bytes): a vector of
/// the compiler's own, with its operators. Wider ones GCC takes apart into single numbers. The files must be
/// compiled without fused multiply-adds (-ffp-contract=off). AVX-512 gained 6 % of a resampling and 20 % of a
/// proxy's 2 us step, and is left out.
///
/// Not google/highway: version 1.0.3, which is Debian 12's, has nothing between one number at a time and
/// SSSE3, so that x86-64's baseline takes twice as long as with this; with AVX2 it takes as long as this.
#pragma once

namespace pointhaptics
{
namespace simd
{
namespace
{

constexpr int kLanes = 8;
#if defined(__AVX__)
constexpr int kWidth = 4;
#else
constexpr int kWidth = 2;
#endif
/// Packs in eight lanes.
constexpr int kPacks = kLanes / kWidth;

/// @p n numbers' room in whole packs.
constexpr int wholePacks(int n)
{
  return (n + kWidth - 1) / kWidth * kWidth;
}

using Pack = double __attribute__((vector_size(8 * kWidth)));
/// A Pack that overlays numbers of an array.
using PackAt = double __attribute__((vector_size(8 * kWidth), may_alias));

inline Pack load(const double* from)
{
  return *reinterpret_cast<const PackAt*>(from);
}

inline void store(double* to, const Pack& v)
{
  *reinterpret_cast<PackAt*>(to) = v;
}

inline Pack all(double x)
{
  return Pack{} + x;
}

/// b where a is not a number.
inline Pack larger(const Pack& a, const Pack& b)
{
  return a > b ? a : b;
}

/// b where a is not a number.
inline Pack smaller(const Pack& a, const Pack& b)
{
  return a < b ? a : b;
}

/// Bit i of the result: the sign of number i, or whether a comparison of numbers i is true.
inline unsigned signBits(const Pack& v)
{
#if defined(__AVX__)
  return unsigned(__builtin_ia32_movmskpd256(v));
#elif defined(__SSE2__)
  return unsigned(__builtin_ia32_movmskpd(v));
#else
  return unsigned(__builtin_signbit(v[0]) != 0) | unsigned(__builtin_signbit(v[1]) != 0) << 1;
#endif
}

/// Bit i is set where number i of @p v is below @p x.
inline unsigned belowBits(const Pack& v, double x)
{
  return signBits(reinterpret_cast<Pack>(v < x));
}

/// Number i is the sum of v[i]: neighbours first, then neighbouring pairs, and so on.
inline Pack sumOfEach(const Pack v[kWidth])
{
#if defined(__AVX__)
  const auto pairs = [](const Pack& a, const Pack& b)
  { return __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7); };
  const Pack a = pairs(v[0], v[1]);
  const Pack b = pairs(v[2], v[3]);
  return __builtin_shufflevector(a, b, 0, 1, 4, 5) + __builtin_shufflevector(a, b, 2, 3, 6, 7);
#else
  return __builtin_shufflevector(v[0], v[1], 0, 2) + __builtin_shufflevector(v[0], v[1], 1, 3);
#endif
}

/// N sums, at first for each pack of the eight lanes apart; room for whole packs of sums.
template <int N>
struct LaneSums
{
  static constexpr int kRoom = wholePacks(N);
  alignas(64) double parts[kPacks][kRoom];

  double operator[](int i) const { return parts[0][i]; }
};

/// The sum of each of @p v; @p to has room for whole packs.
template <int N>
inline void sumEach(const Pack (&v)[N], double* to)
{
#pragma GCC unroll 16
  for (int first = 0; first < N; first += kWidth)
  {
    Pack part[kWidth] = {};
#pragma GCC unroll 8
    for (int i = 0; i < kWidth; ++i)
    {
      if (first + i < N)
      {
        part[i] = v[first + i];
      }
    }
    store(to + first, sumOfEach(part));
  }
}

/// N sums over @p size terms, a multiple of kLanes: @p add(i, sums) adds the pack of terms from i on to each
/// of its N packs of sums. Lane l of a sum gathers the terms l, l + 8, l + 16, ...; the lanes v are joined as
/// ((v0 + v1) + (v2 + v3)) + ((v4 + v5) + (v6 + v7)). Where a pack has less than eight lanes those of the
/// first are done before those of the next: N registers are enough.
template <int N, typename Add>
inline LaneSums<N> sumLanes(int size, const Add& add)
{
  LaneSums<N> result;
#pragma GCC unroll 1
  for (int pack = 0; pack < kPacks; ++pack)
  {
    Pack sums[N] = {};
#pragma GCC unroll 1
    for (int i = pack * kWidth; i < size; i += kLanes)
    {
      add(i, sums);
    }
    sumEach(sums, result.parts[pack]);
  }
  // Neighbours first.
#pragma GCC unroll 2
  for (int step = 1; step < kPacks; step *= 2)
  {
#pragma GCC unroll 2
    for (int pack = 0; pack < kPacks; pack += 2 * step)
    {
#pragma GCC unroll 16
      for (int i = 0; i < N; i += kWidth)
      {
        double* const to = result.parts[pack] + i;
        store(to, load(to) + load(result.parts[pack + step] + i));
      }
    }
  }
  return result;
}

}
} // namespace simd
} // namespace pointhaptics
