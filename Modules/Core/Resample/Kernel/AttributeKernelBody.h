/// @file
/// Part of VoxelKernelBody.h: the loops of AttributeKernel.h, for the compiler to make vectors of.
#pragma once

#include "Core/Resample/Kernel/AttributeKernel.h"
#include "Core/Resample/Kernel/SelectBody.h"
#include "Core/Simd/Words.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Numbers worked on together.
constexpr int kNumbers = 768;

/// By the bits without the sign: they ascend with the magnitude, infinities and NaN above all.
template <typename Bits, typename Real>
inline Magnitudes magnitudes(const void* given, std::int64_t count)
{
  const auto* values = static_cast<const Real*>(given);
  static_assert(sizeof(Bits) == sizeof(Real), "the bits of a number");
  constexpr Bits kMagnitude = ~(Bits(1) << (8 * sizeof(Bits) - 1));
  const auto bitsOf = [](Real value)
  {
    Bits bits;
    __builtin_memcpy(&bits, &value, sizeof bits);
    return bits;
  };
  const auto numberOf = [](Bits bits)
  {
    Real value;
    __builtin_memcpy(&value, &bits, sizeof value);
    return double(value);
  };
  const Bits infinite = bitsOf(Real(__builtin_inf()));
  Bits most = 0;
  Bits leastLessOne = infinite - 1; // Zero becomes the largest of all.
  for (std::int64_t i = 0; i < count; ++i)
  {
    const Bits bits = bitsOf(values[i]) & kMagnitude;
    most = bits > most ? bits : most;
    leastLessOne = bits - 1 < leastLessOne ? bits - 1 : leastLessOne;
  }
  const bool allFinite = most < infinite;
  if (!allFinite)
  {
    most = 0;
    for (std::int64_t i = 0; i < count; ++i)
    {
      const Bits bits = bitsOf(values[i]) & kMagnitude;
      most = bits < infinite && bits > most ? bits : most;
    }
  }
  return { numberOf(most), numberOf(leastLessOne + 1), allFinite };
}

template <int Components>
inline void repeatCounts(const std::int64_t* counts, int voxels, int components, double* repeated)
{
  const int width = Components > 0 ? Components : components;
  for (int v = 0; v < voxels; ++v)
  {
    for (int c = 0; c < width; ++c)
    {
      repeated[width * v + c] = double(counts[v]);
    }
  }
}

/// Calls work(first, count, counts) for pieces of the sums, with the count of its voxel for each.
template <typename Work>
inline void forPieces(const WordSums& s, Work&& work)
{
  alignas(64) double repeated[kNumbers];
  if (s.components > kNumbers)
  {
    for (std::int64_t i = 0; i < s.voxels * s.components; ++i)
    {
      repeated[0] = double(s.counts[i / s.components]);
      work(i, 1, repeated);
    }
    return;
  }
  const int atOnce = kNumbers / s.components;
  const auto repeat = s.components == 1 ? &repeatCounts<1>
    : s.components == 3                 ? &repeatCounts<3>
                                        : &repeatCounts<0>;
  for (std::int64_t first = 0; first < s.voxels; first += atOnce)
  {
    const int voxels = s.voxels - first < atOnce ? int(s.voxels - first) : atOnce;
    repeat(s.counts + first, voxels, s.components, repeated);
    work(first * s.components, voxels * s.components, repeated);
  }
}

/// Sums, at most kNumbers. A loop of its own: compilers make no vectors of conversions from 64 bits.
inline void toNumbers(const std::int64_t* sums, int count, double* numbers)
{
  int i = 0;
  for (; i + kWidth <= count; i += kWidth)
  {
    *reinterpret_cast<DoublesAt*>(numbers + i) =
      toNumbers(Words(*reinterpret_cast<const WordsAt*>(sums + i)));
  }
  for (; i < count; ++i)
  {
    numbers[i] = double(sums[i]);
  }
}

template <typename T>
inline T meanOf(double sum, double count, double unit)
{
  if constexpr (T(0.5) != T(0))
  {
    return T(sum / count * unit);
  }
  // Numbers of so few bits that a rounded quotient does not reach the integer above the exact one.
  const double half = 0.5 * count;
  const double mean = (sum + (sum < 0.0 ? -half : half)) / count;
  return sizeof(T) < 4 ? T(std::int32_t(mean)) : T(std::int64_t(mean));
}

template <typename T>
inline void means(const WordSums& s, void* means)
{
  const double unit = s.unit;
  alignas(64) double sums[kNumbers];
  forPieces(s,
    [&](std::int64_t first, int count, const double* counts)
    {
      toNumbers(s.sums + first, count, sums);
      T* to = static_cast<T*>(means) + first;
      for (int i = 0; i < count; ++i)
      {
        to[i] = meanOf<T>(sums[i], counts[i], unit);
      }
    });
}

template <typename Real>
inline void unitVectors(const WordSums& s, const Turn& turn, void* vectors)
{
  constexpr int kVectors = kNumbers / 3;
  alignas(64) double mean[kNumbers];
  for (std::int64_t first = 0; first < s.voxels; first += kVectors)
  {
    const int count = s.voxels - first < kVectors ? int(s.voxels - first) : kVectors;
    means<double>(WordSums{ s.sums + 3 * first, s.counts + first, count, 3, s.unit }, mean);
    Real* to = static_cast<Real*>(vectors) + 3 * first;
    for (int i = 0; i < count; ++i)
    {
      double turned[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        turned[axis] = mean[3 * i] * turn.columns[0][axis] + mean[3 * i + 1] * turn.columns[1][axis] +
          mean[3 * i + 2] * turn.columns[2][axis];
      }
      const double length =
        __builtin_sqrt(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2]);
      const bool hasDirection = length > 0.0 && length <= __DBL_MAX__;
      for (int axis = 0; axis < 3; ++axis)
      {
        to[3 * i + axis] = Real(hasDirection ? turned[axis] / length : 0.0);
      }
    }
  }
}

constexpr AttributeKernels kAttributeKernels = {
  { &magnitudes<std::uint32_t, float>, &magnitudes<std::uint64_t, double> },
  { &unitVectors<float>, &unitVectors<double> },
  { &means<std::int8_t>, &means<std::uint8_t>, &means<std::int16_t>, &means<std::uint16_t>,
    &means<std::int32_t>, &means<std::uint32_t>, nullptr, nullptr, &means<float>, &means<double> },
  { &select<std::int8_t, false>, &select<std::uint8_t, false>, &select<std::int16_t, false>,
    &select<std::uint16_t, false>, &select<std::int32_t, false>, &select<std::uint32_t, false>,
    &select<std::int64_t, false>, &select<std::uint64_t, false>, &select<float, false>,
    &select<double, false> },
  { &select<std::int8_t, true>, &select<std::uint8_t, true>, &select<std::int16_t, true>,
    &select<std::uint16_t, true>, &select<std::int32_t, true>, &select<std::uint32_t, true>,
    &select<std::int64_t, true>, &select<std::uint64_t, true>, &select<float, true>, &select<double, true> }
};

}
} // namespace simd
} // namespace pointhaptics
