/// @file
/// Names of the numbers in the array "Classification".
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

#include <string>

namespace pointhaptics
{

/// How a class is named and drawn.
struct AsprsClass
{
  const char* name; ///< Static storage.
  double color[3];  ///< Red, green and blue, 0 to 1, for a dark ground.
};

/// "ground" and its colour for 2: the class of ASPRS, LAS Specification 1.4 R15, table 17; "reserved" and
/// "user defined" where it leaves them so, "no class" below 0 and above 255. The colours are our choice;
/// those without one are grey. Any thread.
POINTHAPTICSRENDERING_EXPORT const AsprsClass& asprsClass(int number);

/// True if @p array names the classes of LiDAR points: "Classification" in any case.
POINTHAPTICSRENDERING_EXPORT bool holdsAsprsClasses(const std::string& array);

} // namespace pointhaptics
