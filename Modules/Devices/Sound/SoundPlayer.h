/// @file
/// A servo loop made heard.
#pragma once

#include "Devices/Sound/SoundOutput.h"

#include "Core/Base/StoppableThread.h"

#include <memory>
#include <mutex>
#include <string>

namespace pointhaptics
{

class ServoLoop;

/// A thread that looks at the newest tick for every block of samples (kBlockSeconds) and plays what it says;
/// the servo thread neither waits for it nor knows of it. A contact shorter than a block may not be heard.
/// All but the constructor from one thread (the GUI's).
class SoundPlayer
{
public:
  static constexpr double kBlockSeconds = 0.005;

  /// Plays @p loop, which must outlive stop(), into @p output; what was played before ends.
  void start(const ServoLoop& loop, std::unique_ptr<SoundOutput> output);
  /// Ends within a few blocks.
  void stop();
  bool isPlaying() const { return thread_.isStarted(); }
  /// Problem that ended the sound, with its cure. Empty: none since the last call.
  std::string takeProblem();

private:
  void run(const ServoLoop& loop);

  std::unique_ptr<SoundOutput> output_;
  std::mutex mutex_;
  std::string problem_; ///< Under the mutex.
  StoppableThread thread_;
};

} // namespace pointhaptics
