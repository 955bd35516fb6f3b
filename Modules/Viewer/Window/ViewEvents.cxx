#include "ViewEvents.h"

#include "XLibrary.h"

#include <vtkCommand.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <chrono>
#include <utility>

#ifdef POINTHAPTICS_USES_X
#include <X11/Xlib.h>
#include <poll.h>
#endif

namespace pointhaptics
{
#ifdef POINTHAPTICS_USES_X
namespace
{

constexpr auto kTimerPeriod = std::chrono::milliseconds(33);

Display* displayOf(vtkRenderWindow* window)
{
  return static_cast<Display*>(xDisplayOf(window));
}

/// Notes a key, a button of the mouse, or a message of the window manager, such as to close the window.
/// XCheckIfEvent() calls it; it takes no event out of the queue.
Bool noteInput(Display*, XEvent* event, XPointer found)
{
  bool& isThere = *reinterpret_cast<bool*>(found);
  isThere = isThere || event->type == KeyPress || event->type == ButtonPress || event->type == ClientMessage;
  return False;
}

} // namespace
#endif

bool inputWaits([[maybe_unused]] vtkRenderWindow* window)
{
  bool isThere = false;
#ifdef POINTHAPTICS_USES_X
  if (Display* display = displayOf(window))
  {
    XEvent event;
    XCheckIfEvent(display, &event, noteInput, reinterpret_cast<XPointer>(&isThere));
  }
#endif
  return isThere;
}

void runEvents(vtkRenderWindowInteractor* interactor)
{
#ifdef POINTHAPTICS_USES_X
  if (Display* display = displayOf(interactor->GetRenderWindow()))
  {
    using Clock = std::chrono::steady_clock;
    interactor->SetDone(false);
    Clock::time_point due = Clock::now();
    while (!interactor->GetDone())
    {
      // Sends pending requests and empties the queue, so that poll() overlooks nothing.
      interactor->ProcessEvents();
      if (!interactor->GetDone() && Clock::now() >= due)
      {
        due = std::max(due + kTimerPeriod, Clock::now());
        int timer = 1;
        interactor->InvokeEvent(vtkCommand::TimerEvent, &timer);
        continue; // what the timer drew may have brought answers into the queue
      }
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(due - Clock::now()).count();
      struct pollfd events = { ConnectionNumber(display), POLLIN, 0 };
      ::poll(&events, 1, static_cast<int>(std::max<long long>(0, left)));
    }
    return;
  }
#endif
  interactor->Start();
}

void leaveEvents(vtkRenderWindowInteractor* interactor)
{
#ifdef POINTHAPTICS_USES_X
  if (displayOf(interactor->GetRenderWindow()))
  {
    interactor->SetDone(true);
    return;
  }
#endif
  interactor->TerminateApp();
}

void WaitingKeys::keep(vtkRenderWindowInteractor* interactor)
{
  const char* symbol = interactor->GetKeySym();
  keys_.push_back({ symbol ? symbol : "", interactor->GetKeyCode(), interactor->GetControlKey() != 0,
    interactor->GetShiftKey() != 0, interactor->GetAltKey() != 0 });
}

void WaitingKeys::press(vtkRenderWindowInteractor* interactor)
{
  for (const Key& key : std::exchange(keys_, {}))
  {
    interactor->SetKeyEventInformation(key.control, key.shift, key.code, 0, key.symbol.c_str());
    interactor->SetAltKey(key.alt);
    for (const auto event : { vtkCommand::KeyPressEvent, vtkCommand::CharEvent, vtkCommand::KeyReleaseEvent })
    {
      interactor->InvokeEvent(event, nullptr);
    }
  }
}

} // namespace pointhaptics
