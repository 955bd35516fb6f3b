#include "Core/Base/Host/InterpreterLock.h"

#include <chrono>
#include <thread>

namespace pointhaptics
{
namespace
{

InterpreterLock theLock;

} // namespace

void setInterpreterLock(const InterpreterLock& lock) noexcept
{
  theLock = lock;
}

WithoutInterpreterLock::WithoutInterpreterLock() noexcept
  : state_(theLock.isHeld && theLock.isHeld() ? theLock.release() : nullptr)
{
}

WithoutInterpreterLock::~WithoutInterpreterLock()
{
  if (!state_)
  {
    return;
  }
  while (theLock.isEnding && theLock.isEnding())
  {
    std::this_thread::sleep_for(std::chrono::hours(1));
  }
  theLock.take(state_);
}

} // namespace pointhaptics
