#include "Benchmark/Servo/EmptyLoop.h"

#include "Haptics/Servo/ServoThread.h"

#include <algorithm>

#ifdef __linux__
#include <pthread.h>
#include <sched.h>
#endif

namespace pointhaptics::bench::servo
{

namespace
{
enum class Cores
{
  All,
  AllButTheLast,
  TheLast
};

/// Keeps this thread to some of the cores of the process. False: the process has one core.
bool keepTo([[maybe_unused]] Cores which)
{
#ifdef __linux__
  static const cpu_set_t allowed = []
  {
    cpu_set_t set;
    CPU_ZERO(&set);
    sched_getaffinity(0, sizeof(set), &set);
    return set;
  }();
  int last = -1;
  for (int i = 0; i < CPU_SETSIZE; ++i)
  {
    last = CPU_ISSET(i, &allowed) ? i : last;
  }
  if (last < 0 || CPU_COUNT(&allowed) < 2)
  {
    return false;
  }
  cpu_set_t chosen = allowed;
  if (which == Cores::AllButTheLast)
  {
    CPU_CLR(last, &chosen);
  }
  else if (which == Cores::TheLast)
  {
    CPU_ZERO(&chosen);
    CPU_SET(last, &chosen);
  }
  return pthread_setaffinity_np(pthread_self(), sizeof(chosen), &chosen) == 0;
#else
  return false;
#endif
}
}

LastCoreApart::LastCoreApart()
  : apart_(keepTo(Cores::AllButTheLast))
{
}

LastCoreApart::~LastCoreApart()
{
  if (apart_)
  {
    keepTo(Cores::All);
  }
}

EmptyLoop::EmptyLoop(double rateHz, double wakeEarlySeconds)
  : period_(1e9 / rateHz)
  , early_(1e9 * std::min(wakeEarlySeconds, 0.5 / rateHz))
  , thread_([this] { this->run(); })
{
}

EmptyLoop::~EmptyLoop()
{
  this->stop();
}

void EmptyLoop::stop()
{
  done_ = true;
  if (thread_.joinable())
  {
    thread_.join();
  }
}

void EmptyLoop::run()
{
  keepTo(Cores::TheLast);
  setFinestTimerSlack();
  static_cast<void>(requestRealtimePriority());
  const std::int64_t start = steadyNanoseconds();
  for (std::uint64_t tick = 1; !done_.load(std::memory_order_relaxed); ++tick)
  {
    const double deadline = double(tick) * period_;
    sleepUntil(start + std::int64_t(deadline - early_));
    spinUntil(start + std::int64_t(deadline));
    const double late = double(steadyNanoseconds() - start) - deadline;
    largest_ = std::max(largest_, 1e-9 * late);
    const auto missed = std::uint64_t(std::max(0.0, late) / period_);
    missed_ += missed;
    tick += missed;
  }
}

} // namespace pointhaptics::bench::servo
