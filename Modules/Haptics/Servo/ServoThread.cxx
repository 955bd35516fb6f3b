#include "Haptics/Servo/ServoThread.h"

#include <cerrno>
#include <cstddef>
#include <ctime>
#include <pthread.h>
#include <sched.h>

#ifdef __linux__
#include <fcntl.h>
#include <linux/capability.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
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
constexpr std::size_t kTouchedStack = 65536;
constexpr std::size_t kSmallestPage = 4096;

#ifdef __linux__
/// The privilege CAP_IPC_LOCK: no limit counts.
bool mayLockMemory() noexcept
{
  __user_cap_header_struct header{};
  header.version = _LINUX_CAPABILITY_VERSION_3;
  __user_cap_data_struct data[2] = {};
  return syscall(SYS_capget, &header, data) == 0 && (data[0].effective & (1u << CAP_IPC_LOCK)) != 0;
}
#endif
}

void flushDenormalsToZero() noexcept
{
#ifdef __SSE__
  constexpr unsigned int kFlushToZero = 0x8000;
  constexpr unsigned int kDenormalsAreZero = 0x0040;
  _mm_setcsr(_mm_getcsr() | kFlushToZero | kDenormalsAreZero);
#endif
}

DenormalsAreZero::DenormalsAreZero() noexcept
{
#ifdef __SSE__
  before_ = _mm_getcsr();
#endif
  flushDenormalsToZero();
}

DenormalsAreZero::~DenormalsAreZero()
{
#ifdef __SSE__
  _mm_setcsr(before_);
#endif
}

void setFinestTimerSlack() noexcept
{
#ifdef __linux__
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
#endif
}

int requestRealtimePriority() noexcept
{
  sched_param parameter{};
  parameter.sched_priority = kRealtimePriority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter);
}

int lockMemory() noexcept
{
#ifdef __linux__
  rlimit limit{};
  const bool unlimited = getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
  if (!unlimited && !mayLockMemory())
  {
    return EPERM;
  }
  return mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0 ? 0 : errno;
#else
  return ENOSYS;
#endif
}

WakefulCores::~WakefulCores()
{
  release();
}

int WakefulCores::request() noexcept
{
#ifdef __linux__
  release();
  file_ = open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
  const std::int32_t microseconds = 0;
  errno = file_ >= 0 ? EIO : errno; // for a write that is cut short
  if (file_ >= 0 && write(file_, &microseconds, sizeof(microseconds)) == ssize_t(sizeof(microseconds)))
  {
    return 0;
  }
  const int error = errno;
  release();
  return error;
#else
  return ENOSYS;
#endif
}

void WakefulCores::release() noexcept
{
#ifdef __linux__
  if (file_ >= 0)
  {
    close(file_); // the kernel drops the request
    file_ = -1;
  }
#endif
}

void touchStack() noexcept
{
  char stack[kTouchedStack];
  volatile char* const bytes = stack;
  for (std::size_t i = 0; i < kTouchedStack; i += kSmallestPage)
  {
    bytes[i] = 0;
  }
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

void spinUntil(std::int64_t deadline) noexcept
{
  while (steadyNanoseconds() < deadline)
  {
  }
}

} // namespace pointhaptics
