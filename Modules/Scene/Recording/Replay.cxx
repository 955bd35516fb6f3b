#include "Replay.h"

#include "RecordingLines.h"
#include "VirtualTouch.h"

#include "Haptics/Servo/ServoThread.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

namespace pointhaptics
{

Replay::Replay(const Recording& recording, vtkPointSet* cloud, std::optional<ProxyMethod> method)
  : recording_(recording)
  , scenes_(recording, cloud)
  , method_(method)
  , step_(recording.header.step)
{
  step_.restart(recording.ticks.front().tick);
}

bool Replay::apply(const RecordedEvent& event, std::string& message)
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
    case Kind::Flag:
      flags_ = event.isSet ? flags_ | event.flag : flags_ & ~event.flag;
      if (event.flag == kTickBegins)
      {
        step_.restart(event.tick);
      }
      break;
  }
  return true;
}

bool Replay::step(ServoSample& sample, std::string& message)
{
  const RecordedTick& row = recording_.ticks[next_];
  TickInput input;
  input.number = row.tick;
  input.hand.buttons = row.buttons;
  for (; nextEvent_ < recording_.events.size() && recording_.events[nextEvent_].tick <= row.tick;
       ++nextEvent_)
  {
    if (!this->apply(recording_.events[nextEvent_], message))
    {
      return false;
    }
  }
  input.hand.isNew = (flags_ & kTickNewHand) != 0;
  input.hand.position = flags_ & kTickNonFinite ? Vec3{ NAN, NAN, NAN } : row.hip();
  input.holdsModel = (flags_ & kTickClutched) != 0;
  input.gateIsOpen = !(flags_ & kTickGateClosed);
  input.reading = flags_ & kTickStepped ? Status::Ok : Status::DeviceNotReady;
  const auto before = std::chrono::steady_clock::now();
  {
    const DenormalsAreZero asInTheServoThread;
    step_.step(input, sample_);
  }
  step_.finish(input, flags_ & kTickNotWritten ? Status::DeviceNotReady : Status::Ok, sample_);
  sample_.updateSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  flags_ &= ~kOnceFlags;
  difference_.add(row, sample_);
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
