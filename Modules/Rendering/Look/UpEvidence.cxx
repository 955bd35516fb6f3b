#include "UpEvidence.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pointhaptics
{
namespace
{

constexpr std::int64_t kEvidence = 20000;
constexpr std::size_t kFewest = 200; ///< Fewer points have no shape.
constexpr double kStrays = 0.005;    ///< Part of the points beyond either end of an axis.
/// An end is this part of the extent of its axis; its cover is counted in a grid of so many cells across.
constexpr double kEnd = 0.05;
constexpr int kCells = 12;
/// A long axis is this many times the next one; its foot bears this many times as much as its head.
constexpr double kLong = 1.6;
constexpr double kFoot = 2.0;
constexpr double kLeastFoot = 0.25; ///< Cover of a foot.
constexpr double kMostFoot = 0.15;  ///< Part of the points; more are the surroundings of a scanner.
/// A foot upside down, against the expected axis, must be surer.
constexpr double kSureFoot = 3.0;
constexpr double kSureCover = 0.35;
/// Extents of a room: shortest over next one.
constexpr double kLowestRoom = 0.2;
constexpr double kHighestRoom = 0.75;
constexpr double kWallCover = 0.5;
constexpr double kWallPart = 0.05;
/// Tangent of half the widest view of a camera; nearest over farthest point in it.
constexpr double kWidestView = 1.3;
constexpr double kNearestView = 0.5;
constexpr double kSameView = 0.6;
constexpr double kWeakFoot = 6.0;
/// Coordinates this many times as far from the origin as the cloud is long are those of a map, where z is up.
constexpr double kFarthest = 10.0;

/// End of an axis.
struct End
{
  double cover = 0.0; ///< Part of the cells that the cloud has across the axis with points in the end.
  double part = 0.0;  ///< Of all points.
  double bears() const { return cover * std::min(part, kMostFoot); }
  bool isWall() const { return cover >= kWallCover && part >= kWallPart; }
};

struct Axis
{
  double low = 0.0;
  double extent = 0.0;
  End ends[2];
  double middle = 0.5; ///< Mean height of what lies between the ends, over the extent.
};

std::vector<Vec3> sampleOf(const PointView& points)
{
  std::vector<Vec3> sample;
  const std::int64_t step = 1 + points.size() / kEvidence;
  for (std::int64_t i = 0; i < points.size(); i += step)
  {
    if (const Vec3 p = points[i]; isFinite(p) && norm(p) > 0.0)
    {
      sample.push_back(p);
    }
  }
  return sample;
}

double quantile(std::vector<double>& values, double part)
{
  const auto place = values.begin() + std::ptrdiff_t(part * double(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

void measureEnds(const std::vector<Vec3>& points, std::array<Axis, 3>& axes, int which)
{
  const int across[2] = { (which + 1) % 3, (which + 2) % 3 };
  Axis& axis = axes[std::size_t(which)];
  std::array<std::array<bool, kCells * kCells>, 3> cells{}; // of low end, high end, all
  double sum = 0.0;
  double between = 0.0;
  for (const Vec3& p : points)
  {
    const double height = (p[which] - axis.low) / axis.extent;
    int cell = 0;
    for (const int other : across)
    {
      const Axis& aside = axes[std::size_t(other)];
      const int place = int(kCells * (p[other] - aside.low) / aside.extent);
      cell = kCells * cell + std::clamp(place, 0, kCells - 1);
    }
    const int end = height < kEnd ? 0 : height > 1.0 - kEnd ? 1 : 2;
    cells[2][std::size_t(cell)] = true;
    cells[std::size_t(end)][std::size_t(cell)] = true;
    end < 2 ? axis.ends[end].part += 1.0 / double(points.size()) : between += 1.0;
    sum += end == 2 ? height : 0.0;
  }
  const auto count = [&cells](std::size_t of)
  { return double(std::count(cells[of].begin(), cells[of].end(), true)); };
  axis.middle = between > 0.0 ? sum / between : 0.5;
  const double all = count(2);
  axis.ends[0].cover = count(0) / all;
  axis.ends[1].cover = count(1) / all;
}

std::array<Axis, 3> measureAxes(const std::vector<Vec3>& points)
{
  std::array<Axis, 3> axes;
  std::vector<double> values(points.size());
  for (int which = 0; which < 3; ++which)
  {
    std::transform(points.begin(), points.end(), values.begin(), [which](const Vec3& p) { return p[which]; });
    Axis& axis = axes[std::size_t(which)];
    axis.low = quantile(values, kStrays);
    axis.extent = std::max(1e-12, quantile(values, 1.0 - kStrays) - axis.low);
  }
  for (int which = 0; which < 3; ++which)
  {
    measureEnds(points, axes, which);
  }
  return axes;
}

Vec3 unit(int axis, bool isUp)
{
  Vec3 up;
  up[axis] = isUp ? 1.0 : -1.0;
  return up;
}

/// One view of a camera from the origin: its pyramid is as wide near by as far away, over the distance.
bool isView(const std::vector<Vec3>& points)
{
  double farthest = 0.0;
  double nearest = INFINITY;
  for (const Vec3& p : points)
  {
    if (!(p.z > 0.0) || std::abs(p.x) > kWidestView * p.z || std::abs(p.y) > kWidestView * p.z)
    {
      return false;
    }
    farthest = std::max(farthest, p.z);
    nearest = std::min(nearest, p.z);
  }
  if (nearest > kNearestView * farthest)
  {
    return false;
  }
  double widest[2] = { 0.0, 0.0 };
  for (const Vec3& p : points)
  {
    double& wide = widest[p.z > 0.5 * (nearest + farthest) ? 1 : 0];
    wide = std::max(wide, std::abs(p.x) / p.z);
  }
  return std::min(widest[0], widest[1]) > kSameView * std::max(widest[0], widest[1]);
}

} // namespace

std::optional<Vec3> upByShape(const PointView& points, const Vec3& expected, bool& isWeak)
{
  isWeak = false;
  const std::vector<Vec3> sample = sampleOf(points);
  if (sample.size() < kFewest)
  {
    return std::nullopt;
  }
  if (isView(sample))
  {
    return unit(1, false);
  }
  const std::array<Axis, 3> axes = measureAxes(sample);
  Vec3 middle;
  for (int which = 0; which < 3; ++which)
  {
    middle[which] = axes[std::size_t(which)].low + 0.5 * axes[std::size_t(which)].extent;
  }
  const int mine = std::abs(expected.y) > 0.5 ? 1 : std::abs(expected.x) > 0.5 ? 0 : 2;
  int order[3] = { 0, 1, 2 };
  std::sort(order, order + 3,
    [&axes](int a, int b) { return axes[std::size_t(a)].extent < axes[std::size_t(b)].extent; });
  const auto& [shortest, next, longest] = order;
  const Axis& tall = axes[std::size_t(longest)];
  const Axis& low = axes[std::size_t(shortest)];
  if (norm(middle) > kFarthest * tall.extent)
  {
    return std::nullopt;
  }
  const bool isUpright = tall.ends[0].bears() >= tall.ends[1].bears();
  const End& foot = tall.ends[isUpright ? 0 : 1];
  const double bears = foot.bears() / std::max(1e-9, tall.ends[isUpright ? 1 : 0].bears());
  if (tall.extent > kLong * axes[std::size_t(next)].extent && bears > kFoot && foot.cover > kLeastFoot &&
    foot.part < kMostFoot)
  {
    const bool isTurned = longest == mine && unit(longest, isUpright)[mine] != expected[mine];
    const bool isSure = mine == 1 && bears > kSureFoot && foot.cover > kSureCover;
    return longest != mine || (isTurned && isSure) ? std::optional(unit(longest, isUpright)) : std::nullopt;
  }
  const double ratio = low.extent / axes[std::size_t(next)].extent;
  int walls = 0;
  for (const int other : { next, longest })
  {
    for (const End& end : axes[std::size_t(other)].ends)
    {
      walls += end.isWall() ? 1 : 0;
    }
  }
  if (shortest != mine && ratio > kLowestRoom && ratio < kHighestRoom && low.ends[0].isWall() &&
    low.ends[1].isWall() && walls >= 2)
  {
    return unit(shortest, low.middle < 0.5); // furniture stands on the floor
  }
  const End& under = axes[std::size_t(mine)].ends[expected[mine] > 0.0 ? 0 : 1];
  for (const Axis& axis : axes)
  {
    isWeak = isWeak || std::max(axis.ends[0].bears(), axis.ends[1].bears()) > kWeakFoot * under.bears();
  }
  return std::nullopt;
}

} // namespace pointhaptics
