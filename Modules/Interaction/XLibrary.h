/// @file
/// Windows on an X server, beyond what VTK says of them. Elsewhere these functions know nothing.
#pragma once

#include "PointHapticsInteractionModule.h" // For export macro

class vtkRenderWindow;

namespace pointhaptics
{

/// The Display of @p window; null where it is not one on an X server.
POINTHAPTICSINTERACTION_EXPORT void* xDisplayOf(vtkRenderWindow* window);

/// The resources of the desktop, such as "Xft.dpi: 96", on the server of @p window; null: there are none.
const char* desktopResources(vtkRenderWindow* window);

/// Moves the pointer to the display position (@p x, @p y) of @p window, pixels from the lower left. Nothing
/// happens on a window that is not on the screen, and on systems where VTK does not know how. GUI thread
/// only.
void movePointer(vtkRenderWindow* window, int x, int y);

} // namespace pointhaptics
