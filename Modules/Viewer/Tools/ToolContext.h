/// @file
/// The parts of the window that its tools work on.
#pragma once

#include <functional>
#include <string>

class vtkRenderWindow;
class vtkRenderWindowInteractor;

namespace pointhaptics
{

class CommandRegistry;
class ViewScene;
struct HapticViewerOptions;

/// All must outlive the tools, the interactor aside.
struct ToolContext
{
  ViewScene& scene;
  HapticViewerOptions& options; ///< Kept up to date.
  CommandRegistry& commands;
  vtkRenderWindow* window;
  vtkRenderWindowInteractor* interactor;
  std::function<void()> clipped;               ///< To be called when other points are to be felt.
  std::function<void(const std::string&)> say; ///< Reports each change to the person.
};

} // namespace pointhaptics
