#include "Bytes/StridedCopy.h"

#include "Bytes/NumericType.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
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

bool storeNumber(ColumnView target, vtkIdType row, double value) noexcept
{
  bool stored = true;
  withType(target.type,
    [&](auto zero)
    {
      using T = decltype(zero);
      if constexpr (std::is_integral_v<T>)
      {
        // The upper bound as a power of two: max() itself is not a double for 64 bit integers.
        const double above = std::ldexp(1.0, std::numeric_limits<T>::digits);
        const double below = std::is_signed_v<T> ? -above : 0.0;
        stored = value >= below && value < above && value == std::floor(value);
      }
      if (stored)
      {
        const T converted = static_cast<T>(value);
        std::memcpy(target.first + row * target.stride, &converted, sizeof(T));
      }
    });
  return stored;
}

} // namespace pointhaptics::io
