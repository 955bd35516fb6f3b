#include "Bytes/StridedCopy.h"

#include "Bytes/NumericType.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace pointhaptics::io
{

namespace
{

template <typename T>
T load(const char* from, bool swap) noexcept
{
  char raw[sizeof(T)];
  std::memcpy(raw, from, sizeof(T));
  if (swap)
  {
    std::reverse(raw, raw + sizeof(T));
  }
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

template <typename From, typename To>
void copyColumn(ConstColumnView source, ColumnView target, vtkIdType count, bool swap) noexcept
{
  const char* from = source.first;
  char* to = target.first;
  for (vtkIdType i = 0; i < count; ++i, from += source.stride, to += target.stride)
  {
    const To value = static_cast<To>(load<From>(from, swap));
    std::memcpy(to, &value, sizeof(To));
  }
}

/// Reads the integer that @p text begins with. @return false where its number has a point or an exponent.
template <typename T>
bool isWhole(std::string_view text, T& value)
{
  text.remove_prefix(text.substr(0, 1) == "+" ? 1 : 0);
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() &&
    (last == text.data() + text.size() || std::isspace(static_cast<unsigned char>(*last)));
}

} // namespace

void copyStrided(ConstColumnView source, ColumnView target, vtkIdType count, bool swapSource) noexcept
{
  withType(source.type,
    [&](auto from)
    {
      withType(target.type,
        [&](auto to)
        {
          if (swapSource)
          {
            copyColumn<decltype(from), decltype(to)>(source, target, count, true);
          }
          else
          {
            copyColumn<decltype(from), decltype(to)>(source, target, count, false);
          }
        });
    });
}

bool storeNumber(ColumnView target, vtkIdType row, double value, std::string_view digits) noexcept
{
  bool stored = true;
  withType(target.type,
    [&](auto zero)
    {
      using T = decltype(zero);
      T converted{};
      bool isExact = false;
      if constexpr (std::is_integral_v<T>)
      {
        isExact = std::abs(value) >= 0x1p53 && isWhole(digits, converted);
        // The upper bound as a power of two: max() itself is not a double for 64 bit integers.
        const double above = std::ldexp(1.0, std::numeric_limits<T>::digits);
        const double below = std::is_signed_v<T> ? -above : 0.0;
        stored = isExact || (value >= below && value < above && value == std::floor(value));
      }
      if (stored)
      {
        converted = isExact ? converted : static_cast<T>(value);
        std::memcpy(target.first + row * target.stride, &converted, sizeof(T));
      }
    });
  return stored;
}

} // namespace pointhaptics::io
