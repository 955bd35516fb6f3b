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
  /// The device's message or the advice for its state, where it changed; empty where nothing did. Looking for
  /// a device that is gone is one state here.
  std::string next(const FalconDevice& device);
  /// As last published.
  FalconState state() const noexcept { return state_; }

private:
  std::string message_;
  FalconState state_ = FalconState::Closed;
};

/// True if a Falcon is plugged in and can be opened; it is not started. False: @p message says why not, with
/// the cure. Not beside a driver that uses one.
bool falconIsUsable(std::string& message);

/// Why @p device could not be opened, with the cure: its own words, else those of @p status.
/// @param firmwareName what the user calls the setting that names the firmware's file.
std::string openProblem(const HapticDevice& device, Status status, const std::string& firmwareName);

/// How the servo loop runs where somebody's hand is in the device: SCHED_FIFO, memory locked, and no force
/// when the program has given no heartbeat for two seconds.
ServoSettings pushingServoSettings(double rateHz);

} // namespace pointhaptics
