#include "Devices/Sound/TouchSoundFile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace pointhaptics
{
namespace
{

constexpr double kLongestPause = 1.0; // s
constexpr std::uint32_t kHeaderBytes = 44;
constexpr std::uint32_t kBytesPerSample = 2;
/// Most samples that the 32-bit lengths of a header can express.
constexpr std::uint64_t kMostSamples =
  (std::numeric_limits<std::uint32_t>::max() - kHeaderBytes) / kBytesPerSample;

void put(std::string& bytes, std::uint32_t value, int count)
{
  for (int i = 0; i < count; ++i)
  {
    bytes.push_back(static_cast<char>(value >> (8 * i)));
  }
}

std::string header(std::uint64_t samples)
{
  const auto data = static_cast<std::uint32_t>(samples * kBytesPerSample);
  const auto rate = static_cast<std::uint32_t>(ContactTone::kSamplesPerSecond);
  std::string bytes = "RIFF";
  put(bytes, data + kHeaderBytes - 8, 4);
  bytes += "WAVEfmt ";
  put(bytes, 16, 4);
  put(bytes, 1, 2); // whole numbers
  put(bytes, 1, 2); // channels
  put(bytes, rate, 4);
  put(bytes, rate * kBytesPerSample, 4);
  put(bytes, kBytesPerSample, 2);
  put(bytes, 8 * kBytesPerSample, 2);
  bytes += "data";
  put(bytes, data, 4);
  return bytes;
}

} // namespace

std::string TouchSoundFile::problemOfFile() const
{
  return fileName_ + ": cannot be written: " + file_.reason() + "; " + file_.cure();
}

bool TouchSoundFile::open(const std::string& fileName, std::string& message)
{
  fileName_ = fileName;
  isOpen_ = file_.open(fileName) == Status::Ok;
  if (!isOpen_)
  {
    message = this->problemOfFile();
    return false;
  }
  static_cast<void>(file_.write(header(kMostSamples))); // close() tells
  return true;
}

/// Plays the touch for @p seconds more. Samples are counted from the first tick, so that ticks add up.
void TouchSoundFile::play(double seconds)
{
  wanted_ += std::clamp(seconds, 0.0, kLongestPause);
  const auto wanted = static_cast<std::uint64_t>(std::floor(wanted_ * ContactTone::kSamplesPerSecond + 0.5));
  if (!problem_.empty() || wanted > kMostSamples)
  {
    problem_ = problem_.empty()
      ? fileName_ + ": cannot be written: a WAV file ends at 4 GB; feel less than 12 hours at once"
      : problem_;
    return;
  }
  samples_.resize(static_cast<std::size_t>(wanted - written_));
  tone_.render(touch_, samples_.data(), samples_.size());
  std::string bytes;
  for (const float sample : samples_)
  {
    const long value = std::lround(32767.0F * sample);
    put(bytes, static_cast<std::uint32_t>(static_cast<std::int32_t>(value)), kBytesPerSample);
  }
  written_ = wanted;
  problem_ = file_.write(bytes) == Status::Ok ? "" : this->problemOfFile();
}

void TouchSoundFile::add(double time, const HeardTouch& touch)
{
  if (!isOpen_)
  {
    return;
  }
  if (hasBegun_)
  {
    step_ = time - time_;
    this->play(step_);
  }
  hasBegun_ = true;
  time_ = time;
  touch_ = touch;
}

bool TouchSoundFile::close(std::string& message)
{
  if (isOpen_ && hasBegun_)
  {
    this->play(step_); // the last tick is as long as the one before
  }
  if (isOpen_ && problem_.empty())
  {
    if (file_.isReplacing() && file_.flush() == Status::Ok)
    {
      static_cast<void>(file_.writeAt(0, header(written_)));
    }
    problem_ = file_.commit() == Status::Ok ? "" : this->problemOfFile();
  }
  message = problem_.empty() ? message : problem_;
  return problem_.empty();
}

} // namespace pointhaptics
