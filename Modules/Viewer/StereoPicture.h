/// @file
/// Pictures for two eyes.
#pragma once

#include "PointHapticsViewerModule.h" // For export macro

#include <string>
#include <vector>

class vtkRenderer;
class vtkRenderWindow;

namespace pointhaptics
{

/// Names of stereo modes: none, then VTK's ways to show two pictures in one, then crystal-eyes, which needs a
/// screen with buffers for both.
POINTHAPTICSVIEWER_EXPORT const std::vector<std::string>& stereoNames();

/// Stereo mode that the key chooses first, and the one that needs quad buffers.
constexpr const char* kUsualStereo = "anaglyph";
constexpr const char* kQuadBuffers = "crystal-eyes";

/// Shows @p window as one of stereoNames() from its next frame on. False: it has no buffers for that, and
/// shows one picture.
bool applyStereo(vtkRenderWindow* window, const std::string& name);

/// Tells the camera of @p renderer, before each frame, if its window shows two pictures. VTK 9.1 forgets that
/// where a renderer has a render pass.
void tellStereo(vtkRenderer* renderer);

} // namespace pointhaptics
