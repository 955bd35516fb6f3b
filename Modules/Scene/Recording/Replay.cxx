#include "Replay.h"

#include "VirtualTouch.h"

#include "Haptics/Servo/ServoThread.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

namespace pointhaptics
{

Replay::Replay(const Recording& recording, RecordedScenes& scenes, std::optional<ProxyMethod> method)
  : recording_(recording)
  , scenes_(scenes)
  , method_(method)
  , step_(recording.header.step)
{
  step_.restart(recording.ticks.front().tick);
}

bool Replay::apply(const RecordedEvent& event, TickInput& input, std::string& message)
{
  using Kind = RecordedEvent::Kind;
  switch (event.kind)
  {
    case Kind::Scene:
      former_ = scene_;
      if (!scenes_.make(event, scene_, message))
      {
        return false;
      }
      ++sample_.scenes;
      sample_.scene = scene_ ? scene_->number() : 0;
      step_.setScene(scene_.get());
      break;
    case Kind::Parameters:
    {
      HapticParameters parameters = recording_.parameters.at(event.number);
      parameters.method = method_.value_or(parameters.method);
      sample_.parameters = event.number;
      step_.setParameters(parameters);
      break;
    }
    case Kind::Clutch:
      clutched_ = event.on;
      break;
    case Kind::Gate:
      gateIsOpen_ = event.on;
      break;
    case Kind::Reading:
      reading_ = event.on;
      break;
    case Kind::Writing:
      writing_ = event.on;
      break;
    case Kind::NewHand:
      input.hand.isNew = true;
      break;
    case Kind::NoPosition:
      input.hand.position = { NAN, NAN, NAN };
      break;
    case Kind::Begins:
      step_.restart(event.tick);
      break;
  }
  return true;
}

bool Replay::step(ServoSample& sample, std::string& message)
{
  const RecordedTick& row = recording_.ticks[next_];
  TickInput input;
  input.number = row.tick;
  input.hand.position = row.hip();
  input.hand.buttons = row.buttons;
  for (; nextEvent_ < recording_.events.size() && recording_.events[nextEvent_].tick <= row.tick;
       ++nextEvent_)
  {
    if (!this->apply(recording_.events[nextEvent_], input, message))
    {
      return false;
    }
  }
  input.holdsModel = clutched_;
  input.gateIsOpen = gateIsOpen_;
  input.reading = reading_ ? Status::Ok : Status::DeviceNotReady;
  const auto before = std::chrono::steady_clock::now();
  {
    const DenormalsAreZero asInTheServoThread;
    step_.step(input, sample_);
  }
  step_.finish(input, writing_ ? Status::Ok : Status::DeviceNotReady, sample_);
  sample_.updateSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  ++next_;
  sample = sample_;
  return true;
}

void ReplayDifference::add(const RecordedTick& row, const ServoSample& sample)
{
  auto felt = feltRow(sample.timeSeconds, sample.state, 0.0);
  auto recorded = row.felt;
  recorded.back() = 0.0; // how long it took
  const bool isSame = std::memcmp(felt.data(), recorded.data(), sizeof recorded) == 0;
  ++ticks;
  sameTicks += isSame;
  firstTick = isSame || firstTick != 0 ? firstTick : row.tick;
  largest = std::max(largest, norm(sample.state.force - row.force()));
}

std::string ReplayDifference::text() const
{
  return sameTicks == ticks
    ? fmt::format("all {} ticks are as they were recorded, to the last bit", ticks)
    : fmt::format("{} of {} ticks differ from the recorded ones, by up to {:.3g} N; the first is tick {}",
        ticks - sameTicks, ticks, largest, firstTick);
}

} // namespace pointhaptics
