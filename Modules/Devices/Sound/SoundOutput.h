/// @file
/// Receiver of sound samples: the machine's loudspeaker, or a file.
#pragma once

#include "Core/Base/Status.h"

#include <cstddef>
#include <memory>
#include <string>

namespace pointhaptics
{

/// One channel of ContactTone::kSamplesPerSecond. One object serves one thread at a time.
class SoundOutput
{
public:
  virtual ~SoundOutput() = default;
  /// Takes samples of -1 to 1 and cuts larger ones; waits while the output is full. False: @p message names
  /// the fault and the cure, and later samples are lost.
  virtual bool write(const float* samples, std::size_t count, std::string& message) = 0;
};

/// Opens the machine's default output by ALSA's library, which is looked for by this call: a program without
/// it runs silently. Null: @p message says what is missing and the cure.
std::unique_ptr<SoundOutput> openLoudspeaker(std::string& message, const char* library = "libasound.so.2");

} // namespace pointhaptics
