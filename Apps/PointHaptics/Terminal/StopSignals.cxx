#include "Terminal/StopSignals.h"

#include <csignal>
#include <initializer_list>

namespace pointhaptics::app
{
namespace
{

volatile std::sig_atomic_t requested = 0;

} // namespace

void rememberStopSignals()
{
  // A reader that ends - view ... | head - must not end a program that pushes.
  std::signal(SIGPIPE, SIG_IGN);
  struct sigaction action = {};
  action.sa_handler = [](int signal) { requested = signal; };
  // Once: whoever presses Ctrl+C again means it.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    // A signal that nohup or a shell in the background ignores stays ignored.
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN)
    {
      sigaction(signal, &action, nullptr);
    }
  }
}

bool stopIsRequested() noexcept
{
  return requested != 0;
}

int stopExitCode() noexcept
{
  constexpr int kEndedBySignal = 128; // as shells count
  return kEndedBySignal + requested;
}

} // namespace pointhaptics::app
