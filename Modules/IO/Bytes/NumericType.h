/// @file
/// VTK's scalar types as C++ types of known size.
#pragma once

#include "vtkSetGet.h"
#include "vtkType.h"
#include "vtkTypeTraits.h"

#include <cstdint>
#include <type_traits>

namespace pointhaptics::io
{

/// The type of numbers of @p size bytes, of the kind 'f' floating, 'i' integer or 'u' unsigned integer;
/// VTK_VOID where there is none.
constexpr int typeOfKind(char kind, unsigned long long size)
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

/// The type with a fixed size that stands for @p vtkType: VTK_LONG and VTK_ID_TYPE become a 32 or 64 bit
/// integer type, VTK_CHAR the signed one. Types without numbers (strings, bits) give VTK_VOID.
constexpr int fixedSizeType(int vtkType)
{
  switch (vtkType == VTK_CHAR ? VTK_SIGNED_CHAR : vtkType)
  {
    vtkTemplateMacro(return typeOfKind(std::is_floating_point_v<VTK_TT> ? 'f'
        : std::is_signed_v<VTK_TT>                                      ? 'i'
                                                                        : 'u',
      sizeof(VTK_TT)));
  }
  return VTK_VOID;
}

/// Calls @p f with a value of the C++ type of @p vtkType: withType(VTK_FLOAT, [](auto zero) { ... }).
/// Types without numbers do nothing.
template <typename F>
void withType(int vtkType, F&& f)
{
  const int type = fixedSizeType(vtkType);
  const auto callFor = [&](auto... zeros)
  { ((type == fixedSizeType(vtkTypeTraits<decltype(zeros)>::VTK_TYPE_ID) ? f(zeros) : void()), ...); };
  callFor(std::int8_t{}, std::uint8_t{}, std::int16_t{}, std::uint16_t{}, std::int32_t{}, std::uint32_t{},
    std::int64_t{}, std::uint64_t{}, float{}, double{});
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
