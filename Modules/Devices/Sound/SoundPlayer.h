/// @file
/// Plays the touch of a servo loop.
#pragma once

#include "Devices/Sound/SoundOutput.h"

#include "Core/Base/StoppableThread.h"

#include <memory>
#include <mutex>
#include <string>

namespace pointhaptics
{

class ServoLoop;

/// A thread that plays the newest tick, looking at it for every block of samples (kBlockSeconds); the servo
/// thread neither waits for it nor knows of it. A contact shorter than a block may not be heard. All
/// functions but the constructor belong to one thread (the GUI's).
class SoundPlayer
{
public:
  static constexpr double kBlockSeconds = 0.005;

  /// Plays @p loop, which must outlive stop(), into @p output; ends the former sound.
  void start(const ServoLoop& loop, std::unique_ptr<SoundOutput> output);
  /// Ends the sound within a few blocks.
  void stop();
  bool isPlaying() const { return thread_.isStarted(); }
  /// Problem that ended the sound, with its cure. Empty: none since the last call.
  std::string takeProblem();

private:
  void run(const ServoLoop& loop);

  std::unique_ptr<SoundOutput> output_;
  std::mutex mutex_;
  std::string problem_; ///< Guarded by the mutex.
  StoppableThread thread_;
};

} // namespace pointhaptics
