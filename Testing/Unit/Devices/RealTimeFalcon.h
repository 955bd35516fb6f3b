/// @file
/// A FalconModel behind its serial chip, whose hand moves in real time: what emulated USB devices share,
/// whoever carries the packets.
#pragma once

#include "FalconModel.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <vector>

namespace pointhaptics
{
namespace trial
{

class RealTimeFalcon
{
public:
  RealTimeFalcon(const RealTimeFalcon&) = delete;
  RealTimeFalcon& operator=(const RealTimeFalcon&) = delete;

  /// Calls @p use(model) while nobody else touches it.
  template <typename Use>
  auto with(Use&& use)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return use(model_);
  }

protected:
  using Clock = std::chrono::steady_clock;

  RealTimeFalcon() = default;
  ~RealTimeFalcon() = default;

  // All that follow: under the mutex.

  /// Power comes, and with it the hand's time begins.
  void powerOn()
  {
    model_.powerOff();
    movedTo_ = Clock::now();
  }
  /// The hand is where it is by now.
  void catchUp()
  {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - movedTo_).count();
    if (seconds >= 1e-4)
    {
      model_.move(std::min(seconds, 0.1));
      movedTo_ = now;
    }
  }
  /// Answer of the chip to a request of @p room bytes that came at @p asked: two status bytes and the model's
  /// bytes; without payload only after the latency timer. Empty: nothing yet.
  std::vector<std::uint8_t> packet(std::size_t room, Clock::time_point asked)
  {
    constexpr auto kLatency = std::chrono::milliseconds(1);
    constexpr std::size_t kPacket = 64;
    std::vector<std::uint8_t> bytes;
    if (!model_.pending().empty() || Clock::now() - asked >= kLatency)
    {
      bytes = { 0x01, 0x60 };
      bytes.resize(std::clamp(room, bytes.size(), kPacket));
      bytes.resize(2 + model_.read(bytes.data() + 2, bytes.size() - 2));
    }
    return bytes;
  }

  std::mutex mutex_;
  FalconModel model_;

private:
  Clock::time_point movedTo_;
};

} // namespace trial
} // namespace pointhaptics
