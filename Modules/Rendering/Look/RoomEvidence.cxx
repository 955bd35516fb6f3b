#include "RoomEvidence.h"

#include "Core/Base/Boxes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pointhaptics
{
namespace
{

constexpr std::int64_t kRoomSample = 20000;
/// Outer part of the points along an axis that may be strays.
constexpr double kOutside = 0.002;
/// Points this near to a side of the box, over its extent, are of that side; those farther than kWithin from
/// all sides stand in the room.
constexpr double kOfSide = 0.03;
constexpr double kWithin = 0.06;
/// Least parts of all points: on the sides together, on each of the least two sides that lie opposite,
/// within.
constexpr double kOnSides = 0.6;
constexpr double kOnEachPair = 0.08;
constexpr double kInside = 0.02;

/// Direction across @p up along which or across which walls lie: the turn that their normals share, but for
/// quarters.
Vec3 alongWalls(const PointView& cloud, const LocalShape& shape, const Vec3& up)
{
  const Vec3 u = anyPerpendicular(up);
  const Vec3 v = cross(up, u);
  double x = 0.0;
  double y = 0.0;
  for (std::int64_t i = 0; i < cloud.size(); i += 1 + cloud.size() / kRoomSample)
  {
    const PointShape& each = shape.at(i);
    const Vec3 n{ double(each.normal[0]), double(each.normal[1]), double(each.normal[2]) };
    const double weight = double(each.flatness) * (1.0 - std::abs(dot(n, up)));
    const double turn = 4.0 * std::atan2(dot(n, v), dot(n, u));
    x += weight * std::cos(turn);
    y += weight * std::sin(turn);
  }
  const double turn = 0.25 * std::atan2(y, x);
  return std::cos(turn) * u + std::sin(turn) * v;
}

} // namespace

bool isFurnishedBox(const PointView& cloud, const LocalShape& shape, const Vec3& up)
{
  const Vec3 along = alongWalls(cloud, shape, up);
  const Vec3 axes[3] = { along, cross(up, along), up };
  std::vector<double> places[3];
  for (std::int64_t i = 0; i < cloud.size(); i += 1 + cloud.size() / kRoomSample)
  {
    for (int axis = 0; axis < 3 && shape.at(i).spacing > 0.0F; ++axis)
    {
      places[axis].push_back(dot(cloud[i], axes[axis]));
    }
  }
  const std::size_t count = places[0].size();
  std::vector<double> nearest(count, INFINITY); // distance to the sides, over the extent
  double fewest = 1.0;
  for (const std::vector<double>& each : places)
  {
    std::vector<double> sorted = each;
    std::sort(sorted.begin(), sorted.end());
    const auto cut = std::size_t(kOutside * double(count));
    const double low = count > 0 ? sorted[cut] : 0.0;
    const double high = count > 0 ? sorted[count - 1 - cut] : 0.0;
    double ofPair = 0.0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const double distance = std::min(each[i] - low, high - each[i]) / (high - low);
      ofPair += distance < kOfSide;
      nearest[i] = std::min(nearest[i], distance);
    }
    fewest = std::min(fewest, ofPair / double(count));
  }
  const auto part = [&](double from, double to)
  {
    return double(std::count_if(nearest.begin(), nearest.end(),
             [&](double distance) { return distance >= from && distance < to; })) /
      double(count);
  };
  return count > 0 && part(-INFINITY, kOfSide) > kOnSides && fewest > kOnEachPair &&
    part(kWithin, INFINITY) > kInside;
}

} // namespace pointhaptics
