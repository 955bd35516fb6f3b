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

struct Outputs
{
  float* distances;
  float* normals;

  void set(std::int64_t i, double distance, const Vec3& normal) const
  {
    if (distances)
    {
      distances[i] = float(distance);
    }
    for (int axis = 0; normals && axis < 3; ++axis)
    {
      normals[3 * i + axis] = float(normal[axis]);
    }
  }
};

void sampleRow(const HapticScene& scene, const PointView& points, std::int64_t begin, FitCells& memory,
  const Outputs& outputs)
{
  memory.invalidate();
  const std::int64_t end = std::min(points.size(), begin + kRow);
  for (std::int64_t i = begin; i < end; ++i)
  {
    const Vec3 place = scene.toLattice(points[i]);
    SurfaceTracker tracker;
    if (isFinite(place) && findSheet(scene, memory, place, tracker) &&
      tracker.follow(scene, memory, place) != TrackResult::Lost)
    {
      outputs.set(i, scene.latticeScale() * norm(place - tracker.point()),
        scene.directionToWorkspace(tracker.normal()));
    }
    else
    {
      outputs.set(i, NAN, {});
    }
  }
}

} // namespace

void sampleSurface(const HapticScene& scene, const PointView& points, const Executor& executor,
  float* distances, float* normals)
{
  const Outputs outputs{ distances, normals };
  const std::int64_t rows = (points.size() + kRow - 1) / kRow;
  forRange(executor, rows, 4,
    [&](std::int64_t begin, std::int64_t end)
    {
      const auto memory = std::make_unique<FitCells>();
      for (std::int64_t row = begin; row < end; ++row)
      {
        sampleRow(scene, points, row * kRow, *memory, outputs);
      }
    });
}

} // namespace pointhaptics
