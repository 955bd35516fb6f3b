/// @file
/// One run of the servo loop under a stated load, and what its statistics say.
#pragma once

#include "Haptics/ServoLoop.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace pointhaptics
{
namespace bench
{
namespace servo
{

enum class Hand
{
  Simulated, ///< A mass on a spring, pulled along the path.
  Falcon,    ///< The Falcon's driver on a wire in memory: codec, kinematics, force chain; no USB.
};

enum class Load
{
  Idle,
  Busy,      ///< A thread per core that never rests.
  Rendering, ///< The calling thread draws, 30 times a second or as often as it can.
};

struct Setting
{
  Hand hand = Hand::Simulated;
  Load load = Load::Idle;
  double rateHz = 1000.0;
  double seconds = 10.0;
  std::function<void()> draw; ///< One frame; needed where the load is Rendering.
};

struct Outcome
{
  ServoStatistics statistics;
  double contactFraction = 0.0; ///< Of the traced ticks.
  double largestError = 0.0;    ///< Of the force against that of the ideal sphere, N.
  double framesPerSecond = 0.0;
  /// Of an empty loop beside this one, at the same time; where the machine was idle otherwise and a core was
  /// left for it.
  struct Empty
  {
    std::uint64_t deadlineMisses = 0;
    double largestJitter = 0.0; ///< Seconds.
  };
  std::optional<Empty> empty;
};

const char* name(Hand hand);
const char* name(Load load);

/// A sphere of 25 mm radius, @p count points at random.
std::shared_ptr<const HapticScene> sphereScene(int count);

/// The hand presses up to 2 mm into the sphere and slides over it at 50 mm/s.
Outcome run(const Setting& setting, const std::shared_ptr<const HapticScene>& scene);

} // namespace servo
} // namespace bench
} // namespace pointhaptics
