/// @file
/// Numbers and variable length records of a LAS file.
#pragma once

#include "Bytes/StridedCopy.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// Writes @p value little-endian at @p offset. @pre it lies inside @p bytes.
template <typename T>
void putLittle(std::string& bytes, std::size_t offset, T value)
{
  std::memcpy(&bytes[offset], &value, sizeof(T));
  if (!kIsLittleEndianHost)
  {
    std::reverse(&bytes[offset], &bytes[offset] + sizeof(T));
  }
}

/// LAS's number for the type of an extra field, and for a VTK type.
int lasTypeCode(int type);

/// The header of a variable length record of @p size bytes. @p description: at most 32 bytes.
std::string lasRecordHeader(
  const std::string& user, int id, std::size_t size, std::string_view description = {});

} // namespace pointhaptics::io
