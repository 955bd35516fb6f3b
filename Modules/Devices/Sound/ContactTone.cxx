#include "Devices/Sound/ContactTone.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr double kTurn = 6.283185307179586;
constexpr double kSample = 1.0 / ContactTone::kSamplesPerSecond;
/// The click: a higher tone that rises within a millisecond and dies away.
constexpr double kClickHertz = 1500.0;
constexpr double kClickLoudness = 0.30;
constexpr double kClickRise = 0.001;
constexpr double kClickDecay = 0.004;
constexpr double kClickEnd = 0.030;
/// Largest change of loudness in a sample.
constexpr double kStep = ContactTone::kLoudestTone * kSample / ContactTone::kFadeSeconds;

double clickAt(double seconds)
{
  if (seconds >= kClickEnd)
  {
    return 0.0;
  }
  const double rise = std::min(1.0, seconds / kClickRise);
  const double fall = std::min(1.0, (kClickEnd - seconds) / kClickRise); // to zero, without a step
  return kClickLoudness * rise * fall * std::exp(-seconds / kClickDecay) *
    std::sin(kTurn * kClickHertz * seconds);
}

} // namespace

double ContactTone::loudnessOf(double newtons)
{
  const double force = std::isfinite(newtons) ? std::max(0.0, newtons) : 0.0;
  return kLoudestTone * (force / (force + kHalfNewtons));
}

void ContactTone::render(const HeardTouch& touch, float* samples, std::size_t count)
{
  if (touch.contact && !contact_ && clickSeconds_ >= kClickEnd)
  {
    clickSeconds_ = 0.0; // one at a time: a contact that trembles is no drum
  }
  contact_ = touch.contact;
  const double wanted = touch.contact ? ContactTone::loudnessOf(touch.newtons) : 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    loudness_ += std::clamp(wanted - loudness_, touch.contact ? -kStep : -0.5 * kStep, kStep);
    const double sum = loudness_ * std::sin(kTurn * phase_) + clickAt(clickSeconds_);
    samples[i] = static_cast<float>(std::clamp(sum, -kLoudest, kLoudest));
    phase_ += kHertz * kSample;
    phase_ -= std::floor(phase_);
    clickSeconds_ = std::min(1.0, clickSeconds_ + kSample);
  }
}

} // namespace pointhaptics
