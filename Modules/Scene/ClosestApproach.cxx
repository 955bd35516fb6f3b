#include "ClosestApproach.h"

#include "Core/Neighbors/NeighborQuery.h"
#include "Haptics/HapticScene.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{

void ClosestApproach::add(const Vec3& hip)
{
  if (added_++ % stride_ != 0 || !isFinite(hip))
  {
    return;
  }
  if (places_.size() == kMostPlaces)
  {
    for (std::size_t i = 0; i < kMostPlaces / 2; ++i)
    {
      places_[i] = places_[2 * i];
    }
    places_.resize(kMostPlaces / 2);
    stride_ *= 2;
  }
  places_.push_back(hip);
}

std::optional<double> ClosestApproach::distance(const HapticScene& scene) const
{
  std::vector<Vec3> points;
  for (const Cell& cell : scene.pyramid().level(0).cells)
  {
    points.push_back(cell.mean);
  }
  NeighborQuery query;
  query.build(PointView(points.data(), std::int64_t(points.size())));
  double least = INFINITY;
  for (const Vec3& place : places_)
  {
    Neighbor neighbor;
    if (query.nearest(scene.toLattice(place), 1, &neighbor) == 1)
    {
      least = std::min(least, neighbor.squaredDistance);
    }
  }
  return std::isfinite(least) ? std::optional<double>(scene.latticeScale() * std::sqrt(least)) : std::nullopt;
}

} // namespace pointhaptics
