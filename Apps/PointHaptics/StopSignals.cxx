#include "StopSignals.h"

#include <csignal>
#include <initializer_list>

namespace pointhaptics
{
namespace app
{
namespace
{

volatile std::sig_atomic_t requested = 0;

} // namespace

void rememberStopSignals()
{
  struct sigaction action = {};
  action.sa_handler = [](int) { requested = 1; };
  // Once: whoever presses Ctrl+C again means it.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    sigaction(signal, &action, nullptr);
  }
}

bool stopIsRequested() noexcept
{
  return requested != 0;
}

} // namespace app
} // namespace pointhaptics
