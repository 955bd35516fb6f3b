/// @file
/// How large texts must be on a screen, or in a picture.
#pragma once

#include "PointHapticsInteractionModule.h" // For export macro

class vtkRenderWindow;

namespace pointhaptics
{

/// 1 on a screen of the usual 96 dots per inch. On X as the desktop says (Xft.dpi), on other systems as VTK
/// finds out; off the screen by the height of the picture, 1 up to 1080 pixels. 1 to 4.
POINTHAPTICSINTERACTION_EXPORT double screenScale(vtkRenderWindow* window);

/// Texts of @p window are screenScale() times @p factor times as large as VTK's: by its dots per inch.
POINTHAPTICSINTERACTION_EXPORT void applyTextScale(vtkRenderWindow* window, double factor);

/// What comes after Xft.dpi: in the resources @p text of an X server; 0: nothing that is a number.
POINTHAPTICSINTERACTION_EXPORT double dotsPerInchOf(const char* text);

} // namespace pointhaptics
