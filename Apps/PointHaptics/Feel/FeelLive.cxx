#include "Feel/FeelCommand.h"

#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include "Core/Base/StoppableThread.h"

#include <chrono>
#include <cstdio>
#include <thread>

namespace pointhaptics::app
{
namespace
{

constexpr auto kPause = std::chrono::milliseconds(20);

/// Gives the samples that came since the last call to the recording and, where the device spoke, to onSample.
void passSamples(ServoLoop& loop, RecordingWriter& recording, std::vector<ServoSample>& samples,
  const std::function<void(const ServoSample&)>& onSample)
{
  samples.clear();
  loop.takeTrace(samples);
  recording.add(loop, samples);
  for (const ServoSample& sample : samples)
  {
    if (sample.device == Status::Ok)
    {
      onSample(sample);
    }
  }
}

} // namespace

ServoStatistics FeelCommand::feelLive(FeelScenes& scenes, RecordingWriter& recording,
  const std::function<void(const ServoSample&)>& onSample) const
{
  rememberStopSignals();
  FalconDevice falconDevice(this->falcon.settings());
  const Status status = falconDevice.open();
  require(status == Status::Ok, openProblem(falconDevice, status, kFirmwareOption));
  ServoLoop loop; // after the device: stops before it closes
  loop.publishScene(scenes.whole());
  std::string problem;
  const Status started =
    loop.start(falconDevice, this->touch.parameters, pushingServoSettings(this->rateHz), &problem);
  require(started == Status::Ok, problem);
  StoppableThread sceneThread;
  scenes.publishNearHand(loop, sceneThread);
  FalconUpdates updates;
  std::vector<ServoSample> samples;
  const auto pass = [&] { passSamples(loop, recording, samples, onSample); };
  double touchBegan = -1.0;
  while (loop.running() && !stopIsRequested())
  {
    if (const std::string line = updates.next(falconDevice); !line.empty())
    {
      printNow(stderr, line + "\n");
    }
    pass();
    const double time = loop.latest().timeSeconds;
    touchBegan = touchBegan < 0.0 && falconDevice.state() == FalconState::Armed ? time : touchBegan;
    if (this->seconds > 0.0 && touchBegan >= 0.0 && time - touchBegan >= this->seconds)
    {
      break;
    }
    std::this_thread::sleep_for(kPause);
  }
  sceneThread.stop();
  loop.stop();
  pass();
  falconDevice.close();
  warn(describeRefusals(loop.statistics()));
  return loop.statistics();
}

} // namespace pointhaptics::app
