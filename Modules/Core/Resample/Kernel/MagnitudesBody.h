/// @file
/// Part of VoxelKernelBody.h: the magnitudes among the numbers of an array.
#pragma once

#include "Core/Resample/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Compares bits without the sign: they ascend with the magnitude, infinities and NaN above all.
template <typename Bits, typename Real>
Magnitudes magnitudes(const Real* values, std::int64_t count)
{
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

}
} // namespace simd
} // namespace pointhaptics
