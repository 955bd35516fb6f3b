#include "SplatBricks.h"

#include "vtkMatrix4x4.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// Takes a half space into the points' frame.
HalfSpace inFrame(const HalfSpace& plane, vtkMatrix4x4* toWorld)
{
  HalfSpace moved{};
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      const double element = toWorld ? toWorld->GetElement(row, column) : double(row == column);
      moved[std::size_t(column)] += plane[std::size_t(row)] * element;
    }
  }
  return moved;
}

bool meets(const Bounds& box, const HalfSpace& plane, double margin)
{
  double most = plane[3] + margin * std::hypot(plane[0], plane[1], plane[2]);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double slope = plane[std::size_t(axis)];
    most += slope * (slope > 0.0 ? box.maximum[axis] : box.minimum[axis]);
  }
  return most >= 0.0;
}

} // namespace

std::vector<SplatBrick> makeRows(const PointView& points, std::int64_t size)
{
  std::vector<SplatBrick> rows;
  for (std::int64_t begin = 0; begin < points.size(); begin += size)
  {
    rows.push_back({ begin, std::min(begin + size, points.size()), Bounds() });
    bool isFinite = true;
    for (std::int64_t i = begin; i < rows.back().end; ++i)
    {
      isFinite = isFinite && pointhaptics::isFinite(points[i]);
      rows.back().box.include(points[i]);
    }
    if (!isFinite)
    {
      rows.back().box = Bounds(); // always drawn
    }
  }
  return rows;
}

std::vector<std::array<vtkIdType, 2>> visibleRanges(const std::vector<SplatBrick>& bricks,
  const std::vector<HalfSpace>& halfSpaces, vtkMatrix4x4* toWorld, double margin)
{
  std::vector<HalfSpace> planes;
  for (const HalfSpace& plane : halfSpaces)
  {
    planes.push_back(inFrame(plane, toWorld));
  }
  std::vector<std::array<vtkIdType, 2>> ranges;
  for (const SplatBrick& brick : bricks)
  {
    const bool seen = brick.box.empty() ||
      std::all_of(planes.begin(), planes.end(),
        [&](const HalfSpace& plane) { return meets(brick.box, plane, margin); });
    if (seen && !ranges.empty() && ranges.back()[1] == brick.begin)
    {
      ranges.back()[1] = brick.end;
    }
    else if (seen)
    {
      ranges.push_back({ brick.begin, brick.end });
    }
  }
  return ranges;
}

} // namespace pointhaptics
