/// @file
/// Random numbers that are the same on every machine: only exact integer steps and correctly rounded + - * /
/// sqrt. Internal to Shapes; the standard distributions and libm's log, sin and cos differ between libraries.
#pragma once

#include "Core/Base/Vector3.h"

#include <cmath>
#include <cstdint>

namespace pointhaptics
{
namespace detail
{

/// xoshiro256** seeded by splitmix64 (Blackman and Vigna). One thread at a time.
class PortableRandom
{
public:
  explicit PortableRandom(std::uint64_t seed) noexcept
  {
    for (std::uint64_t& word : state_)
    {
      seed += 0x9e3779b97f4a7c15u;
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      word = z ^ (z >> 31);
    }
  }
  std::uint64_t bits() noexcept
  {
    const std::uint64_t result = rotated(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotated(state_[3], 45);
    return result;
  }
  /// [0, 1), multiples of 2^-53.
  double uniform() noexcept { return double(bits() >> 11) * 0x1p-53; }
  double uniform(double low, double high) noexcept { return low + (high - low) * uniform(); }
  /// Uniform on the unit circle: (cos, sin) of a random angle.
  void circle(double& x, double& y) noexcept
  {
    const double r2 = disc(x, y);
    const double scale = 1.0 / std::sqrt(r2);
    x *= scale;
    y *= scale;
  }
  /// Uniform on the unit sphere (Marsaglia 1972).
  Vec3 sphere() noexcept
  {
    double x = 0.0, y = 0.0;
    const double r2 = disc(x, y);
    const double root = 2.0 * std::sqrt(1.0 - r2);
    return { x * root, y * root, 1.0 - 2.0 * r2 };
  }
  /// Standard normal (Marsaglia's polar method; the second number of each pair is thrown away).
  double gaussian() noexcept
  {
    double x = 0.0, y = 0.0;
    const double r2 = disc(x, y);
    return x * std::sqrt(-2.0 * logarithm(r2) / r2);
  }

private:
  static std::uint64_t rotated(std::uint64_t x, int by) noexcept { return (x << by) | (x >> (64 - by)); }
  /// A point of the open unit disc without its centre; @return its squared radius.
  double disc(double& x, double& y) noexcept
  {
    for (;;)
    {
      x = uniform(-1.0, 1.0);
      y = uniform(-1.0, 1.0);
      const double r2 = x * x + y * y;
      if (r2 < 1.0 && r2 > 0.0)
      {
        return r2;
      }
    }
  }
  /// ln x for normal x > 0, relative error below 1e-15: x = m 2^e, ln m = 2 atanh((m - 1)/(m + 1)).
  static double logarithm(double x) noexcept
  {
    int exponent = 0;
    double m = std::frexp(x, &exponent);
    if (m < 0.70710678118654752)
    {
      m *= 2.0;
      --exponent;
    }
    const double s = (m - 1.0) / (m + 1.0);
    const double s2 = s * s;
    double sum = 0.0;
    for (int k = 23; k >= 1; k -= 2)
    {
      sum = sum * s2 + 1.0 / k;
    }
    return 2.0 * s * sum + exponent * 0.69314718055994531;
  }

  std::uint64_t state_[4];
};

} // namespace detail
} // namespace pointhaptics
