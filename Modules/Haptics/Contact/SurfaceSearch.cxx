#include "Haptics/Contact/SurfaceSearch.h"

#include <algorithm>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Finds the sheet by fits of one radius. The plane to begin with is that of points at several distances: at
/// an edge the nearer ones lie on one face, in noise the farther ones tell.
bool findSheet(const HapticScene& scene, FitCells& memory, const Vec3& onSurface, double radius, double gate,
  SurfaceTracker& tracker) noexcept
{
  for (const double part : { 1.0, 0.7, 1.4 })
  {
    SurfaceFrame frame;
    SurfaceFit fit;
    double curvature[3] = { 0.0, 0.0, 0.0 };
    Vec3 normal;
    if (!principalNormal(scene.pyramid(), onSurface, part * radius, memory, normal))
    {
      continue;
    }
    frame.turnTo(normal);
    if (settleOnSurface(scene.pyramid(), onSurface, radius, gate, memory, frame, fit, curvature) &&
      norm2(frame.origin - onSurface) <= radius * radius)
    {
      tracker.start(frame, curvature);
      return true;
    }
  }
  return false;
}

}

bool findSheet(
  const HapticScene& scene, FitCells& memory, const Vec3& onSurface, SurfaceTracker& tracker) noexcept
{
  Vec3 ignored;
  const LocalScale scale = scene.fitScale(onSurface, memory, ignored);
  const double gate = std::max(2.0 * kGateDepth * scale.countRadius, scale.gate);
  bool found = false;
  double radius = scale.radius;
  for (int widening = 0; widening <= SurfaceTracker::kWidenings && !found;
       ++widening, radius *= SurfaceTracker::kWidening)
  {
    found = findSheet(scene, memory, onSurface, radius, gate, tracker);
  }
  return found;
}

void SurfaceSearch::begin(const Vec3& onSurface) noexcept
{
  onSurface_ = onSurface;
  next_ = Part::Sheet;
}

bool SurfaceSearch::advance(
  const HapticScene& scene, FitCells& memory, const Vec3& side, const Vec3& target) noexcept
{
  const auto reaches = [&](const Vec3& place)
  { return tracker_.follow(scene, memory, place) <= TrackResult::RoundLimit; };
  switch (std::exchange(next_, Part::None))
  {
    case Part::Sheet:
      if (findSheet(scene, memory, onSurface_, tracker_))
      {
        tracker_.lookFrom(side);
        next_ = Part::Side;
      }
      return false;
    case Part::Side:
      next_ = reaches(side) && tracker_.height(side) >= 0.0 ? Part::Target : Part::None;
      return false;
    case Part::Target:
      return reaches(target);
    case Part::None:
      break;
  }
  return false;
}

bool SurfaceSearch::finish(
  const HapticScene& scene, FitCells& memory, const Vec3& side, const Vec3& target) noexcept
{
  bool isFound = false;
  while (next_ != Part::None)
  {
    isFound = this->advance(scene, memory, side, target);
  }
  return isFound;
}

} // namespace pointhaptics
