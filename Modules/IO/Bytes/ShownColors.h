/// @file
/// Colours that are no bytes, as the bytes that are shown.
#pragma once

#include "IO/SharedReading.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

namespace pointhaptics::io
{

/// An array "RGB" of bytes made of @p colors: integers up to 255 are bytes, of those up to 65535 the high
/// byte is taken; other numbers are 0..1, or 0..255 or 0..65535 where one is larger. NaN is 0. The largest
/// value is that of all ranks, where @p shared is there (collective). Null where a value is below 0 or
/// larger: these are no colours.
vtkSmartPointer<vtkDataArray> shownColors(vtkDataArray* colors, SharedReading* shared);

} // namespace pointhaptics::io
