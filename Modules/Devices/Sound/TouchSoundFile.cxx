#include "Devices/Sound/TouchSoundFile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pointhaptics
{
namespace
{

constexpr double kLongestPause = 1.0; // s

} // namespace

bool TouchSoundFile::open(const std::string& fileName, std::string& message)
{
  isOpen_ = file_.open(fileName, message);
  return isOpen_;
}

/// Plays the touch for @p seconds more. Samples are counted from the first tick, so that ticks add up.
void TouchSoundFile::play(double seconds)
{
  wanted_ += std::clamp(seconds, 0.0, kLongestPause);
  const double samples = std::floor(wanted_ * ContactTone::kSamplesPerSecond + 0.5);
  samples_.resize(static_cast<std::size_t>(samples) - file_.numberOfSamples());
  tone_.render(touch_, samples_.data(), samples_.size());
  if (problem_.empty() && !file_.write(samples_.data(), samples_.size(), problem_))
  {
    isOpen_ = false;
  }
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
  if (!problem_.empty())
  {
    message = problem_;
    return false;
  }
  return !isOpen_ || file_.close(message);
}

} // namespace pointhaptics
