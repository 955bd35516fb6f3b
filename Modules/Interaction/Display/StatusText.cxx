#include "StatusText.h"

#include "DeviceClutch.h"
#include "MouseHand.h"
#include "ScenePipeline.h"
#include "SteadyTime.h"

#include "Core/Base/QuantityText.h"
#include "Haptics/ServoLoop.h"

#include <cstdio>

namespace pointhaptics
{
namespace
{

constexpr double kPeriodSeconds = 0.25;
constexpr double kIdlePeriodSeconds = 4.0;
constexpr double kNow = -1e9;
constexpr std::size_t kLongestDevice = 200;

unsigned long long count(std::uint64_t n)
{
  return static_cast<unsigned long long>(n);
}

/// "1 point", "2 points".
std::string counted(vtkIdType n, const char* noun)
{
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

} // namespace

StatusText::StatusText(const CommandRegistry& commands, const ScenePipeline& scenes, const MouseHand& hand,
  const DeviceClutch& clutch)
  : commands_(commands)
  , scenes_(scenes)
  , hand_(hand)
  , clutch_(clutch)
{
}

StatusText::~StatusText() = default;

void StatusText::setOverlay(vtkHapticOverlay* overlay)
{
  overlay_ = overlay;
  lastUpdate_ = kNow;
  this->updateHelp();
}

void StatusText::setNote(const std::string& note)
{
  note_ = note;
  lastUpdate_ = kNow;
}

void StatusText::setDeviceNote(const std::string& note)
{
  deviceNote_ = note;
  lastUpdate_ = kNow;
}

void StatusText::setDeviceName(const std::string& name)
{
  deviceName_ = name;
  lastUpdate_ = kNow;
}

void StatusText::setPanelVisibility(bool visible)
{
  showsPanel_ = visible;
  lastUpdate_ = kNow;
}

void StatusText::turnHelp()
{
  if (overlay_ && !overlay_->ShowNextHelpPage())
  {
    this->updateHelp();
    overlay_->SetHelpVisibility(!overlay_->GetHelpVisibility());
  }
}

void StatusText::updateHelp()
{
  if (overlay_)
  {
    overlay_->SetHelp(commands_.help(), commands_.label("help"));
  }
}

bool StatusText::update(const ServoLoop* servo, bool touchMoved)
{
  const double time = steadySeconds();
  lastMotion_ = touchMoved ? time : lastMotion_;
  hasTouched_ = hasTouched_ || (servo && hand_.followsMouse() && servo->latest().state.contact);
  const bool isIdle = time - lastMotion_ > kIdlePeriodSeconds && !scenes_.isChanged();
  const bool isDue = time - lastUpdate_ >= (isIdle ? kIdlePeriodSeconds : kPeriodSeconds);
  if (!overlay_ || (!isDue && this->handMode() == shownMode_))
  {
    return false;
  }
  lastUpdate_ = time;
  shownMode_ = this->handMode();
  const bool isNewPanel = overlay_->SetPanel(showsPanel_ ? this->panel(servo) : "");
  return overlay_->SetStatus(this->statusLine(servo)) || isNewPanel;
}

/// Name of the hand's mode, a literal.
const char* StatusText::handMode() const
{
  return clutch_.isHolding() ? "    the hand holds the model"
    : !hand_.followsMouse()  ? ""
    : hand_.pushesPointer()  ? "    hand follows the mouse, touch pushes it"
                             : "    hand follows the mouse";
}

/// Text on how the mouse moves the hand, until it has touched something.
std::string StatusText::firstUse() const
{
  if (hasTouched_ || !hand_.followsMouse() || !hand_.hasDevice())
  {
    return {};
  }
  const std::string deeper = commands_.label("hand-away");
  const std::string leave = commands_.label("hand-mode");
  return "\nmove: mouse    deeper: wheel" + (deeper.empty() ? "" : ", " + deeper) +
    (leave.empty() ? "" : "    leave: " + leave);
}

std::string StatusText::resetHint() const
{
  const std::string key = commands_.label("reset-model");
  return key.empty() ? key : ": key " + key + " resets the model";
}

std::string StatusText::statusLine(const ServoLoop* servo) const
{
  char text[320];
  const bool isPending = scenes_.isEmpty() && !scenes_.isSettled();
  std::string status = counted(scenes_.numberOfPoints(), "point");
  if (!isPending)
  {
    status += " in " + counted(scenes_.numberOfVoxels(), "active voxel");
  }
  if (scenes_.isEmpty() && !isPending)
  {
    status += " (nothing in the workspace" + this->resetHint() + ")";
  }
  if (servo)
  {
    const ServoSample latest = servo->latest();
    const ServoStatistics statistics = servo->statistics();
    std::snprintf(text, sizeof(text),
      "\nproxy radius %s    force %.2f N%s\nservo %.0f Hz, %llu deadline miss%s%s",
      lengthText(latest.state.radius).c_str(), norm(latest.state.force),
      latest.state.contact                  ? "    in contact"
        : latest.state.status & kProxyLetGo ? "    let go: the hand was too far from its contact"
                                            : "",
      statistics.rateHz, count(statistics.deadlineMisses), statistics.deadlineMisses == 1 ? "" : "es",
      this->handMode());
    status += text;
    if (!latest.state.contact && !distance_.empty())
    {
      status += "\n" + distance_;
    }
    status += this->firstUse();
  }
  if (!note_.empty())
  {
    status += "\n" + note_;
  }
  const std::string key = commands_.label("help");
  return key.empty() ? status : status + "\n" + key + ": help";
}

std::string StatusText::panel(const ServoLoop* servo) const
{
  const std::string& known = deviceNote_.empty() ? deviceName_ : deviceNote_;
  const std::string device = known.empty() ? "none" : known.substr(0, kLongestDevice);
  if (!servo)
  {
    return "servo loop: none\ndevice: " + device;
  }
  const ServoStatistics statistics = servo->statistics();
  char text[640];
  std::snprintf(text, sizeof(text),
    "servo loop: %s%s\n"
    "rate: %.1f Hz\n"
    "jitter: p50 %.0f us, p99 %.0f us, max %.0f us\n"
    "step time: p50 %.0f us, p99 %.0f us, max %.0f us\n"
    "ticks: %llu, deadline misses: %llu, idle: %llu\n"
    "device faults: %llu, waiting: %llu\n"
    "force limit: %s\n"
    "device: ",
    servo->running() ? "running" : "stopped", statistics.realtime ? ", SCHED_FIFO" : "", statistics.rateHz,
    1e6 * statistics.jitter.p50, 1e6 * statistics.jitter.p99, 1e6 * statistics.jitter.maximum,
    1e6 * statistics.update.p50, 1e6 * statistics.update.p99, 1e6 * statistics.update.maximum,
    count(statistics.ticks), count(statistics.deadlineMisses), count(statistics.idleTicks),
    count(statistics.deviceFaults), count(statistics.waitingTicks), servo->forceLimit().text().c_str());
  return text + device;
}

} // namespace pointhaptics
