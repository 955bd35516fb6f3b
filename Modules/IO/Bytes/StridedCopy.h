/// @file
/// Copies one column of numbers between records and arrays, converting type and byte order on the way.
#pragma once

#include "vtkType.h"

#include <cstddef>
#include <string_view>

namespace pointhaptics::io
{

/// True if this machine stores the least significant byte first.
#if defined(__BYTE_ORDER__)
constexpr bool kIsLittleEndianHost = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
#else
constexpr bool kIsLittleEndianHost = true;
#endif

/// A column of values: the first one at @p first, the next @p stride bytes on. Need not be aligned.
struct ConstColumnView
{
  const char* first = nullptr;
  std::ptrdiff_t stride = 0;
  int type = 0; ///< VTK type
};

struct ColumnView
{
  char* first = nullptr;
  std::ptrdiff_t stride = 0;
  int type = 0; ///< VTK type

  ColumnView fromRow(vtkIdType row) const { return { first + row * stride, stride, type }; }
};

/// target[i] = source[i] for i in 0..count-1, as by static_cast (a value outside an integer target's range
/// must not occur). @p swapSource reverses the bytes of each value read.
void copyStrided(
  ConstColumnView source, ColumnView target, vtkIdType count, bool swapSource = false) noexcept;

/// target[row] = value. @return false when an integer target cannot hold @p value exactly; then nothing is
/// written. @p digits: a text that begins with the number, of which an integer that no double holds takes
/// every digit.
bool storeNumber(ColumnView target, vtkIdType row, double value, std::string_view digits = {}) noexcept;

} // namespace pointhaptics::io
