#include "StatusText.h"

#include "DeviceClutch.h"
#include "MouseHand.h"
#include "ScenePipeline.h"
#include "SteadyTime.h"

#include "Core/Base/QuantityText.h"
#include "Haptics/ServoLoop.h"

#include <fmt/format.h>

namespace pointhaptics
{
namespace
{

constexpr double kPeriodSeconds = 0.25;
constexpr double kIdlePeriodSeconds = 4.0;
constexpr std::size_t kLongestDevice = 200;

/// "1 point", "2 points".
std::string counted(vtkIdType n, const char* noun)
{
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

} // namespace

void StatusText::setOverlay(vtkHapticOverlay* overlay)
{
  this->set(overlay_, vtkSmartPointer<vtkHapticOverlay>(overlay));
  this->updateHelp();
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
  const bool isPending = scenes_.isEmpty() && !scenes_.isSettled();
  std::string status = counted(scenes_.numberOfPoints(), "point");
  if (!isPending)
  {
    status += " in " + counted(scenes_.numberOfVoxels(), "active voxel");
  }
  if (scenes_.isEmpty() && !isPending)
  {
    status +=
      " (" + (emptyCause_.empty() ? "nothing in the workspace" + this->resetHint() : emptyCause_) + ")";
  }
  if (servo)
  {
    const ServoSample latest = servo->latest();
    const ServoStatistics statistics = servo->statistics();
    const std::string radius =
      latest.state.radius > 0.0 ? "proxy radius " + lengthText(latest.state.radius) + "    " : "";
    status += fmt::format("\n{}force {:.2f} N{}\nservo {:.0f} Hz, {} deadline miss{}{}", radius,
      norm(latest.state.force),
      latest.state.contact                  ? "    in contact"
        : latest.state.status & kProxyLetGo ? "    let go: the hand was too far from its contact"
                                            : "",
      statistics.rateHz, statistics.deadlineMisses, statistics.deadlineMisses == 1 ? "" : "es",
      this->handMode());
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
  const auto microseconds = [](const auto& of)
  {
    return fmt::format(
      "p50 {:.0f} us, p99 {:.0f} us, max {:.0f} us", 1e6 * of.p50, 1e6 * of.p99, 1e6 * of.maximum);
  };
  return fmt::format("servo loop: {}{}\n"
                     "rate: {:.1f} Hz\n"
                     "jitter: {}\n"
                     "step time: {}\n"
                     "ticks: {}, deadline misses: {}, idle: {}\n"
                     "device faults: {}, waiting: {}\n"
                     "force limit: {}\n"
                     "device: {}",
    servo->running() ? "running" : "stopped", statistics.realtime ? ", SCHED_FIFO" : "", statistics.rateHz,
    microseconds(statistics.jitter), microseconds(statistics.update), statistics.ticks,
    statistics.deadlineMisses, statistics.idleTicks, statistics.deviceFaults, statistics.waitingTicks,
    servo->forceLimit().text(), device);
}

} // namespace pointhaptics
