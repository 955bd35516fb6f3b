/// @file
/// Gives up the lock of the interpreter that calls, such as Python's GIL, while long work runs.
#pragma once

#include <chrono>
#include <functional>

namespace pointhaptics
{

/// How an interpreter's lock is given up and taken again. Functions of the interpreter; none throws.
struct InterpreterLock
{
  int (*isHeld)() = nullptr;     ///< True if the calling thread holds the lock; null: there is no lock.
  void* (*release)() = nullptr;  ///< Gives the lock up; the result is for take().
  void (*take)(void*) = nullptr; ///< Waits for the lock.
  int (*isEnding)() = nullptr;   ///< True if the interpreter ends and gives the lock to nobody; may be null.
  /// Runs the handlers of signals that came, under the lock and in the main thread; not 0: one has raised.
  /// May be null.
  int (*runHandlers)() = nullptr;
};

/// Sets the lock of this process. Call it before other threads use this library.
void setInterpreterLock(const InterpreterLock& lock) noexcept;

/// Stops the work of all threads that are WithoutInterpreterLock, and waits until it has ended: these threads
/// sleep until the process ends, as libraries go meanwhile. From then on no thread gives the lock up, so that
/// the interpreter waits for what a thread still begins. Call it without the lock.
void endInterpreter() noexcept;

/// Where the main thread works without the lock: runs the handlers of signals that came, at most 20 times a
/// second, and stops the work if one raises. Called wherever work reports progress.
void runSignalHandlers() noexcept;

/// While it lives the calling thread is without the interpreter's lock, so that other threads of the
/// interpreter run. No effect where there is no interpreter, or the thread does not hold its lock. After the
/// end of the interpreter the thread sleeps until the process ends, as the interpreter's own threads do.
class WithoutInterpreterLock
{
public:
  /// @param stop asks the work of this thread to end soon; endInterpreter() calls it from another thread,
  /// again and again.
  explicit WithoutInterpreterLock(std::function<void()> stop = {}) noexcept;
  ~WithoutInterpreterLock();
  WithoutInterpreterLock(const WithoutInterpreterLock&) = delete;
  WithoutInterpreterLock& operator=(const WithoutInterpreterLock&) = delete;

private:
  friend void endInterpreter() noexcept;
  friend void runSignalHandlers() noexcept;

  void* state_ = nullptr;
  bool hasRaised_ = false;
  std::chrono::steady_clock::time_point handled_; ///< When handlers ran.
  std::function<void()> stop_;
  WithoutInterpreterLock* next_ = nullptr;
};

} // namespace pointhaptics
