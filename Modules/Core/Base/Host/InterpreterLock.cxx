#include "Core/Base/Host/InterpreterLock.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <mutex>
#include <thread>
#include <utility>

#include <dlfcn.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace pointhaptics
{
namespace
{

InterpreterLock theLock;
/// Guards what follows.
std::mutex theMutex;
/// First of the threads that work without the lock.
WithoutInterpreterLock* theFirst = nullptr;
std::atomic<bool> isOver{ false };
// For the main thread alone.

InterpreterFaults theFaults;
/// The main thread's, while it works without the lock.
WithoutInterpreterLock* theMain = nullptr;
/// What a handler raised, and the frame that is to get it; no frame: nothing.
struct
{
  void* frame = nullptr;
  void* kind = nullptr;
  void* value = nullptr;
  void* trace = nullptr;
} theFault;

bool isMainThread()
{
  return ::syscall(SYS_gettid) == ::getpid();
}

/// True if @p caller waits for interpreted code that it called, such as an observer.
bool isWaiting(void* caller)
{
  bool waits = false;
  void* frame = theFaults.frame();
  if (frame && frame != caller)
  {
    theFaults.keep(frame);
    while (frame && !waits)
    {
      void* const next = theFaults.callerOf(frame);
      theFaults.letGo(frame);
      frame = next;
      waits = frame == caller;
    }
    if (frame)
    {
      theFaults.letGo(frame);
    }
  }
  return waits;
}

/// Raises theFault once its frame goes on. For callSoon(); @return not 0: it is raised.
int raiseFault(void*)
{
  if (isWaiting(theFault.frame) && theFaults.callSoon(&raiseFault, nullptr) == 0)
  {
    return 0;
  }
  theFaults.restore(theFault.kind, theFault.value, theFault.trace);
  theFaults.letGo(std::exchange(theFault.frame, nullptr));
  return -1;
}

[[noreturn]] void sleepToTheEnd()
{
  while (true)
  {
    std::this_thread::sleep_for(std::chrono::hours(1));
  }
}

} // namespace

void setInterpreterLock(const InterpreterLock& lock) noexcept
{
  theLock = lock;
}

void endInterpreter() noexcept
{
  std::unique_lock lock(theMutex);
  isOver = true;
  while (theFirst)
  {
    for (const WithoutInterpreterLock* thread = theFirst; thread; thread = thread->next_)
    {
      if (thread->stop_)
      {
        thread->stop_();
      }
    }
    lock.unlock();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    lock.lock();
  }
}

void setInterpreterFaults(const InterpreterFaults& faults) noexcept
{
  theFaults = faults;
}

bool runsSignalHandlers() noexcept
{
  return theLock.runHandlers && isMainThread() && theMain;
}

bool isHandlerOfInterpreter(void (*handler)(int)) noexcept
{
  Dl_info ofHandler{};
  Dl_info ofInterpreter{};
  return handler != SIG_DFL && handler != SIG_IGN &&
    ::dladdr(reinterpret_cast<void*>(handler), &ofHandler) != 0 &&
    ::dladdr(reinterpret_cast<void*>(theLock.runHandlers), &ofInterpreter) != 0 &&
    ofHandler.dli_fbase == ofInterpreter.dli_fbase;
}

void runSignalHandlers(bool now) noexcept
{
  constexpr std::chrono::milliseconds kPeriod(50);
  if (!runsSignalHandlers())
  {
    return;
  }
  WithoutInterpreterLock* const here = theMain;
  const auto time = std::chrono::steady_clock::now();
  if (!here->hasRaised_ && !theFault.frame && (now || time - here->handled_ >= kPeriod))
  {
    here->handled_ = time;
    theLock.take(here->state_);
    theMain = nullptr; // a handler may work without the lock, too
    const bool hasRaised = theLock.runHandlers() != 0;
    theMain = here;
    if (hasRaised)
    {
      here->keepFault();
    }
    here->state_ = theLock.release();
  }
  if (here->hasRaised_ && here->stop_)
  {
    here->stop_();
  }
}

/// Keeps what a handler raised for the frame that waits for all of this work, and ends the work. Without such
/// a frame it stays with the interpreter.
void WithoutInterpreterLock::keepFault() noexcept
{
  WithoutInterpreterLock* first = this;
  first->hasRaised_ = true;
  while (first->outer_)
  {
    first = first->outer_;
    first->hasRaised_ = true;
  }
  if (first->caller_ && theFaults.callSoon(&raiseFault, nullptr) == 0)
  {
    theFaults.fetch(&theFault.kind, &theFault.value, &theFault.trace);
    theFaults.keep(first->caller_);
    theFault.frame = first->caller_;
  }
}

/// The observers of the end would run them, and lose what they raise.
void WithoutInterpreterLock::runLastHandlers() noexcept
{
  if (!theFault.frame && caller_ && theLock.runHandlers)
  {
    theMain = nullptr;
    if (theLock.runHandlers() != 0)
    {
      keepFault();
    }
    theMain = this;
  }
}

WithoutInterpreterLock::WithoutInterpreterLock(std::function<void()> stop) noexcept
  : stop_(std::move(stop))
{
  if (isOver || !theLock.isHeld || !theLock.isHeld())
  {
    return;
  }
  const bool isMain = isMainThread();
  caller_ = isMain && theFaults.frame ? theFaults.frame() : nullptr;
  if (caller_)
  {
    theFaults.keep(caller_);
  }
  state_ = theLock.release();
  std::unique_lock lock(theMutex);
  if (isOver)
  {
    lock.unlock();
    sleepToTheEnd();
  }
  next_ = theFirst;
  theFirst = this;
  if (isMain)
  {
    outer_ = std::exchange(theMain, this);
  }
  // Code of the interpreter that is no frame, such as map(), calls on.
  hasRaised_ = isMain && caller_ && caller_ == theFault.frame;
  lock.unlock();
  if (hasRaised_ && stop_)
  {
    stop_();
  }
}

WithoutInterpreterLock::~WithoutInterpreterLock()
{
  if (!state_)
  {
    return;
  }
  const bool isEnd = isOver || (theLock.isEnding && theLock.isEnding());
  if (!isEnd)
  {
    theLock.take(state_); // endInterpreter() waits for it, without the lock
    if (theMain == this)
    {
      runLastHandlers();
    }
    if (caller_)
    {
      theFaults.letGo(caller_);
    }
  }
  std::unique_lock lock(theMutex);
  WithoutInterpreterLock** place = &theFirst;
  while (*place != this)
  {
    place = &(*place)->next_;
  }
  *place = next_;
  theMain = theMain == this ? outer_ : theMain;
  lock.unlock();
  if (isEnd)
  {
    sleepToTheEnd();
  }
}

} // namespace pointhaptics
