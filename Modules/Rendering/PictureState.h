/// @file
/// What a renderer would draw, without drawing it: for seeing whether a picture has to be made anew.
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

#include <vector>

class vtkRenderer;

namespace pointhaptics
{

/// Camera, size, background, lights and all props but those of text (vtkActor2D): numbers that are equal for
/// two pictures which show the same. Brings the pipelines of visible actors up to date. GUI thread only.
POINTHAPTICSRENDERING_EXPORT std::vector<double> pictureState(vtkRenderer* renderer);

} // namespace pointhaptics
