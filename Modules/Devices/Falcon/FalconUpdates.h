/// @file
/// Messages for the user of a Falcon while it starts and works, and the settings of a servo loop with it.
#pragma once

#include "Devices/Falcon/FalconDevice.h"

#include "Haptics/ServoLoop.h"

#include <string>

namespace pointhaptics
{

/// Advice for the person in @p state; empty where none is needed.
std::string advice(FalconState state);

/// Messages about a Falcon in use, each once. One thread, not the servo's.
class FalconUpdates
{
public:
  /// Returns the device's message or the advice for its state where it changed, else an empty text. The
  /// search for a device that is gone counts as one state.
  std::string next(const FalconDevice& device);
  /// State at the last call of next().
  FalconState state() const noexcept { return state_; }

private:
  std::string message_;
  FalconState state_ = FalconState::Closed;
};

/// True if a Falcon is plugged in and can be opened; it is not started. False: @p message says why not, with
/// the cure. Not beside a driver that uses one.
bool falconIsUsable(std::string& message);

/// Reason why @p device could not be opened, with the cure: its own message, else that of @p status. @param
/// firmwareName the user's name for the setting with the firmware's file.
std::string openProblem(const HapticDevice& device, Status status, const std::string& firmwareName);

/// Settings of a servo loop with a device that pushes a hand: SCHED_FIFO, memory locked, and no force when
/// the program has given no heartbeat for two seconds.
ServoSettings pushingServoSettings(double rateHz);

} // namespace pointhaptics
