#include "ViewEvents.h"

#include "XLibrary.h"

#include <vtkCommand.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <chrono>

#if defined(__unix__) && !defined(__APPLE__)
#include <poll.h>
#endif

namespace pointhaptics
{
namespace
{

constexpr auto kTimerPeriod = std::chrono::milliseconds(33);

#if defined(__unix__) && !defined(__APPLE__)
/// The socket on which the X server's events of @p window come; -1: there is none.
int eventSocket(vtkRenderWindow* window)
{
  using ConnectionNumber = int (*)(void*);
  const auto connectionNumber = reinterpret_cast<ConnectionNumber>(findXFunction("XConnectionNumber"));
  void* display = xDisplayOf(window);
  return connectionNumber && display ? connectionNumber(display) : -1;
}
#endif

} // namespace

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
      // Sends what is still to be sent, and empties the queue: nothing is overlooked by poll().
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

} // namespace pointhaptics
