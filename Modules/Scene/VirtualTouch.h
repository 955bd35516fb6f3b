/// @file
/// A proxy in virtual time: the same input gives the same ticks on every machine, their durations aside.
#pragma once

#include "FeelScenes.h"

#include "Devices/PathUnits.h"
#include "Haptics/Servo/ServoStep.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <array>
#include <cstdint>
#include <functional>

namespace pointhaptics
{

/// Most ticks of a path, a day at 1 kHz; more are a mistake in its times.
constexpr double kMostTicks = 1e8;

/// The columns of OUT.csv, in their order: seconds, metres, newtons, and microseconds at the end.
constexpr std::array<const char*, 16> kFeltColumns = { "t", "hip_x", "hip_y", "hip_z", "proxy_x", "proxy_y",
  "proxy_z", "normal_x", "normal_y", "normal_z", "force_x", "force_y", "force_z", "radius", "contact",
  "update_us" };

/// One tick as a row of these columns.
POINTHAPTICSSCENE_EXPORT std::array<double, kFeltColumns.size()> feltRow(
  double timeSeconds, const ProxyState& state, double microseconds);
inline auto feltRow(double timeSeconds, const ServoSample& sample)
{
  return feltRow(timeSeconds, sample.state, 1e6 * sample.updateSeconds);
}

/// A servo step without force limits, in the scenes along the hand's way. One thread at a time.
class POINTHAPTICSSCENE_EXPORT VirtualTouch
{
public:
  /// @param scenes outlives this.
  VirtualTouch(const HapticParameters& parameters, FeelScenes& scenes, double rateHz);
  /// Steps with @p hand. @return sample(), whose duration is that of the tick alone: a scene that it needs is
  /// there in time.
  const ServoSample& step(const HandState& hand);
  /// Sample of the last step; its tick is the step's number, 1, 2, ...
  const ServoSample& sample() const { return sample_; }
  /// Scene in which the last step was felt; may be null.
  const HapticScene* scene() const { return scene_; }
  /// Settings of all ticks.
  static ServoStepSettings settings(double rateHz);

private:
  FeelScenes& scenes_;
  ServoStep step_;
  const HapticScene* scene_ = nullptr;
  ServoSample sample_;
};

/// Ticks of @p rateHz from the path's first point to its last, both included. False where they are more than
/// @p most: @p message then says so, with @p fileName and the cure, which may be one of @p units
/// (unlikelyUnits()). @pre the path is not empty.
POINTHAPTICSSCENE_EXPORT bool countTicks(const HipPath& path, const std::string& fileName, double rateHz,
  double most, std::int64_t& ticks, std::string& message, const UnitNames& units = {});

/// Called with each tick; the time of its sample counts from the first tick. False stops feelPath().
using OnTick = std::function<bool(double timeSeconds, const VirtualTouch& touch)>;

/// Moves the hand along @p path, whatever the force, linearly between its points, for so many ticks (see
/// countTicks()). @pre HipPath::problem() is empty.
POINTHAPTICSSCENE_EXPORT void feelPath(const HapticParameters& parameters, FeelScenes& scenes,
  const HipPath& path, double rateHz, std::int64_t ticks, const OnTick& onTick);

} // namespace pointhaptics
