/// @file
/// Sums of doubles without any rounding, for the tests: one integer as wide as all doubles together.
#pragma once

#include <cmath>
#include <cstdint>

namespace pointhaptics
{
namespace trial
{

/// In units of 2^-1074, base 2^32.
class ExactSum
{
public:
  /// Adds a finite value so many times (less than 2^31, of either sign).
  void add(double value, std::int64_t times)
  {
    __extension__ typedef __int128 Wide;
    if (value == 0.0)
    {
      return;
    }
    int exponent;
    const double fraction = std::frexp(value, &exponent);
    // A denormal's last bits are zero in 53 bits: they may stand below the unit.
    Wide mantissa = Wide(std::ldexp(fraction, 53));
    int shift = exponent - 53 + 1074;
    for (; shift < 0; ++shift)
    {
      mantissa /= 2;
    }
    const Wide product = mantissa * times;
    const bool negative = product < 0;
    unsigned __int128 magnitude = (unsigned __int128)(negative ? -product : product) << (shift % 32);
    for (int limb = shift / 32; magnitude != 0; ++limb, magnitude >>= 32)
    {
      const auto digit = std::int64_t(std::uint32_t(magnitude));
      limbs_[limb] += negative ? -digit : digit;
    }
  }
  /// -1, 0, 1
  int sign() const
  {
    std::int64_t carry = 0;
    bool rest = false;
    for (const std::int64_t limb : limbs_)
    {
      const std::int64_t sum = limb + carry;
      carry = sum >> 32;
      rest = rest || std::uint32_t(sum) != 0;
    }
    return carry < 0 ? -1 : rest || carry > 0 ? 1 : 0;
  }
  /// @p mean is the sum over the count, each rounded once: half a unit in the last place of the quotient and
  /// as much of the sum, which may be a whole unit of the quotient.
  bool isMean(double mean, std::int64_t count) const
  {
    const auto neighbour = [mean](double side) { return std::nextafter(std::nextafter(mean, side), side); };
    return std::isfinite(mean) && difference(neighbour(-INFINITY), count) >= 0 &&
      difference(neighbour(INFINITY), count) <= 0;
  }

private:
  int difference(double bound, std::int64_t count) const
  {
    if (std::isinf(bound))
    {
      return bound < 0.0 ? 1 : -1;
    }
    ExactSum rest = *this;
    rest.add(bound, -count);
    return rest.sign();
  }

  static constexpr int kLimbs = 72;
  std::int64_t limbs_[kLimbs] = {};
};

} // namespace trial
} // namespace pointhaptics
