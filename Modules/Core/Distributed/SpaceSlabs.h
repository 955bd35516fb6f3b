/// @file
/// Points of several ranks, exchanged so that each rank has a slab of space, and ghosts of the others.
#pragma once

#include "Core/Base/PointView.h"
#include "Core/Distributed/Ranks.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// A point on its way between ranks.
struct SlabPoint
{
  Vec3 place;
  std::int64_t index = 0; ///< Among the points of all ranks.
  double count = 1.0;
};

/// Coordinates along the axis of the slabs.
struct SlabRange
{
  double low = INFINITY;
  double high = -INFINITY;

  void include(double from, double to)
  {
    low = from < low ? from : low;
    high = to > high ? to : high;
  }
  bool contains(double c) const { return c >= low && c <= high; }
};

/// Slabs of about as many points each across the longest axis of the cloud. Points that are not finite are in
/// none.
class SpaceSlabs
{
public:
  /// Collective. @p counts: one for each of @p points, or empty.
  SpaceSlabs(Ranks& ranks, const PointView& points, const std::vector<double>& counts);

  /// Points of this rank's slab, by index.
  const std::vector<SlabPoint>& own() const { return own_; }
  double coordinate(const SlabPoint& point) const { return point.place[axis_]; }
  /// Finite points of all ranks, and the box about them.
  std::int64_t pointsOfAll() const { return pointsOfAll_; }
  const Bounds& box() const { return box_; }
  /// Collective: the own points and those of other slabs in @p range, by index.
  std::vector<SlabPoint> withGhosts(const SlabRange& range);

  /// Collective: gives values of the own points back to the ranks whose points they are. @return one for each
  /// of these, 0 for points that are not finite.
  std::vector<double> giveBack(const std::vector<double>& values);

private:
  std::vector<double> chooseCuts(const PointView& points);

  Ranks& ranks_;
  int axis_ = 0;
  std::int64_t pointsOfAll_ = 0;
  Bounds box_;
  std::vector<std::int64_t> firsts_; ///< Index of the first point of each rank, and the number of all.
  std::vector<SlabPoint> own_;
};

} // namespace pointhaptics
