/// @file
/// A thread that is asked to end, and waited for.
#pragma once

#include <atomic>
#include <thread>
#include <utility>

namespace pointhaptics
{

/// Declare it last in its owner: its destructor ends the thread before the members that it uses. All but
/// stopIsRequested() from one thread.
class StoppableThread
{
public:
  StoppableThread() = default;
  ~StoppableThread() { this->stop(); }
  StoppableThread(const StoppableThread&) = delete;
  StoppableThread& operator=(const StoppableThread&) = delete;

  /// Calls @p work, which returns soon after stopIsRequested(), in a thread; an earlier one ends first.
  template <typename Work>
  void start(Work&& work)
  {
    this->stop();
    stopping_ = false;
    thread_ = std::thread(std::forward<Work>(work));
  }
  /// Asks the work to end and waits for it.
  void stop()
  {
    stopping_ = true;
    if (thread_.joinable())
    {
      thread_.join();
    }
  }
  /// True between start() and stop(), also when the work has ended by itself.
  bool isStarted() const { return thread_.joinable(); }
  bool stopIsRequested() const { return stopping_; }

private:
  std::atomic<bool> stopping_{ false };
  std::thread thread_;
};

} // namespace pointhaptics
