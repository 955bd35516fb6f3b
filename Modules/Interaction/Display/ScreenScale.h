/// @file
/// Size of texts on a screen, or in a picture.
#pragma once

#include "PointHapticsInteractionModule.h" // For export macro

class vtkRenderWindow;

namespace pointhaptics
{

/// Scale of texts in @p window, 1 to 4; 1 on a screen of the usual 96 dots per inch. On X it follows the
/// desktop (Xft.dpi), or else scaleOfScreen(), as an X server claims 96 dots per inch for any screen. On
/// other systems it follows VTK. Off the screen it follows the height of the picture: 1 up to 1080 pixels.
POINTHAPTICSINTERACTION_EXPORT double screenScale(vtkRenderWindow* window);

/// Makes texts of @p window screenScale() times @p factor times as large as VTK's, by its dots per inch.
POINTHAPTICSINTERACTION_EXPORT void applyTextScale(vtkRenderWindow* window, double factor);

/// Scale in a window of @p windowLines on a screen of @p screenLines whose size in inches is not known. It is
/// 1 on screens below 1440 lines, on others lines over 1080, but leaves room for the texts in the window.
POINTHAPTICSINTERACTION_EXPORT double scaleOfScreen(int screenLines, int windowLines);

/// Pixels of a new window along an axis, of @p wanted. If the @p screen has less, the window and its frame
/// fit the screen. @p screen 0: not known.
POINTHAPTICSINTERACTION_EXPORT int lengthOnScreen(int wanted, int screen);

/// Number behind Xft.dpi: in the resources @p text of an X server; 0: it is missing or no number.
POINTHAPTICSINTERACTION_EXPORT double dotsPerInchOf(const char* text);

} // namespace pointhaptics
