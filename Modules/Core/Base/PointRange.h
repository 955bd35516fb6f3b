/// @file
/// Points that follow each other.
#pragma once

#include <cstdint>

namespace pointhaptics
{

/// Points [begin, end) of an array.
struct PointRange
{
  std::int64_t begin;
  std::int64_t end;
};

} // namespace pointhaptics
