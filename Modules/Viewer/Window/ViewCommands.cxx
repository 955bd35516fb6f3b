// Commands of the viewer beside those of vtkInteractorStyleHaptic: one entry a command.
#include "Gesture.h"
#include "HapticViewer.h"
#include "PictureControls.h"
#include "ViewWindow.h"

#include <vtkNew.h>

namespace pointhaptics
{

void ViewWindow::addCommands(CommandRegistry& commands, ViewWindow* window)
{
  const WatchedPointer<ViewWindow> self(window); // a host may keep the style for longer
  const auto isOpen = [self] { return bool(self); };
  const auto hasOtherFiles = [self] { return self && self->files_.size() > 1; };
  const auto keepsSettings = [self] { return self && self->observer_.writeState; };
  const std::function<ViewWindow*()> there = [self] { return self.get(); };
  const auto call = [&there](void (ViewWindow::*action)()) { return whileThere(there, action); };
  PictureControls::addCommands(commands,
    [self]() -> PictureControls*
    {
      ViewWindow* open = self.get();
      return open ? &open->controls_ : nullptr;
    });
  ClipBoxTool::addCommands(commands,
    [self]() -> ClipBoxTool*
    {
      ViewWindow* open = self.get();
      return open ? &open->clipping_ : nullptr;
    });
  using Window = ViewWindow;
  commands.add({ "pivot", kDoubleClick, "Look", "turn about the point under the mouse",
    call(&Window::setPivot), isOpen });
  commands.add({ "axes", "a", "Show", "axes and bounds", call(&Window::toggleAxes), isOpen });
  commands.add(
    { "figure", "o", "Show", "figure: cloud, cube, touch only", call(&Window::toggleFigure), isOpen });
  commands.add({ "colors", "m", "Show", "colour by the next array", call(&Window::showNextColors), isOpen });
  commands.add(
    { "felt", "d", "Show", "voxel means that are felt, or the points", call(&Window::toggleFelt), isOpen });
  commands.add(
    { "ambient", "l", "Show", "ambient light from the normals", call(&Window::toggleAmbient), isOpen });
  commands.add(
    { "next-file", "n", "Program", "next, previous file", call(&Window::showNextFile), hasOtherFiles });
  commands.add({ "previous-file", "b", "Program", "next, previous file", call(&Window::showPreviousFile),
    hasOtherFiles });
  commands.bind("undo-model", "Ctrl+z");
  commands.add(
    { "take-unit", "u", "Show", "take the unit the file seems to have", call(&Window::toggleUnit), isOpen });
  commands.add(
    { "measure", "D", "Show", "measure: click on two points", call(&Window::toggleMeasuring), isOpen });
  commands.add({ "profile", "F6", "Show", "height profile along the measured line",
    call(&Window::toggleProfile), isOpen });
  commands.add(
    { "turn-up", "F7", "Look", "another axis points up, kept for the file", call(&Window::turnUp), isOpen });
  commands.add(
    { "save-part", "F12", "Program", "save the part that is shown", call(&Window::savePart), isOpen });
  commands.add({ "sound", "F8", "Hand", "hear the touch", call(&Window::toggleSound), isOpen });
  commands.add({ "screenshot", "s", "Program", "screenshot", call(&Window::writeScreenshot), isOpen });
  commands.add({ "write-settings", "w", "Program", "write the settings to a file",
    call(&Window::writeSettings), keepsSettings });
  commands.add(
    { "record", "j", "Program", "start, stop recording the touch", call(&Window::toggleRecording), isOpen });
  commands.add({ "leave", "Escape", "Program",
    "leave reading, help, tools, hand mode, full screen; then quit", call(&Window::leave), isOpen });
  commands.bind("hand-mode", "f");
  commands.add(
    { "marker", "space", "Program", "set a marker in the recording", call(&Window::setMarker), isOpen });
  commands.addNote("Program", "files dropped on the window", "open them");
}

CommandRegistry HapticViewer::commands()
{
  vtkNew<vtkInteractorStyleHaptic> style;
  ViewWindow::addCommands(style->GetCommands(), nullptr);
  return style->GetCommands().described();
}

} // namespace pointhaptics
