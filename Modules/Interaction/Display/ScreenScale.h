/// @file
/// Size of texts on a screen, or in a picture.
#pragma once

#include "PointHapticsInteractionModule.h" // For export macro

class vtkRenderWindow;

namespace pointhaptics
{

/// 1 on a screen of the usual 96 dots per inch. On X as the desktop says (Xft.dpi), where it says nothing
/// scaleOfScreen(): an X server tells 96 dots per inch of any screen. On other systems as VTK finds out; off
/// the screen by the height of the picture, 1 up to 1080 pixels. 1 to 4.
POINTHAPTICSINTERACTION_EXPORT double screenScale(vtkRenderWindow* window);

/// Texts of @p window are screenScale() times @p factor times as large as VTK's: by its dots per inch.
POINTHAPTICSINTERACTION_EXPORT void applyTextScale(vtkRenderWindow* window, double factor);

/// In a window of @p windowLines on a screen of @p screenLines, of which nobody knows how many inches: 1 on
/// screens below 1440 lines, on others lines over 1080, but not more than leaves room for the texts in the
/// window.
POINTHAPTICSINTERACTION_EXPORT double scaleOfScreen(int screenLines, int windowLines);

/// Pixels of a new window of which @p wanted are asked for: on an axis where the @p screen has less, what
/// leaves room for the window's frame; there the window would end beyond the screen. 0 of a screen: not
/// known.
POINTHAPTICSINTERACTION_EXPORT int lengthOnScreen(int wanted, int screen);

/// Number behind Xft.dpi: in the resources @p text of an X server; 0: it is missing or no number.
POINTHAPTICSINTERACTION_EXPORT double dotsPerInchOf(const char* text);

} // namespace pointhaptics
