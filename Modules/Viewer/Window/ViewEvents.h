/// @file
/// The event loop of the window, and keys that come before there is anything they could act on.
#pragma once

#include <string>
#include <vector>

class vtkRenderWindow;
class vtkRenderWindowInteractor;

namespace pointhaptics
{

/// Handles the window's events until the interactor is told to end, as its Start() does, and invokes
/// vtkCommand::TimerEvent 30 times a second. On X11 it sleeps until there is an event or the timer is due;
/// Start() of VTK 9.1 looks for events a thousand times a second, which costs 3 % of a core. To be called
/// after Initialize().
void runEvents(vtkRenderWindowInteractor* interactor);

/// Ends runEvents() of @p interactor from one of its events; the window stays usable. TerminateApp() of VTK
/// 9.1 on X11 destroys the window, and the one that the next render makes hears neither keys nor its close
/// button.
void leaveEvents(vtkRenderWindowInteractor* interactor);

/// True if a key, a button of the mouse or a word of the window manager waits to be handled by @p window's
/// interactor. It goes on to wait. False also where the window is not one on an X server.
bool inputWaits(vtkRenderWindow* window);

/// Keeps the keys of a window that waits for its first file, and presses them again when it is there. GUI
/// thread only.
class WaitingKeys
{
public:
  /// Keeps the key that @p interactor has just received.
  void keep(vtkRenderWindowInteractor* interactor);
  /// Presses and lets go of all of them, in their order, and forgets them.
  void press(vtkRenderWindowInteractor* interactor);

private:
  struct Key
  {
    std::string symbol;
    char code;
    bool control;
    bool shift;
    bool alt;
  };
  std::vector<Key> keys_;
};

} // namespace pointhaptics
