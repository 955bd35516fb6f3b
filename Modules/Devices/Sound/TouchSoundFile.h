/// @file
/// A touch as a sound file.
#pragma once

#include "Devices/Sound/ContactTone.h"

#include "Core/Base/OutputFile.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{

/// A WAV file as long as the touch, each tick being heard until the next one: one channel of 16 bits,
/// ContactTone::kSamplesPerSecond. It appears with close(); a pipe gets a header without the length, which is
/// not known before.
class TouchSoundFile
{
public:
  /// False: @p message says why the file cannot be created.
  bool open(const std::string& fileName, std::string& message);
  /// Plays @p touch from @p time on, seconds; a pause longer than a second is cut to one.
  void add(double time, const HeardTouch& touch);
  /// False: @p message says what is lost. True also where it was not opened.
  bool close(std::string& message);

private:
  void play(double seconds);
  std::string problemOfFile() const;

  std::string fileName_;
  OutputFile file_;
  ContactTone tone_;
  std::vector<float> samples_;
  bool isOpen_ = false;
  bool hasBegun_ = false;
  HeardTouch touch_;
  double time_ = 0.0;         ///< Time of the newest tick.
  double step_ = 0.0;         ///< Time between the last two ticks.
  double wanted_ = 0.0;       ///< Seconds of sound so far.
  std::uint64_t written_ = 0; ///< Samples in the file.
  std::string problem_;
};

} // namespace pointhaptics
