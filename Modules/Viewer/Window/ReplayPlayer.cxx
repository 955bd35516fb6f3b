#include "ReplayPlayer.h"

#include "vtkPointSet.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Longest sleep between two looks at the request to end.
constexpr std::chrono::milliseconds kLongestSleep(50);

} // namespace

bool ReplayPlayer::open(const std::string& fileName, vtkPointSet* cloud, std::string& message)
{
  fileName_ = fileName;
  if (!readRecording(fileName, recording_, message))
  {
    return false;
  }
  if (!isOf(recording_, cloud, message))
  {
    message = fmt::format("{}: the cloud is another one: {}", fileName, message);
    return false;
  }
  // The copy is an object of its own; its points are shared.
  cloud_ = vtkSmartPointer<vtkPointSet>::Take(cloud->NewInstance());
  cloud_->SetPoints(cloud->GetPoints());
  return true;
}

std::optional<AffineTransform> ReplayPlayer::takeModel()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(model_, std::nullopt);
}

std::string ReplayPlayer::takeMessage()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(message_, std::string());
}

void ReplayPlayer::say(const std::string& news)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  message_ = news;
}

void ReplayPlayer::run(ServoLoop& loop)
{
  using Clock = std::chrono::steady_clock;
  const auto secondsOf = [](double seconds)
  { return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)); };
  Replay replay(recording_, cloud_);
  const double begin = recording_.ticks.front().felt[0];
  Clock::time_point start = Clock::now();
  const HapticScene* scene = nullptr;
  while (!replay.isAtEnd() && !thread_.stopIsRequested())
  {
    const RecordedTick& row = replay.row();
    const Clock::time_point due = start + secondsOf(row.felt[0] - begin);
    if (const Clock::duration early = due - Clock::now(); early > Clock::duration::zero())
    {
      std::this_thread::sleep_for(std::min<Clock::duration>(early, kLongestSleep));
      if (Clock::now() < due)
      {
        continue;
      }
    }
    ServoSample sample;
    std::string message;
    if (!replay.step(sample, message))
    {
      this->say(fmt::format("replay: {}: {}", fileName_, message));
      return;
    }
    start = std::max(start, Clock::now() - secondsOf(row.felt[0] - begin) - kLongestSleep);
    sample.buttons = 0; // they did what they did: the recording has it
    loop.feed(sample);
    if (replay.scene() && replay.scene().get() != scene)
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      model_ = replay.scene()->modelToWorkspace();
    }
    scene = replay.scene().get();
    if (row.marker > 0)
    {
      this->say(fmt::format("replay: marker {}", row.marker));
    }
  }
  if (replay.isAtEnd())
  {
    this->say("replay: " + replay.difference().text());
  }
}

} // namespace pointhaptics
