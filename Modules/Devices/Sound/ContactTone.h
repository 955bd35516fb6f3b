/// @file
/// The sound of a touch: a tone as loud as the force, and a click where contact begins.
#pragma once

#include <cstddef>

namespace pointhaptics
{

/// Force and contact at a moment, as they are heard.
struct HeardTouch
{
  double newtons = 0.0;
  bool contact = false;
};

/// Samples of the sound, one after the other. They depend on the touches only, not on how many are asked for
/// at a time. Where nothing is touched there is silence, to the last bit, once the tone has died away
/// (kFadeSeconds). No sample exceeds kLoudest, and loudness never jumps. Neither allocates nor locks; one
/// object serves one thread.
class ContactTone
{
public:
  static constexpr double kSamplesPerSecond = 48000.0;
  static constexpr double kHertz = 330.0;
  /// Largest amplitude, of a full scale of 1: quiet beside the other sounds of a machine.
  static constexpr double kLoudest = 0.35;
  /// Loudness that the tone approaches as the force grows, and the force that has half of it.
  static constexpr double kLoudestTone = 0.20;
  static constexpr double kHalfNewtons = 1.0;
  /// Duration of a change of loudness; twice as long after a release.
  static constexpr double kFadeSeconds = 0.010;

  /// Writes the next @p count samples to @p samples, all of @p touch; a count of 0 notes the beginning of a
  /// contact. A force that is not finite counts as none.
  void render(const HeardTouch& touch, float* samples, std::size_t count);

  /// Loudness of the tone at a force, 0 to kLoudestTone.
  static double loudnessOf(double newtons);

private:
  bool contact_ = false;
  double phase_ = 0.0; ///< Phase of the tone, in periods.
  double loudness_ = 0.0;
  double clickSeconds_ = 1.0; ///< Seconds since contact began.
};

} // namespace pointhaptics
