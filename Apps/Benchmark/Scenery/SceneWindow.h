/// @file
/// The viewer's scene in a window off the screen: what the benchmarks of the picture share.
#pragma once

#include "ViewScene.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <string>

namespace pointhaptics
{
namespace app
{

/// GUI thread only; needs a display.
class SceneWindow
{
public:
  SceneWindow() = default;
  ~SceneWindow();
  SceneWindow(const SceneWindow&) = delete;
  SceneWindow& operator=(const SceneWindow&) = delete;

  /// Reads and resamples @p file and puts the camera in front of it; nothing is drawn yet. Call it once.
  /// False:
  /// @p message says why not.
  bool open(const std::string& file, int width, int height, std::string& message);

  ViewScene& scene() { return scene_; }
  const ViewScene& scene() const { return scene_; }
  vtkRenderWindow* window() { return window_; }

private:
  ViewScene scene_;
  vtkNew<vtkRenderWindow> window_;
};

} // namespace app
} // namespace pointhaptics
