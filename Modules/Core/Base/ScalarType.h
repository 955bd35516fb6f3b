/// @file
/// The types of numbers that arrays have.
#pragma once

#include <cstdint>

namespace pointhaptics
{

/// Integers of up to 32 bits come first.
enum class ScalarType
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float,
  Double,
};

/// Calls function(T()) with the C++ type of a scalar type.
template <typename Function>
void withType(ScalarType type, Function&& function)
{
  switch (type)
  {
    case ScalarType::Int8:
      return function(std::int8_t());
    case ScalarType::UInt8:
      return function(std::uint8_t());
    case ScalarType::Int16:
      return function(std::int16_t());
    case ScalarType::UInt16:
      return function(std::uint16_t());
    case ScalarType::Int32:
      return function(std::int32_t());
    case ScalarType::UInt32:
      return function(std::uint32_t());
    case ScalarType::Int64:
      return function(std::int64_t());
    case ScalarType::UInt64:
      return function(std::uint64_t());
    case ScalarType::Float:
      return function(float());
    case ScalarType::Double:
      return function(double());
  }
}

inline std::int64_t bytesOf(ScalarType type)
{
  std::int64_t bytes = 0;
  withType(type, [&](auto example) { bytes = std::int64_t(sizeof example); });
  return bytes;
}

} // namespace pointhaptics
