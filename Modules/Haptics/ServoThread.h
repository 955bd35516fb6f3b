/// @file
/// What the servo thread asks of the operating system and the processor. Each call but lockMemory() acts on
/// the calling thread alone.
#pragma once

#include <cstdint>

namespace pointhaptics
{

/// Denormal numbers count as zero in this thread: they are a hundred times slower to compute with than
/// others, and no force of 1e-308 N is felt. x86 only; elsewhere nothing happens.
void flushDenormalsToZero() noexcept;

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
