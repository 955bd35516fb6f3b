#include "Benchmark/Servo/EmptyLoop.h"

#include "Haptics/ServoThread.h"

#include <algorithm>

namespace pointhaptics
{
namespace bench
{
namespace servo
{

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

} // namespace servo
} // namespace bench
} // namespace pointhaptics
