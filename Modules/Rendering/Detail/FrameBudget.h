/// @file
/// Number of points that a frame may draw, learnt from the frames before.
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

#include <cstdint>

namespace pointhaptics
{

/// Fits time = fixed + points * perPoint to the reported frames, the newest counting most, and computes how
/// many points fit into a frame. If all frames had about the same number of points, time is taken as
/// proportional. Plain logic without a clock; not thread safe.
class POINTHAPTICSRENDERING_EXPORT FrameBudget
{
public:
  /// Number of points before the first measurement, and least number of points().
  static constexpr std::int64_t kFirstPoints = 30000;
  static constexpr std::int64_t kFewestPoints = 4000;

  /// @param secondsPerFrame seconds that a frame may take, above 0.
  explicit FrameBudget(double secondsPerFrame = 1.0 / 30.0);

  /// Reports that a frame of @p points took @p seconds. Frames in which anything was uploaded must not be
  /// reported. Numbers that are not finite or not above 0 are ignored. One report changes points() by a
  /// factor between 1/4 and 2.
  void add(std::int64_t points, double seconds);

  /// Number of points that fit.
  std::int64_t points() const { return this->Points; }
  /// Seconds that a frame may take.
  double secondsPerFrame() const { return this->SecondsPerFrame; }

private:
  double SecondsPerFrame;
  std::int64_t Points = kFirstPoints;
  // Sums over the frames; older frames weigh less.
  double Weight = 0.0;
  double SumPoints = 0.0;
  double SumSeconds = 0.0;
  double SumPointsSquared = 0.0;
  double SumProducts = 0.0;
};

} // namespace pointhaptics
