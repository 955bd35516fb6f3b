/// @file
/// Requests of the servo thread to the operating system and the processor. Each call but lockMemory() acts on
/// the calling thread alone; WakefulCores on the whole machine.
#pragma once

#include <cstdint>

namespace pointhaptics
{

/// Denormal numbers count as zero in this thread: they are a hundred times slower to compute with than
/// others, and no force of 1e-308 N is felt. x86 only; elsewhere nothing happens.
void flushDenormalsToZero() noexcept;

/// Flushes denormals to zero while it lives, for threads that compute what a servo thread computes; then
/// restores the mode.
class DenormalsAreZero
{
public:
  DenormalsAreZero() noexcept;
  ~DenormalsAreZero();
  DenormalsAreZero(const DenormalsAreZero&) = delete;
  DenormalsAreZero& operator=(const DenormalsAreZero&) = delete;

private:
  unsigned int before_ = 0;
};

/// Lets the kernel wake this thread at its deadline instead of up to 50 us later. Linux only.
void setFinestTimerSlack() noexcept;

/// Asks for SCHED_FIFO. @return 0, or the errno of the refusal (EPERM: no privilege); the thread then runs as
/// before.
int requestRealtimePriority() noexcept;

/// Keeps all pages of the process in memory from now on, those of the future as they are first touched, so
/// that no tick waits for a disk. @return 0, or the errno of the refusal. EPERM also where only part of the
/// memory could be locked (a finite limit and no privilege): then nothing is, since later allocations would
/// fail.
int lockMemory() noexcept;

/// While it holds its request no core of the machine sleeps deeper than a spinning one (the kernel's power
/// management quality of service, /dev/cpu_dma_latency): a core asleep needs up to some hundreds of
/// microseconds to wake, and finds its caches empty. Costs power. Linux only. One thread at a time.
class WakefulCores
{
public:
  WakefulCores() = default;
  ~WakefulCores();
  WakefulCores(const WakefulCores&) = delete;
  WakefulCores& operator=(const WakefulCores&) = delete;
  /// @return 0, or the errno of the refusal (EACCES: no permission, ENOENT: no such kernel). Held until
  /// release().
  int request() noexcept;
  void release() noexcept;

private:
  int file_ = -1;
};

/// Touches 64 KiB of the calling thread's stack, so that no tick has to.
void touchStack() noexcept;

/// Nanoseconds of the steady clock that sleepUntil() uses.
std::int64_t steadyNanoseconds() noexcept;
/// Sleeps until @p deadline (of steadyNanoseconds()); returns at once where it has passed.
void sleepUntil(std::int64_t deadline) noexcept;
/// Waits for @p deadline without giving the processor up: for some tens of microseconds. Returns at once
/// where it has passed.
void spinUntil(std::int64_t deadline) noexcept;

} // namespace pointhaptics
