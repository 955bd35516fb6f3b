/// @file
/// Finds the surface at a place among the points, for a tracker to follow.
#pragma once

#include "Haptics/Contact/SurfaceTracker.h"

namespace pointhaptics
{

/// Starts @p tracker on the sheet through the cells about @p onSurface, near enough to follow it; its normal
/// points to either side. False, and nothing changes: there is none.
bool findSheet(
  const HapticScene& scene, FitCells& memory, const Vec3& onSurface, SurfaceTracker& tracker) noexcept;

/// Searches a surface that is seen from a side, and follows it to a target, in three parts: the sheet; the
/// way to the side, so that it does not begin on another face beside an edge; the way to the target. A caller
/// without time for all parts does one in each tick. Plain state; no allocation; one thread.
class SurfaceSearch
{
public:
  /// Begins anew at the cell @p onSurface.
  void begin(const Vec3& onSurface) noexcept;
  void giveUp() noexcept { next_ = Part::None; }
  /// True if no part remains.
  bool isIdle() const noexcept { return next_ == Part::None; }
  /// Does the next part, if any. @return true if found() has come to @p target.
  bool advance(const HapticScene& scene, FitCells& memory, const Vec3& side, const Vec3& target) noexcept;
  /// Does all remaining parts.
  bool finish(const HapticScene& scene, FitCells& memory, const Vec3& side, const Vec3& target) noexcept;
  const SurfaceTracker& found() const noexcept { return tracker_; }

private:
  enum class Part
  {
    None,
    Sheet,
    Side,
    Target,
  };

  SurfaceTracker tracker_;
  Vec3 onSurface_;
  Part next_ = Part::None;
};

} // namespace pointhaptics
