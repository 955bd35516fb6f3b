/// @file
/// A non-owning view of an array of attributes.
#pragma once

#include "Core/Base/ScalarType.h"

#include <cstdint>

namespace pointhaptics
{

/// An array owned by the caller: tuples of components.
struct AttributeView
{
  const void* values = nullptr;
  ScalarType type = ScalarType::Float;
  int components = 1;
  std::int64_t tuples = 0;
  std::int64_t stride = 0; ///< Bytes from one tuple to the next; 0: none lie between.
};

} // namespace pointhaptics
