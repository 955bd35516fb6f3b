/// @file
/// Pictures off the screen, with the touch along a hand path.
#pragma once

#include "HapticViewerOptions.h"

#include "Haptics/ServoLoop.h"

#include <array>
#include <functional>
#include <optional>
#include <string>

class vtkCamera;
class vtkRenderWindow;

namespace pointhaptics
{

/// Renders @p window by @p render and writes the picture as PNG. @p transparent: without the background; the
/// window is rendered over black and over white, and pixels that are alike are opaque. False: @p message says
/// why not.
bool writePicture(vtkRenderWindow* window, const std::function<void()>& render, bool transparent,
  const std::string& fileName, std::string& message);

/// As writePicture(), in @p width by @p height pixels, whatever the size of @p window. Its renderers are in
/// another window meanwhile, off the screen. The picture shows at least what @p window does, by @p camera. @p
/// render is given the window to render.
bool writePictureOfSize(vtkRenderWindow* window, vtkCamera* camera, const std::array<int, 2>& size,
  const std::function<void(vtkRenderWindow*)>& render, bool transparent, const std::string& fileName,
  std::string& message);

class ViewScene;

/// Writes a PNG of @p scene, which must be built, with the touch @p shown, if there is one. Needs a display.
bool makePicture(ViewScene& scene, const HapticViewerOptions& options, const HapticViewerObserver& observer,
  const std::optional<ServoSample>& shown, const std::string& fileName, std::string& message);

} // namespace pointhaptics
