/// @file
/// Where samples of sound go: the machine's loudspeaker, or a file.
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
  /// Samples of -1 to 1, what is beyond is cut; waits while the output is full. False: @p message says what
  /// failed and the cure, and what comes later is lost.
  virtual bool write(const float* samples, std::size_t count, std::string& message) = 0;
};

/// The machine's default output, by ALSA's library, which is looked for when this is called: a program
/// without it runs, silently. Null: @p message says what is missing and the cure.
std::unique_ptr<SoundOutput> openLoudspeaker(std::string& message, const char* library = "libasound.so.2");

} // namespace pointhaptics
