/// @file
/// Heights of a cloud along a line.
#pragma once

#include "Core/Base/PointView.h"

#include <vtkNew.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class vtkChartXY;
class vtkContextActor;
class vtkRenderer;
class vtkTable;

namespace pointhaptics
{

/// Points of a profile: way along the line, and height along the up axis, in the unit of the cloud.
using ProfilePoints = std::vector<std::array<double, 2>>;

/// The points of @p points that lie within @p width beside the line from @p from to @p to, seen along @p up,
/// and that @p isShown(index) leaves; every k-th, so that there are at most @p most.
template <typename Shown>
ProfilePoints profileAlong(const PointView& points, const Vec3& from, const Vec3& to, const Vec3& up,
  double width, std::size_t most, const Shown& isShown)
{
  const Vec3 level = (to - from) - dot(to - from, up) * up;
  const double length = norm(level);
  const Vec3 along = normalized(level);
  const Vec3 aside = cross(up, along);
  ProfilePoints found;
  for (std::int64_t i = 0; length > 0.0 && i < points.size(); ++i)
  {
    const Vec3 way = points[i] - from;
    const double distance = dot(way, along);
    if (distance >= 0.0 && distance <= length && std::abs(dot(way, aside)) <= width && isShown(i))
    {
      found.push_back({ distance, dot(points[i], up) });
    }
  }
  const std::size_t step = 1 + found.size() / most;
  for (std::size_t i = 0; i * step < found.size(); ++i)
  {
    found[i] = found[i * step];
  }
  found.resize((found.size() + step - 1) / step);
  return found;
}

/// A chart of a profile, in a renderer of its own. GUI thread only.
class HeightProfile
{
public:
  HeightProfile();
  ~HeightProfile();
  HeightProfile(const HeightProfile&) = delete;
  HeightProfile& operator=(const HeightProfile&) = delete;

  vtkRenderer* renderer() { return renderer_; }
  /// Shows these points; lengths are in @p unit.
  void show(const ProfilePoints& points, const std::string& unit);

private:
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkContextActor> actor_;
  vtkNew<vtkChartXY> chart_;
  vtkNew<vtkTable> table_;
};

} // namespace pointhaptics
