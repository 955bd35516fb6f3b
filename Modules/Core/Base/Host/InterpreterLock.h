/// @file
/// Gives up the lock of the interpreter that calls, such as Python's GIL, while long work runs.
#pragma once

namespace pointhaptics
{

/// How an interpreter's lock is given up and taken again. Functions of the interpreter; none throws.
struct InterpreterLock
{
  int (*isHeld)() = nullptr;     ///< True if the calling thread holds the lock; null: there is no lock.
  void* (*release)() = nullptr;  ///< Gives the lock up; the result is for take().
  void (*take)(void*) = nullptr; ///< Waits for the lock.
  int (*isEnding)() = nullptr;   ///< True if the interpreter ends and gives the lock to nobody; may be null.
};

/// Sets the lock of this process. Call it before other threads use this library.
void setInterpreterLock(const InterpreterLock& lock) noexcept;

/// While it lives the calling thread is without the interpreter's lock, so that other threads of the
/// interpreter run. No effect where there is no interpreter, or the thread does not hold its lock. After the
/// end of the interpreter the thread sleeps until the process ends, as the interpreter's own threads do.
class WithoutInterpreterLock
{
public:
  WithoutInterpreterLock() noexcept;
  ~WithoutInterpreterLock();
  WithoutInterpreterLock(const WithoutInterpreterLock&) = delete;
  WithoutInterpreterLock& operator=(const WithoutInterpreterLock&) = delete;

private:
  void* state_ = nullptr;
};

} // namespace pointhaptics
