/// @file
/// Functions of the X library, which VTK has in the process: by name, without a dependency of our own.
#pragma once

#include "PointHapticsInteractionModule.h" // For export macro

class vtkRenderWindow;

namespace pointhaptics
{

/// True if windows are those of an X server.
#if defined(__unix__) && !defined(__APPLE__)
constexpr bool kUsesX = true;
#else
constexpr bool kUsesX = false;
#endif

/// The function @p name of libX11, and the same as its type; null where there is none, as on systems without
/// X. Any thread.
POINTHAPTICSINTERACTION_EXPORT void* findXFunction(const char* name);
template <typename Function>
Function xFunction(const char* name)
{
  return reinterpret_cast<Function>(findXFunction(name));
}

/// The Display of @p window; null where it is not one on an X server.
POINTHAPTICSINTERACTION_EXPORT void* xDisplayOf(vtkRenderWindow* window);

/// Moves the pointer to the display position (@p x, @p y) of @p window, pixels from the lower left. Nothing
/// happens on a window that is not on the screen, and on systems where VTK does not know how. GUI thread
/// only.
void movePointer(vtkRenderWindow* window, int x, int y);

} // namespace pointhaptics
