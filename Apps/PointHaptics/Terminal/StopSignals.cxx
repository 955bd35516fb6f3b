#include "Terminal/StopSignals.h"

#include "Terminal/Messages.h"

#include "Core/Base/OutputFile.h"
#include "Core/Base/Status.h"

#include <csignal>
#include <exception>
#include <initializer_list>
#include <utility>

#include <unistd.h>

namespace pointhaptics::app
{
namespace
{

volatile std::sig_atomic_t requested = 0;
std::string lastWords; ///< Made before memory is short.

/// abort() is called, not interrupted: what it finds is as whole as memory allows.
void endNow(int)
{
  OutputFile::discardAll();
  static_cast<void>(!::write(STDERR_FILENO, lastWords.data(), lastWords.size()));
  ::_exit(kFailed);
}

} // namespace

void rememberStopSignals()
{
  static bool isRemembered = false;
  if (std::exchange(isRemembered, true))
  {
    return;
  }
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

void endCleanlyOnAbort(const std::string& speaker)
{
  lastWords = speaker + ": the system gave no memory, or no OpenGL to a window; " +
    message(Status::OutOfMemory) + ", or look which graphics driver is missing (glxinfo)\n";
  std::signal(SIGABRT, endNow);
  std::set_terminate([] { endNow(SIGABRT); });
}

} // namespace pointhaptics::app
