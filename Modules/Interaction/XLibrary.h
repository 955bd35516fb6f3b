/// @file
/// Functions of the X library, which VTK has in the process: by name, without a dependency of our own.
#pragma once

#include "PointHapticsInteractionModule.h" // For export macro

class vtkRenderWindow;

namespace pointhaptics
{

/// The function @p name of libX11, to be cast to its type; null where there is none, as on systems without X.
/// Any thread.
POINTHAPTICSINTERACTION_EXPORT void* findXFunction(const char* name);

/// The Display of @p window; null where it is not one on an X server.
POINTHAPTICSINTERACTION_EXPORT void* xDisplayOf(vtkRenderWindow* window);

} // namespace pointhaptics
