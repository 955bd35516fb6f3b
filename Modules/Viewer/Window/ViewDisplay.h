/// @file
/// The display that windows are drawn on. Asked before the first render window: VTK crashes without one.
#pragma once

#include "PointHapticsViewerModule.h" // For export macro

#include <array>
#include <cstdint>
#include <string>

namespace pointhaptics
{

/// True where a render window can be made and may draw @p points. Otherwise @p message says what is missing
/// and the cure. Keeps a connection to the X server until the program ends. GUI thread only.
POINTHAPTICSVIEWER_EXPORT bool displayIsAvailable(std::string& message, std::int64_t points = 0);

/// Width and height of the screen, pixels; 0 before displayIsAvailable() was true, and where they are not
/// known. A render window would open a connection of its own for this, and close it before the interactor has
/// read its last event. GUI thread only.
POINTHAPTICSVIEWER_EXPORT std::array<int, 2> screenSize();

} // namespace pointhaptics
