/// @file
/// `feel --device falcon`: the hand in the device, in real time, without a window.
#pragma once

#include "Options/FalconOptions.h"

#include "FeelScenes.h"
#include "RecordingWriter.h"

#include <functional>
#include <string>

namespace pointhaptics::app
{

struct LiveSettings
{
  FalconOptions falcon;
  HapticParameters parameters;
  double rateHz = 1000.0;
  RecordingWriter* recording = nullptr; ///< Gets all ticks; may be null.
  double seconds = 0.0; ///< Duration of the touch, from the first tick with forces on; 0: until a stop
                        ///< signal.
};

/// Runs the servo loop on the Falcon; @p onSample gets every tick that had a position. Local scenes are made
/// in a thread of their own; until one is there, the whole cloud's is felt. False: @p message says what
/// failed and the cure.
bool feelLive(const LiveSettings& settings, FeelScenes& scenes,
  const std::function<void(const ServoSample&)>& onSample, ServoStatistics& statistics, std::string& message);

} // namespace pointhaptics::app
