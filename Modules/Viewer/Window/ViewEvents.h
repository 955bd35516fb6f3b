/// @file
/// The event loop of the window.
#pragma once

class vtkRenderWindowInteractor;

namespace pointhaptics
{

/// Handles the window's events until the interactor is told to end, as its Start() does, and invokes
/// vtkCommand::TimerEvent 30 times a second. On X11 it sleeps until there is an event or the timer is due;
/// Start() of VTK 9.1 looks for events a thousand times a second, which costs 3 % of a core. To be called
/// after Initialize().
void runEvents(vtkRenderWindowInteractor* interactor);

/// Ends runEvents() of @p interactor, from one of its events, for a window that is used further. On X11
/// TerminateApp() is for good: VTK 9.1 destroys the window, and the one that the next render makes instead
/// hears neither keys nor its close button.
void leaveEvents(vtkRenderWindowInteractor* interactor);

} // namespace pointhaptics
