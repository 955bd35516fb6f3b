/// @file
/// The thread of a driver, which finds its device, and finds it again after it was unplugged.
#pragma once

#include "Core/Base/Status.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace pointhaptics
{

/// start() and stop() from one thread, the others from any. Declare it last in its owner.
class DriverThread
{
public:
  DriverThread() = default;
  ~DriverThread() { this->stop(); }
  DriverThread(const DriverThread&) = delete;
  DriverThread& operator=(const DriverThread&) = delete;

  /// Calls @p work again and again, @p pauseSeconds apart, until it answers false or stop() is called. It
  /// returns soon once stopping() is true.
  template <typename Work>
  void start(double pauseSeconds, Work work)
  {
    this->stop();
    stopping_ = false;
    thread_ = std::thread(
      [this, pauseSeconds, work = std::move(work)]
      {
        while (!stopping_ && work())
        {
          std::unique_lock<std::mutex> lock(mutex_);
          wake_.wait_for(
            lock, std::chrono::duration<double>(pauseSeconds), [this] { return stopping_.load(); });
        }
      });
  }
  /// Ends the thread and waits for it.
  void stop()
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable())
    {
      thread_.join();
    }
  }
  const std::atomic<bool>& stopping() const { return stopping_; }

  ///@{
  /// Status of the device as the driver sees it, and a sentence for people, which may be empty.
  void report(Status status, const std::string& message)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    status_ = status;
    message_ = message;
  }
  Status status() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return status_;
  }
  std::string message() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return message_;
  }
  ///@}

private:
  std::atomic<bool> stopping_{ false };
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Status status_ = Status::DeviceNotReady;
  std::string message_;
  std::thread thread_;
};

} // namespace pointhaptics
