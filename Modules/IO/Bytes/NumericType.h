/// @file
/// VTK's scalar types as C++ types of known size.
#pragma once

#include "vtkType.h"

#include <cstdint>
#include <type_traits>

namespace pointhaptics::io
{

/// The type with a fixed size that stands for @p vtkType: VTK_LONG and VTK_ID_TYPE become a 32 or 64 bit
/// integer type, VTK_CHAR the signed one. Types without numbers (strings, bits) give VTK_VOID.
inline int fixedSizeType(int vtkType)
{
  switch (vtkType)
  {
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
      return VTK_TYPE_INT8;
    case VTK_UNSIGNED_CHAR:
      return VTK_TYPE_UINT8;
    case VTK_SHORT:
      return VTK_TYPE_INT16;
    case VTK_UNSIGNED_SHORT:
      return VTK_TYPE_UINT16;
    case VTK_INT:
      return VTK_TYPE_INT32;
    case VTK_UNSIGNED_INT:
      return VTK_TYPE_UINT32;
    case VTK_LONG:
      return sizeof(long) == 8 ? VTK_TYPE_INT64 : VTK_TYPE_INT32;
    case VTK_UNSIGNED_LONG:
      return sizeof(long) == 8 ? VTK_TYPE_UINT64 : VTK_TYPE_UINT32;
    case VTK_LONG_LONG:
      return VTK_TYPE_INT64;
    case VTK_UNSIGNED_LONG_LONG:
      return VTK_TYPE_UINT64;
    case VTK_ID_TYPE:
      return sizeof(vtkIdType) == 8 ? VTK_TYPE_INT64 : VTK_TYPE_INT32;
    case VTK_FLOAT:
      return VTK_FLOAT;
    case VTK_DOUBLE:
      return VTK_DOUBLE;
    default:
      return VTK_VOID;
  }
}

/// The type of numbers of @p size bytes, of the kind 'f' floating, 'i' integer or 'u' unsigned integer;
/// VTK_VOID where there is none.
inline int typeOfKind(char kind, unsigned long long size)
{
  constexpr int kTypes[][4] = { { VTK_TYPE_INT8, VTK_TYPE_UINT8, VTK_VOID, 1 },
    { VTK_TYPE_INT16, VTK_TYPE_UINT16, VTK_VOID, 2 }, { VTK_TYPE_INT32, VTK_TYPE_UINT32, VTK_FLOAT, 4 },
    { VTK_TYPE_INT64, VTK_TYPE_UINT64, VTK_DOUBLE, 8 } };
  int type = VTK_VOID;
  for (const auto& row : kTypes)
  {
    const int found = kind == 'i' ? row[0] : kind == 'u' ? row[1] : kind == 'f' ? row[2] : VTK_VOID;
    type = static_cast<unsigned long long>(row[3]) == size ? found : type;
  }
  return type;
}

/// Calls @p f with a value of the C++ type of @p vtkType: withType(VTK_FLOAT, [](auto zero) { ... }).
/// Types without numbers do nothing.
template <typename F>
void withType(int vtkType, F&& f)
{
  switch (fixedSizeType(vtkType))
  {
    case VTK_TYPE_INT8:
      return f(std::int8_t{});
    case VTK_TYPE_UINT8:
      return f(std::uint8_t{});
    case VTK_TYPE_INT16:
      return f(std::int16_t{});
    case VTK_TYPE_UINT16:
      return f(std::uint16_t{});
    case VTK_TYPE_INT32:
      return f(std::int32_t{});
    case VTK_TYPE_UINT32:
      return f(std::uint32_t{});
    case VTK_TYPE_INT64:
      return f(std::int64_t{});
    case VTK_TYPE_UINT64:
      return f(std::uint64_t{});
    case VTK_FLOAT:
      return f(float{});
    case VTK_DOUBLE:
      return f(double{});
    default:
      return;
  }
}

/// Bytes of one value of @p vtkType; 0 for types without numbers.
inline int sizeOfType(int vtkType)
{
  int size = 0;
  withType(vtkType, [&](auto zero) { size = static_cast<int>(sizeof(zero)); });
  return size;
}

inline bool isFloatingType(int vtkType)
{
  return vtkType == VTK_FLOAT || vtkType == VTK_DOUBLE;
}

/// True if a float would lose digits of @p vtkType.
inline bool needsDouble(int vtkType)
{
  return vtkType != VTK_FLOAT && sizeOfType(vtkType) >= 4;
}

} // namespace pointhaptics::io
