/// @file
/// What the servo thread asks of the operating system and the processor. Each call acts on the calling thread
/// alone.
#pragma once

#include <cstdint>

namespace pointhaptics
{

/// Denormal numbers count as zero in this thread: they are a hundred times slower to compute with than
/// others, and no force of 1e-308 N is felt. x86 only; elsewhere nothing happens.
void flushDenormalsToZero() noexcept;

/// Lets the kernel wake this thread at its deadline instead of up to 50 us later. Linux only.
void setFinestTimerSlack() noexcept;

/// Asks for SCHED_FIFO. @return false where the system refuses (no privilege): the thread then runs as
/// before.
bool requestRealtimePriority() noexcept;

/// Nanoseconds of the steady clock that sleepUntil() uses.
std::int64_t steadyNanoseconds() noexcept;
/// Sleeps until @p deadline (of steadyNanoseconds()); returns at once where it has passed.
void sleepUntil(std::int64_t deadline) noexcept;

} // namespace pointhaptics
