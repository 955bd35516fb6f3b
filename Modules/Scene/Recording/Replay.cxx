#include "Replay.h"

#include "LocalSceneProvider.h"
#include "RecordingLines.h"
#include "SceneFilters.h"
#include "VirtualTouch.h"

#include "Haptics/Servo/ServoThread.h"

#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <map>

namespace pointhaptics
{

/// Makes scene after scene as the events of a recording ask for them, and keeps those of the newest event.
/// One thread.
class RecordedScenes
{
public:
  RecordedScenes(const Recording& recording, vtkPointSet* cloud)
    : recording_(recording)
  {
    auto points = vtkSmartPointer<vtkPointSet>::Take(cloud->NewInstance());
    points->SetPoints(cloud->GetPoints()); // no arrays
    whole_.setCloud(points);
    local_.setCloud(cloud->GetPoints());
  }
  /// Makes the scene of an event; events come in their order. Null where there was none. False: @p message
  /// says why it cannot be made.
  bool make(const RecordedEvent& event, std::shared_ptr<const HapticScene>& scene, std::string& message);

private:
  std::shared_ptr<const HapticScene> cloudOf(std::uint64_t number, std::string& problem);
  void keepThoseOf(const RecordedEvent& event);

  const Recording& recording_;
  SceneFilters whole_;
  LocalSceneProvider local_;
  std::map<std::uint64_t, std::shared_ptr<const HapticScene>> clouds_; ///< As they were made.
};

/// As it was made, before it was moved. @p problem: failures of the filters, where there are any.
std::shared_ptr<const HapticScene> RecordedScenes::cloudOf(std::uint64_t number, std::string& problem)
{
  const auto known = clouds_.find(number);
  if (known != clouds_.end())
  {
    return known->second;
  }
  const auto origin = recording_.clouds.find(number);
  if (origin == recording_.clouds.end())
  {
    return nullptr;
  }
  const SceneOrigin& how = *origin->second;
  const auto global = how.isLocal() ? this->cloudOf(how.globalCloud, problem) : nullptr;
  BuiltScene built;
  const auto made = !how.isLocal() ? whole_.makeScene(how, false, built)
    : global                       ? local_.make(how, global)
                                   : nullptr;
  problem = built.problem.empty() ? problem : built.problem;
  return clouds_[number] = made;
}

/// Forgets the scenes that @p event does not use: they would be made again.
void RecordedScenes::keepThoseOf(const RecordedEvent& event)
{
  for (auto cloud = clouds_.begin(); cloud != clouds_.end();)
  {
    const bool isUsed = cloud->first == event.number || cloud->first == event.fallback;
    cloud = isUsed ? std::next(cloud) : clouds_.erase(cloud);
  }
}

bool RecordedScenes::make(
  const RecordedEvent& event, std::shared_ptr<const HapticScene>& scene, std::string& message)
{
  scene.reset();
  this->keepThoseOf(event);
  if (event.number == 0)
  {
    return true;
  }
  Status status = Status::Ok;
  std::string problem;
  scene = this->cloudOf(event.number, problem);
  if (scene && !(scene->modelToWorkspace() == event.model))
  {
    scene = scene->moved(event.model, status);
  }
  if (!scene)
  {
    problem = status != Status::Ok ? pointhaptics::message(status) : problem;
    message = fmt::format("tick {}: the scene cannot be made again{}{}; was the header changed?", event.tick,
      problem.empty() ? "" : ": ", problem);
  }
  return scene != nullptr;
}

Replay::Replay(const Recording& recording, vtkPointSet* cloud, std::optional<ProxyMethod> method)
  : recording_(recording)
  , scenes_(std::make_unique<RecordedScenes>(recording, cloud))
  , method_(method)
  , step_(recording.header.step)
{
  step_.restart(recording.ticks.front().tick);
}

Replay::~Replay() = default;

bool Replay::apply(const RecordedEvent& event, std::string& message)
{
  using Kind = RecordedEvent::Kind;
  switch (event.kind)
  {
    case Kind::Scene:
      former_ = scene_;
      if (!scenes_->make(event, scene_, message))
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
