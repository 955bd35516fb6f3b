#include "FeelLive.h"

#include "Messages.h"
#include "StopSignals.h"

#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr auto kPause = std::chrono::milliseconds(20);

} // namespace

bool feelLive(const LiveSettings& settings, std::shared_ptr<const HapticScene> scene,
  const std::function<void(const ServoSample&)>& onSample, ServoStatistics& statistics, std::string& message)
{
  rememberStopSignals();
  FalconDevice device(settings.falcon.settings());
  if (device.open() != Status::Ok)
  {
    message = device.message();
    return false;
  }
  ServoLoop loop; // after the device: stops before it closes
  loop.publishScene(std::move(scene));
  if (loop.start(device, settings.parameters, pushingServoSettings(settings.rateHz), &message) != Status::Ok)
  {
    return false;
  }
  FalconNews news;
  std::vector<ServoSample> samples;
  const auto pass = [&]
  {
    samples.clear();
    loop.takeTrace(samples);
    for (const ServoSample& sample : samples)
    {
      if (sample.device == Status::Ok)
      {
        onSample(sample);
      }
    }
  };
  double touchBegan = -1.0;
  while (loop.running() && !stopIsRequested())
  {
    if (const std::string line = news.next(device); !line.empty())
    {
      printNow(stderr, line + "\n");
    }
    pass();
    const double time = loop.latest().timeSeconds;
    touchBegan = touchBegan < 0.0 && device.state() == FalconState::Armed ? time : touchBegan;
    if (settings.seconds > 0.0 && touchBegan >= 0.0 && time - touchBegan >= settings.seconds)
    {
      break;
    }
    std::this_thread::sleep_for(kPause);
  }
  loop.stop();
  pass();
  statistics = loop.statistics();
  device.close();
  if (const std::string refusals = describeRefusals(statistics); !refusals.empty())
  {
    warn("feel", refusals);
  }
  return true;
}

} // namespace app
} // namespace pointhaptics
