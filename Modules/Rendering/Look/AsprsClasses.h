/// @file
/// What the numbers of the array "Classification" mean.
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

namespace pointhaptics
{

/// "ground" for 2: the class of ASPRS, LAS Specification 1.4 R15, table 17; "reserved" and "user defined"
/// where it leaves them so. Static storage. Any thread.
POINTHAPTICSRENDERING_EXPORT const char* asprsClassName(int number);

} // namespace pointhaptics
