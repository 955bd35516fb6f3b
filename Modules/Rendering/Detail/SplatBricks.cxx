#include "SplatBricks.h"

#include "vtkMatrix4x4.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr int kBits = 10; // an axis of the curve

std::uint32_t spread(std::uint32_t v)
{
  v = (v | v << 16) & 0x030000ffu;
  v = (v | v << 8) & 0x0300f00fu;
  v = (v | v << 4) & 0x030c30c3u;
  return (v | v << 2) & 0x09249249u;
}

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

std::vector<SplatBrick> makeBricks(const PointView& points, std::vector<std::int64_t>& ids, std::int64_t size)
{
  Bounds bounds;
  for (const std::int64_t id : ids)
  {
    if (isFinite(points[id]))
    {
      bounds.include(points[id]);
    }
  }
  const Vec3 extent = bounds.empty() ? Vec3() : bounds.extent();
  const double longest = std::max({ extent.x, extent.y, extent.z });
  const double perEdge = longest > 0.0 ? ((1 << kBits) - 1) / longest : 0.0;
  std::vector<std::pair<std::uint32_t, std::int64_t>> order;
  order.reserve(ids.size());
  std::int64_t finite = 0;
  for (const std::int64_t id : ids)
  {
    const Vec3 p = points[id];
    std::uint32_t code = ~0u;
    if (isFinite(p))
    {
      const Vec3 cell = perEdge * (p - bounds.minimum);
      code = spread(std::uint32_t(cell.x)) | spread(std::uint32_t(cell.y)) << 1 |
        spread(std::uint32_t(cell.z)) << 2;
      ++finite;
    }
    order.emplace_back(code, id);
  }
  std::sort(order.begin(), order.end());
  std::vector<SplatBrick> bricks;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    ids[i] = order[i].second;
    if (std::int64_t(i) % size == 0 || std::int64_t(i) == finite)
    {
      bricks.push_back({ std::int64_t(i), std::int64_t(i), Bounds() });
    }
    bricks.back().end = std::int64_t(i) + 1;
    if (std::int64_t(i) < finite)
    {
      bricks.back().box.include(points[ids[i]]);
    }
  }
  return bricks;
}

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
