/// @file
/// Integers in the order of numbers. Internal linkage: sources of several instruction sets include it.
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

namespace pointhaptics
{
namespace
{

/// Turns the order of negative numbers around, and back. Without a branch: signs are unpredictable.
template <typename Key>
inline Key turnedNegative(Key key)
{
  constexpr Key kMost = std::numeric_limits<Key>::max();
  return Key(key ^ ((key >> (8 * sizeof(Key) - 1)) & kMost));
}

/// Key of the first negative number: 64-bit integers with a sign are taken as ones without.
constexpr std::uint64_t kFirstNegative = std::uint64_t(1) << 63;

/// An integer of at most 63 bits and a sign for each value, in the order of the values. Of floating-point
/// numbers NaN is the largest, and both zeros are one.
template <typename T>
inline auto orderedKey(T value)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    constexpr T kNaN = std::numeric_limits<T>::quiet_NaN();
    value = value != value ? kNaN : value + T(0);
    std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t> key;
    __builtin_memcpy(&key, &value, sizeof key);
    return turnedNegative(key);
  }
  else if constexpr (std::is_same_v<T, std::uint64_t>)
  {
    return std::int64_t(value - kFirstNegative);
  }
  else
  {
    return value;
  }
}

/// The value of a key: NaN for all NaNs, +0 for both zeros.
template <typename T>
inline T valueOfKey(std::int64_t key)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    const auto bits = turnedNegative(decltype(orderedKey(T()))(key));
    T value;
    __builtin_memcpy(&value, &bits, sizeof value);
    return value;
  }
  else if constexpr (std::is_same_v<T, std::uint64_t>)
  {
    return std::uint64_t(key) + kFirstNegative;
  }
  else
  {
    return T(key);
  }
}

}
} // namespace pointhaptics
