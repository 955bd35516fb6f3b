#include "ViewEvents.h"

#include "XLibrary.h"

#include <vtkCommand.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <chrono>
#include <utility>

#if defined(__unix__) && !defined(__APPLE__)
#include <poll.h>
#endif

namespace pointhaptics
{
namespace
{

constexpr auto kTimerPeriod = std::chrono::milliseconds(33);

#if defined(__unix__) && !defined(__APPLE__)
/// Socket on which the X server's events of @p window arrive; -1: there is none.
int eventSocket(vtkRenderWindow* window)
{
  const auto connectionNumber = xFunction<int (*)(void*)>("XConnectionNumber");
  void* display = xDisplayOf(window);
  return connectionNumber && display ? connectionNumber(display) : -1;
}
#endif

/// Notes a key, a button of the mouse, or a message of the window manager, such as to close the window.
/// XCheckIfEvent() calls it; it takes no event out of the queue.
int noteInput(void*, void* event, char* found)
{
  constexpr int kKeyPress = 2;
  constexpr int kButtonPress = 4;
  constexpr int kClientMessage = 33;
  const int type = *static_cast<const int*>(event);
  bool& isThere = *reinterpret_cast<bool*>(found);
  isThere = isThere || type == kKeyPress || type == kButtonPress || type == kClientMessage;
  return 0;
}

} // namespace

bool inputWaits(vtkRenderWindow* window)
{
  using CheckIfEvent = int (*)(void*, void*, int (*)(void*, void*, char*), char*);
  const auto checkIfEvent = xFunction<CheckIfEvent>("XCheckIfEvent");
  void* display = xDisplayOf(window);
  if (checkIfEvent && display)
  {
    long event[24]; // the size of an XEvent
    bool isThere = false;
    checkIfEvent(display, event, noteInput, reinterpret_cast<char*>(&isThere));
    return isThere;
  }
  return false;
}

void runEvents(vtkRenderWindowInteractor* interactor)
{
#if defined(__unix__) && !defined(__APPLE__)
  const int socket = eventSocket(interactor->GetRenderWindow());
  if (socket >= 0)
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
      struct pollfd events = { socket, POLLIN, 0 };
      ::poll(&events, 1, static_cast<int>(std::max<long long>(0, left)));
    }
    return;
  }
#endif
  interactor->Start();
}

void leaveEvents(vtkRenderWindowInteractor* interactor)
{
#if defined(__unix__) && !defined(__APPLE__)
  if (eventSocket(interactor->GetRenderWindow()) >= 0)
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
