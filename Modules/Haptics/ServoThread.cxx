#include "Haptics/ServoThread.h"

#include <cerrno>
#include <ctime>
#include <pthread.h>
#include <sched.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif
#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace pointhaptics
{
namespace
{
constexpr std::int64_t kNanosecondsPerSecond = 1000000000;
/// Below the kernel's interrupt threads (50), which carry the device's own USB replies.
constexpr int kRealtimePriority = 40;
}

void flushDenormalsToZero() noexcept
{
#ifdef __SSE__
  constexpr unsigned int kFlushToZero = 0x8000;
  constexpr unsigned int kDenormalsAreZero = 0x0040;
  _mm_setcsr(_mm_getcsr() | kFlushToZero | kDenormalsAreZero);
#endif
}

void setFinestTimerSlack() noexcept
{
#ifdef __linux__
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
#endif
}

bool requestRealtimePriority() noexcept
{
  sched_param parameter{};
  parameter.sched_priority = kRealtimePriority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter) == 0;
}

std::int64_t steadyNanoseconds() noexcept
{
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t(now.tv_sec) * kNanosecondsPerSecond + now.tv_nsec;
}

void sleepUntil(std::int64_t deadline) noexcept
{
  timespec time{};
  time.tv_sec = time_t(deadline / kNanosecondsPerSecond);
  time.tv_nsec = long(deadline % kNanosecondsPerSecond);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR)
  {
  }
}

} // namespace pointhaptics
