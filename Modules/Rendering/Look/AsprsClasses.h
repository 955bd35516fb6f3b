/// @file
/// Names of the numbers in the array "Classification".
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

#include <string>

namespace pointhaptics
{

/// Name and colour of a class.
struct AsprsClass
{
  const char* name; ///< Static storage.
  double color[3];  ///< Red, green and blue, 0 to 1, for a dark ground.
};

/// Returns name and colour of a class, such as "ground" for 2: ASPRS, LAS Specification 1.4 R15, table 17.
/// "reserved" and "user defined" stand where it leaves them so, "no class" below 0 and above 255. The colours
/// are the project's choice; other classes are grey. Any thread.
POINTHAPTICSRENDERING_EXPORT const AsprsClass& asprsClass(int number);

/// True if @p array names the classes of LiDAR points: "Classification" in any case.
POINTHAPTICSRENDERING_EXPORT bool holdsAsprsClasses(const std::string& array);

} // namespace pointhaptics
