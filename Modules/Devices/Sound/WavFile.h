/// @file
/// Sound as a WAV file.
#pragma once

#include "Core/Base/OutputFile.h"
#include "Devices/Sound/SoundOutput.h"

#include <cstdint>
#include <string>

namespace pointhaptics
{

/// A WAV file of one channel of 16 bits, ContactTone::kSamplesPerSecond. It appears with close(); a pipe gets
/// a header without the length, which is not known before.
class WavFile : public SoundOutput
{
public:
  /// False: @p message says why the file cannot be created.
  bool open(const std::string& fileName, std::string& message);
  bool write(const float* samples, std::size_t count, std::string& message) override;
  /// False: @p message says what is lost.
  bool close(std::string& message);
  std::uint64_t numberOfSamples() const { return samples_; }

private:
  bool fail(const std::string& reason, const std::string& cure, std::string& message) const;

  std::string fileName_;
  OutputFile file_;
  std::uint64_t samples_ = 0;
};

} // namespace pointhaptics
