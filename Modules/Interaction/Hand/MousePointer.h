/// @file
/// Moves the mouse pointer, which VTK 9.1 does not do on X.
#pragma once

class vtkRenderWindow;

namespace pointhaptics
{

/// Moves the pointer to the display position (@p x, @p y) of @p window, pixels from the lower left. Nothing
/// happens on a window that is not on the screen, and on systems where VTK does not know how. GUI thread
/// only.
void movePointer(vtkRenderWindow* window, int x, int y);

} // namespace pointhaptics
