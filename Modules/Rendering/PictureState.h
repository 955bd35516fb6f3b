/// @file
/// State of the picture that a renderer would draw, without drawing it: shows if a new picture is needed.
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

#include <vector>

class vtkProp;
class vtkRenderer;

namespace pointhaptics
{

/// True if @p prop is drawn over the finished picture: text (vtkActor2D) and marks (vtkOverlayActor).
POINTHAPTICSRENDERING_EXPORT bool isDrawnOver(vtkProp* prop);

/// Numbers that are equal for two pictures which show the same: camera, size, background, lights and all
/// props but those that are drawn over it. Brings the pipelines of visible actors up to date. GUI thread
/// only.
POINTHAPTICSRENDERING_EXPORT std::vector<double> pictureState(vtkRenderer* renderer);

} // namespace pointhaptics
