#include "Haptics/Contact/SurfaceSamples.h"

#include "Haptics/Contact/SurfaceSearch.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace pointhaptics
{
namespace
{

/// Gathered cells serve the next points too, up to rounding. They are dropped after this many points, so that
/// the result does not depend on how the points are shared out among threads.
constexpr std::int64_t kRow = 256;

void sampleRow(const HapticScene& scene, const PointView& points, std::int64_t begin, FitCells& memory,
  float* distances, float* normals)
{
  memory.invalidate();
  const std::int64_t end = std::min(points.size(), begin + kRow);
  for (std::int64_t i = begin; i < end; ++i)
  {
    const Vec3 place = scene.toLattice(points[i]);
    SurfaceTracker tracker;
    const bool isFound = isFinite(place) && findSheet(scene, memory, place, tracker) &&
      tracker.follow(scene, memory, place) != TrackResult::Lost;
    distances[i] = isFound ? float(scene.latticeScale() * norm(place - tracker.point())) : NAN;
    const Vec3 normal = isFound ? scene.directionToWorkspace(tracker.normal()) : Vec3();
    std::transform(&normal.x, &normal.x + 3, normals + 3 * i, [](double n) { return float(n); });
  }
}

} // namespace

void sampleSurface(const HapticScene& scene, const PointView& points, const Executor& executor,
  float* distances, float* normals)
{
  const std::int64_t rows = (points.size() + kRow - 1) / kRow;
  forRange(executor, rows, 4,
    [&](std::int64_t begin, std::int64_t end)
    {
      const auto memory = std::make_unique<FitCells>();
      for (std::int64_t row = begin; row < end; ++row)
      {
        sampleRow(scene, points, row * kRow, *memory, distances, normals);
      }
    });
}

} // namespace pointhaptics
