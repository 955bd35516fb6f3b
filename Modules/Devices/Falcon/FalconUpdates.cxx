#include "Devices/Falcon/FalconUpdates.h"

#include "Devices/DeviceList.h"

#include <vector>

namespace pointhaptics
{
namespace
{

constexpr double kWatchdogTimeoutSeconds = 2.0;

/// True for the states of a device that is gone, which follow each other for as long as it is.
bool isAway(FalconState state)
{
  return state == FalconState::Opening || state == FalconState::Boot || state == FalconState::Fault;
}

} // namespace

std::string advice(FalconState state)
{
  switch (state)
  {
    case FalconState::Opening:
      return "falcon: not there; plug it in, it starts by itself";
    case FalconState::Boot:
    case FalconState::Loading:
      return "falcon: starting";
    case FalconState::Unhomed:
      return "falcon: blue LED: pull the grip all the way out, then push it all the way in";
    case FalconState::Homed:
      return "falcon: ready, without force";
    case FalconState::Armed:
      return "falcon: green LED: forces come up within a second";
    case FalconState::Fault:
      return "falcon: lost; check its cable and its power supply, it starts again by itself";
    case FalconState::Closed:
      break;
  }
  return {};
}

std::string FalconUpdates::next(const FalconDevice& device)
{
  const std::string message = device.message();
  if (message != message_)
  {
    message_ = message;
    if (!message.empty())
    {
      return message;
    }
  }
  const FalconState now = device.state();
  if (now == state_ || (isAway(now) && isAway(state_)))
  {
    return {};
  }
  state_ = now;
  return advice(now);
}

bool falconIsUsable(std::string& message)
{
  std::vector<ListedDevice> found;
  std::vector<std::string> notes;
  listFalcons(found, notes);
  message = found.empty() ? "falcon: " + notes.front() : found.front().problem;
  return message.empty();
}

std::string openProblem(const HapticDevice& device, Status status, const std::string& firmwareName)
{
  const std::string said = device.message();
  return (said.empty() ? pointhaptics::message(status) : said) +
    (status == Status::FirmwareMissing ? "; here it is named with " + firmwareName : std::string());
}

ServoSettings pushingServoSettings(double rateHz)
{
  ServoSettings settings;
  settings.rateHz = rateHz;
  settings.lockMemory = true;
  settings.keepCoresAwake = true;
  settings.watchdogSeconds = kWatchdogTimeoutSeconds;
  return settings;
}

} // namespace pointhaptics
