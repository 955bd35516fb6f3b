#include "Devices/Sound/WavFile.h"

#include "Devices/Sound/ContactTone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pointhaptics
{
namespace
{

constexpr std::uint32_t kHeaderBytes = 44;
constexpr std::uint32_t kBytesPerSample = 2;
/// Most samples that the 32-bit lengths of a header can express.
constexpr std::uint64_t kMostSamples =
  (std::numeric_limits<std::uint32_t>::max() - kHeaderBytes) / kBytesPerSample;

void add(std::string& bytes, std::uint32_t value, int count)
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
  add(bytes, data + kHeaderBytes - 8, 4);
  bytes += "WAVEfmt ";
  add(bytes, 16, 4);
  add(bytes, 1, 2); // whole numbers
  add(bytes, 1, 2); // channels
  add(bytes, rate, 4);
  add(bytes, rate * kBytesPerSample, 4);
  add(bytes, kBytesPerSample, 2);
  add(bytes, 8 * kBytesPerSample, 2);
  bytes += "data";
  add(bytes, data, 4);
  return bytes;
}

} // namespace

bool WavFile::fail(const std::string& reason, const std::string& cure, std::string& message) const
{
  message = fileName_ + ": cannot be written: " + reason + "; " + cure;
  return false;
}

bool WavFile::open(const std::string& fileName, std::string& message)
{
  fileName_ = fileName;
  if (file_.open(fileName) != Status::Ok)
  {
    return this->fail(file_.reason(), file_.cure(), message);
  }
  static_cast<void>(file_.write(header(kMostSamples))); // close() tells
  return true;
}

bool WavFile::write(const float* samples, std::size_t count, std::string& message)
{
  if (count > kMostSamples - samples_)
  {
    return this->fail("a WAV file ends at 4 GB", "feel less than 12 hours at once", message);
  }
  std::string bytes;
  bytes.reserve(kBytesPerSample * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const long value = std::lround(32767.0F * std::clamp(samples[i], -1.0F, 1.0F));
    add(bytes, static_cast<std::uint32_t>(static_cast<std::int32_t>(value)), kBytesPerSample);
  }
  samples_ += count;
  return file_.write(bytes) == Status::Ok || this->fail(file_.reason(), file_.cure(), message);
}

bool WavFile::close(std::string& message)
{
  if (file_.isReplacing() && file_.flush() == Status::Ok)
  {
    static_cast<void>(file_.writeAt(0, header(samples_)));
  }
  return file_.commit() == Status::Ok || this->fail(file_.reason(), file_.cure(), message);
}

} // namespace pointhaptics
