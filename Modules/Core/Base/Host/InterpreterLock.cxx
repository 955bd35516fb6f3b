#include "Core/Base/Host/InterpreterLock.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

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
/// The main thread's, while it works without the lock.
WithoutInterpreterLock* theMain = nullptr;

bool isMainThread()
{
  return ::syscall(SYS_gettid) == ::getpid();
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

void runSignalHandlers() noexcept
{
  constexpr std::chrono::milliseconds kPeriod(50);
  if (!theLock.runHandlers || !isMainThread() || !theMain)
  {
    return;
  }
  WithoutInterpreterLock* const here = theMain;
  const auto now = std::chrono::steady_clock::now();
  if (!here->hasRaised_ && now - here->handled_ >= kPeriod)
  {
    here->handled_ = now;
    theLock.take(here->state_);
    theMain = nullptr; // a handler may work without the lock, too
    here->hasRaised_ = theLock.runHandlers() != 0;
    theMain = here;
    here->state_ = theLock.release();
  }
  if (here->hasRaised_ && here->stop_)
  {
    here->stop_();
  }
}

WithoutInterpreterLock::WithoutInterpreterLock(std::function<void()> stop) noexcept
  : state_(!isOver && theLock.isHeld && theLock.isHeld() ? theLock.release() : nullptr)
  , stop_(std::move(stop))
{
  if (!state_)
  {
    return;
  }
  std::unique_lock lock(theMutex);
  if (isOver)
  {
    lock.unlock();
    sleepToTheEnd();
  }
  next_ = theFirst;
  theFirst = this;
  if (isMainThread())
  {
    theMain = this;
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
  }
  std::unique_lock lock(theMutex);
  WithoutInterpreterLock** place = &theFirst;
  while (*place != this)
  {
    place = &(*place)->next_;
  }
  *place = next_;
  if (theMain == this)
  {
    theMain = nullptr;
  }
  lock.unlock();
  if (isEnd)
  {
    sleepToTheEnd();
  }
}

} // namespace pointhaptics
