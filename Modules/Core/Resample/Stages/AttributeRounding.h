/// @file
/// From exact sums to means: how those of arrays are rounded. Private to Core.
#pragma once

#include "Core/Base/Vector3.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace pointhaptics
{
namespace simd
{

/// @pre @p exponent is that of a normal number.
inline double powerOfTwo(int exponent)
{
  const std::uint64_t bits = std::uint64_t(exponent + 1023) << 52;
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Rounded once, as the compiler's own conversion of 128 bits is; nearly all values take the quick way.
inline double toDouble(Int128 value)
{
  constexpr std::int64_t kExact = std::int64_t(1) << 53;
  const auto high = std::int64_t(value >> 32);
  if (Int128(high) == value >> 32 && high > -kExact && high < kExact)
  {
    return double(high) * 0x1p32 + double(std::uint32_t(value));
  }
  return double(value);
}

/// The mean of numbers whose sum is @p sum 2^exponent. Divided before it is scaled: the scale may reach among
/// the denormals.
inline double scaledMean(double sum, int exponent, std::int64_t count)
{
  // ldexp() takes as long as all the rest.
  const double mean = sum / double(count);
  return exponent > -1000 && exponent < 1000 ? mean * powerOfTwo(exponent) : std::ldexp(mean, exponent);
}

/// Sum by IEEE addition of numbers some of which are infinite, or all of them NaN.
inline double meanWithNonFinite(const NonFiniteCount& seen)
{
  const double infinity = std::numeric_limits<double>::infinity();
  return (seen.plus > 0) == (seen.minus > 0) ? std::numeric_limits<double>::quiet_NaN()
    : seen.plus > 0                          ? infinity
                                             : -infinity;
}

/// Rounded to the nearest, halves away from zero.
template <typename T>
T roundedMean(Int128 sum, std::int64_t count)
{
  const Int128 twice = 2 * sum;
  return T((twice + (twice < 0 ? -count : count)) / (2 * Int128(count)));
}
/// As above, in 64 bits. @pre @p sum is of numbers of at most 32 bits, so that @p sum + @p count fits.
template <typename T>
T roundedMean(std::int64_t sum, std::int64_t count)
{
  const std::int64_t half = sum < 0 ? -(count / 2) : count / 2;
  return T((sum + half) / count);
}

/// A mean vector, turned: unit vectors, 0 without a direction, NaN where it is not finite. Integers have a
/// scale of their own: they keep the length of their mean.
template <typename T>
Vec3 turnedMean(const Vec3& mean, const std::array<Vec3, 3>& columns)
{
  const Vec3 turned = mean.x * columns[0] + mean.y * columns[1] + mean.z * columns[2];
  if constexpr (std::is_floating_point_v<T>)
  {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    return isFinite(mean) ? normalized(turned, Vec3()) : Vec3(kNaN, kNaN, kNaN);
  }
  else
  {
    constexpr auto kLow = double(std::numeric_limits<T>::min());
    constexpr auto kHigh = double(std::numeric_limits<T>::max());
    // The largest 64-bit integer is no double; the one below is.
    const double high = sizeof(T) < 8 ? kHigh : std::nextafter(kHigh, 0.0);
    const double length = norm(turned);
    const double scale = length > 0.0 ? norm(mean) / length : 0.0;
    const auto rounded = [&](double x) { return std::clamp(std::round(scale * x), kLow, high); };
    return { rounded(turned.x), rounded(turned.y), rounded(turned.z) };
  }
}

/// Writes the mean of @p count tuples: of floating-point numbers mean(c) in double, of integers integerSum(c)
/// divided. @p columns: turn the mean as a vector, unless null.
template <typename T, typename Mean, typename IntegerSum>
void writeMeans(int components, std::int64_t count, const std::array<Vec3, 3>* columns, T* tuple,
  const Mean& mean, const IntegerSum& integerSum)
{
  if (columns)
  {
    const Vec3 vector = turnedMean<T>({ mean(0), mean(1), mean(2) }, *columns);
    std::transform(&vector.x, &vector.x + 3, tuple, [](double x) { return T(x); });
    return;
  }
  for (int c = 0; c < components; ++c)
  {
    if constexpr (std::is_floating_point_v<T>)
    {
      tuple[c] = T(mean(c));
    }
    else
    {
      tuple[c] = roundedMean<T>(integerSum(c), count);
    }
  }
}

} // namespace simd
} // namespace pointhaptics
