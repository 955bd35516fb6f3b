#include "Devices/Sound/SoundPlayer.h"

#include "Devices/Sound/ContactTone.h"

#include "Haptics/ServoLoop.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr auto kBlockTime = std::chrono::microseconds(5000);
constexpr auto kAhead = std::chrono::milliseconds(100);

} // namespace

void SoundPlayer::start(const ServoLoop& loop, std::unique_ptr<SoundOutput> output)
{
  this->stop();
  output_ = std::move(output);
  thread_.start([this, &loop] { this->run(loop); });
}

void SoundPlayer::stop()
{
  thread_.stop();
  output_.reset();
}

std::string SoundPlayer::takeProblem()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(problem_, std::string());
}

void SoundPlayer::run(const ServoLoop& loop)
{
  constexpr auto kBlock = static_cast<std::size_t>(kBlockSeconds * ContactTone::kSamplesPerSecond);
  std::array<float, kBlock> samples{};
  ContactTone tone;
  std::string message;
  using Clock = std::chrono::steady_clock;
  auto due = Clock::now(); // when the block is heard at the earliest
  while (!thread_.stopIsRequested())
  {
    // An output that never waits would get hours of samples at once.
    due = std::max(due, Clock::now());
    if (due - Clock::now() > kAhead)
    {
      std::this_thread::sleep_for(kBlockTime);
    }
    due += kBlockTime;
    const ServoSample latest = loop.latest();
    const bool isFelt = loop.running() && latest.state.contact && latest.device == Status::Ok;
    tone.render({ isFelt ? norm(latest.state.force) : 0.0, isFelt }, samples.data(), samples.size());
    const auto begin = Clock::now();
    if (!output_->write(samples.data(), samples.size(), message))
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      problem_ = message;
      return;
    }
    if (Clock::now() - begin > kBlockTime / 2)
    {
      due = Clock::now(); // it waits by its own clock
    }
  }
}

} // namespace pointhaptics
