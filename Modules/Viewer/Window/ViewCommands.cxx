// Commands of the viewer beside those of vtkInteractorStyleHaptic: one entry a command.
#include "Gesture.h"
#include "HapticViewer.h"
#include "ViewWindow.h"

namespace pointhaptics
{

void ViewWindow::addCommands(CommandRegistry& commands, ViewWindow* window)
{
  using Window = ViewWindow;
  const WatchedPointer<Window> self(window); // a host may keep the style for longer
  const auto there = [self] { return self.get(); };
  PictureControls::addCommands(commands, [self] { return self ? &self->controls_ : nullptr; });
  ClipBoxTool::addCommands(commands, [self] { return self ? &self->clipping_ : nullptr; });
  CommandGroup<Window> look(commands, "Look", there);
  CommandGroup<Window> show(commands, "Show", there);
  CommandGroup<Window> hand(commands, "Hand", there);
  CommandGroup<Window> program(commands, "Program", there);
  CommandGroup<Window> files(
    commands, "Program", there, [](Window& open) { return open.files_.areSeveral(); });
  CommandGroup<Window> settings(
    commands, "Program", there, [](Window& open) { return bool(open.observer_.writeState); });
  look.add("pivot", kDoubleClick, "turn about the point under the mouse", &Window::setPivot);
  show.add("axes", "a", "axes and bounds", &Window::toggleAxes);
  show.add("figure", "o", "figure: cloud, cube, touch only", &Window::toggleFigure);
  show.add("colors", "m", "colour by the next array", &Window::showNextColors);
  show.add("felt", "d", "voxel means that are felt, or the points", &Window::toggleFelt);
  show.add("ambient", "l", "ambient light from the normals", &Window::toggleAmbient);
  files.add("next-file", "n", "next, previous file", [](Window& open) { open.files_.step(+1); });
  files.add("previous-file", "b", "next, previous file", [](Window& open) { open.files_.step(-1); });
  commands.bind("undo-model", "Ctrl+z");
  show.add("take-unit", "u", "take the unit the file seems to have", &Window::toggleUnit);
  show.add("measure", "D", "measure: click on two points", [](Window& open) { open.measuring_.toggle(); });
  show.add(
    "profile", "F6", "height profile along the measured line", [](Window& open) { open.profile_.toggle(); });
  look.add(
    "turn-up", "F7", "another axis points up, kept for the file", [](Window& open) { open.files_.turnUp(); });
  program.add("save-part", "F12", "save the part that is shown", &Window::savePart);
  hand.add("sound", "F8", "hear the touch", &Window::toggleSound);
  program.add("screenshot", "s", "screenshot", &Window::writeScreenshot);
  settings.add("write-settings", "w", "write the settings to a file", &Window::writeSettings);
  program.add("record", "j", "start, stop recording the touch", &Window::toggleRecording);
  program.add(
    "leave", "Escape", "leave reading, help, tools, hand mode, full screen; then quit", &Window::leave);
  commands.bind("hand-mode", "f");
  program.add("marker", "space", "set a marker in the recording", &Window::setMarker);
  commands.addNote("Program", "files dropped on the window", "open them");
}

CommandRegistry HapticViewer::commands()
{
  vtkNew<vtkInteractorStyleHaptic> style;
  ViewWindow::addCommands(style->GetCommands(), nullptr);
  return style->GetCommands().described();
}

} // namespace pointhaptics
