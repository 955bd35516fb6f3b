/// @file
/// Is there a display to draw on? Asked before the first render window: VTK crashes without one.
#pragma once

#include "PointHapticsViewerModule.h" // For export macro

#include <string>

namespace pointhaptics
{

/// True where a render window can be made. Otherwise @p message says what is missing and the cure. Keeps a
/// connection to the X server until the program ends. GUI thread only.
POINTHAPTICSVIEWER_EXPORT bool displayIsAvailable(std::string& message);

} // namespace pointhaptics
