/// @file
/// Numbers in little-endian records.
#pragma once

#include "Bytes/StridedCopy.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace pointhaptics::io
{

/// Little-endian number at @p at, which need not be aligned.
template <typename T>
T loadLittle(const char* at) noexcept
{
  T value;
  if constexpr (kIsLittleEndianHost)
  {
    std::memcpy(&value, at, sizeof(T));
  }
  else
  {
    char raw[sizeof(T)];
    std::reverse_copy(at, at + sizeof(T), raw);
    std::memcpy(&value, raw, sizeof(T));
  }
  return value;
}

/// Number at @p offset. @pre it lies inside @p bytes.
template <typename T>
T numberAt(std::string_view bytes, std::size_t offset) noexcept
{
  return loadLittle<T>(bytes.data() + offset);
}

/// Writes @p value little-endian to @p at, which need not be aligned.
template <typename T>
void storeLittle(T value, char* at) noexcept
{
  std::memcpy(at, &value, sizeof(T));
  if constexpr (!kIsLittleEndianHost)
  {
    std::reverse(at, at + sizeof(T));
  }
}

inline std::uint8_t byteAt(const char* record, std::size_t offset)
{
  return static_cast<std::uint8_t>(record[offset]);
}

} // namespace pointhaptics::io
