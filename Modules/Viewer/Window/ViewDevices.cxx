// Devices of the window, which move the hand and the model, and the servo loop.
#include "ViewWindow.h"

#include <fmt/format.h>

namespace pointhaptics
{

void ViewWindow::openSimulated()
{
  SimulatedHandSettings settings;
  settings.workspace = scene_.workspace();
  // The hand starts in front of the cloud, where the person sees it.
  const Bounds& box = scene_.workspace();
  const Vec3 front = scene_.towardsViewer();
  settings.start = box.center() +
    0.47 * Vec3{ front.x * box.extent().x, front.y * box.extent().y, front.z * box.extent().z };
  hand_ = std::make_unique<SimulatedDevice>(settings);
  hand_->setTarget(settings.start);
  device_ = hand_.get();
}

/// Opens the Falcon. Its workspace is the 10 cm cube about the origin, to which the cloud is fitted.
void ViewWindow::openFalcon()
{
  FalconSettings settings = options_.falcon;
  if (!settings.cancelled)
  {
    settings.cancelled = observer_.shouldStop;
  }
  falcon_ = std::make_unique<FalconDevice>(settings);
  device_ = falcon_.get();
  observer_.say(kNote, "falcon: starting; loading its firmware takes some seconds");
}

bool ViewWindow::openDevice(std::string& message)
{
  std::string unusable;
  if (!options_.replay.empty())
  {
    if (!this->openReplay(message))
    {
      return false;
    }
  }
  else if (!options_.path.empty())
  {
    HipPath path;
    if (readHipPath(options_.path, path, message) != Status::Ok)
    {
      return false;
    }
    applyUnits(options_.pathUnits, path);
    SimulatedHandSettings settings;
    settings.yieldsToForce = false;
    settings.holdsAtEnd = true;
    replay_ = std::make_unique<SimulatedDevice>(settings);
    replay_->setPath(std::move(path));
    device_ = replay_.get();
  }
  else if (options_.device == HapticViewerDevice::Falcon ||
    (options_.device == HapticViewerDevice::Auto && falconIsUsable(unusable)))
  {
    this->openFalcon();
  }
  else if (options_.device != HapticViewerDevice::None)
  {
    this->openSimulated();
  }
  Status status = device_ ? device_->open() : Status::Ok;
  if (status != Status::Ok && falcon_ && options_.device == HapticViewerDevice::Auto && !observer_.stops())
  {
    news_ = fmt::format("the Falcon cannot be used: {}; the simulated hand takes its place",
      openProblem(*falcon_, status, options_.names.firmware));
    observer_.say(kWarning, news_);
    falcon_.reset();
    this->openSimulated();
    status = device_->open();
  }
  if (status != Status::Ok)
  {
    message = fmt::format("the {} device cannot be used: {}", device_->name(),
      openProblem(*device_, status, options_.names.firmware));
    return false;
  }
  style_->SetDevice(device_);
  style_->SetServoLoop(device_ || player_ ? &servo_ : nullptr);
  // A SpaceMouse may be plugged in later; without its driver the window does without.
  static_cast<void>(spaceMouse_.start());
  style_->SetSpaceMouse(&spaceMouse_);
  return true;
}

/// Starts the servo loop, after the first scene was published: a path must not begin in an empty world.
bool ViewWindow::startServo(std::string& message)
{
  if (const std::string odd = style_->JudgeUnits(options_.names.units); !odd.empty())
  {
    observer_.say(kWarning, options_.path + ": " + odd);
  }
  if (player_)
  {
    const Status status = servo_.startFed(player_->stepSettings());
    player_->start(servo_);
    return status == Status::Ok;
  }
  ServoSettings settings = falcon_ ? pushingServoSettings(1000.0) : ServoSettings();
  settings.idlesWhenStill = options_.trace.empty() && options_.record.empty(); // these have all ticks
  const Status status = device_ ? servo_.start(*device_, options_.haptics, settings, &message) : Status::Ok;
  return status == Status::Ok;
}

void ViewWindow::followDevices()
{
  if (falcon_)
  {
    const FalconState before = falconUpdates_.state();
    const std::string news = falconUpdates_.next(*falcon_);
    if (falconUpdates_.state() != before)
    {
      style_->GetStatus().setDeviceNote(fmt::format("falcon, {}", name(falconUpdates_.state())));
    }
    if (!news.empty())
    {
      this->say(news);
    }
  }
  const std::string spaceMouse = spaceMouse_.message();
  if (spaceMouse != spaceMouseMessage_)
  {
    spaceMouseMessage_ = spaceMouse;
    if (spaceMouse_.motion().connected)
    {
      this->say(fmt::format("spacemouse: {} moves the model", spaceMouse));
    }
    else if (spaceMouse != SpaceMouse::kNonePluggedIn)
    {
      this->say(spaceMouse);
    }
  }
}

} // namespace pointhaptics
