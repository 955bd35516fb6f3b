#include "Core/Base/Host/ProgressReport.h"

#include "Core/Base/Host/InterpreterLock.h"

#include <atomic>
#include <csignal>

namespace pointhaptics
{
namespace
{

/// Signals that wait. The main thread alone writes here, but for the notes.
struct
{
  bool isHeld[NSIG] = {};
  struct sigaction before[NSIG] = {};
  std::atomic<bool> isNoted[NSIG] = {};
  bool areHeld = false;
} theSignals;

void note(int signal)
{
  theSignals.isNoted[signal] = true;
}

/// What a program does wrong cannot wait.
bool isFault(int signal)
{
  return signal == SIGSEGV || signal == SIGBUS || signal == SIGFPE || signal == SIGILL || signal == SIGABRT ||
    signal == SIGTRAP || signal == SIGSYS;
}

void hold(int signal)
{
  struct sigaction& before = theSignals.before[signal];
  if (isFault(signal) || ::sigaction(signal, nullptr, &before) != 0 || (before.sa_flags & SA_SIGINFO) != 0 ||
    !isHandlerOfInterpreter(before.sa_handler))
  {
    return;
  }
  struct sigaction noting = before;
  noting.sa_handler = &note;
  theSignals.isNoted[signal] = false;
  theSignals.isHeld[signal] = ::sigaction(signal, &noting, nullptr) == 0;
}

/// An observer may have set another handler, which stays.
void letGo(int signal)
{
  struct sigaction now = {};
  theSignals.isHeld[signal] = false;
  if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == &note)
  {
    ::sigaction(signal, &theSignals.before[signal], nullptr);
  }
  if (theSignals.isNoted[signal])
  {
    ::raise(signal);
  }
}

} // namespace

SignalsAroundObservers::SignalsAroundObservers(bool areThere) noexcept
  : holds_(areThere && runsSignalHandlers() && !theSignals.areHeld)
{
  for (int signal = 1; holds_ && signal < NSIG; ++signal)
  {
    hold(signal);
  }
  theSignals.areHeld = theSignals.areHeld || holds_;
  runSignalHandlers(holds_);
}

SignalsAroundObservers::~SignalsAroundObservers()
{
  for (int signal = 1; holds_ && signal < NSIG; ++signal)
  {
    if (theSignals.isHeld[signal])
    {
      letGo(signal);
    }
  }
  theSignals.areHeld = theSignals.areHeld && !holds_;
}

} // namespace pointhaptics
