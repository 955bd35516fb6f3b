#include "HandDistance.h"

#include "PolyDataAccess.h"
#include "ScenePipeline.h"
#include "SmpExecutor.h"

#include "Core/Base/QuantityText.h"
#include "Haptics/Proxy.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointhaptics
{
namespace
{

/// A direction is named if it has more than this part of the way.
constexpr double kMuch = 0.4;

} // namespace

/// Indexes the cloud. False: there is none, or it moves.
bool HandDistance::index()
{
  vtkPolyData* cloud = scenes_.cloud();
  if (!cloud || !cloud->GetPoints() || scenes_.isEmpty() || !scenes_.isSettled())
  {
    return false;
  }
  const vtkMTimeType time = cloud->GetPoints()->GetMTime();
  if (!query_ || cloud_ != cloud->GetPoints() || cloudTime_ != time)
  {
    const PointAccess access(cloud->GetPoints());
    query_ = std::make_unique<NeighborQuery>();
    query_->build(access.view(), SmpExecutor());
    cloud_ = cloud->GetPoints();
    cloudTime_ = time;
  }
  return true;
}

void HandDistance::update(const ProxyState* latest)
{
  nearest_.reset();
  distance_.reset();
  if (!latest || !isFinite(latest->hip))
  {
    return;
  }
  hand_ = latest->hip;
  Neighbor neighbor;
  if (latest->contact)
  {
    distance_ = 0.0;
  }
  else if (this->index() && query_->nearestSlots(hand_, 1, &neighbor) == 1)
  {
    distance_ = std::sqrt(neighbor.squaredDistance);
    nearest_ = query_->point(NeighborQuery::slotOf(neighbor));
  }
}

std::string HandDistance::text(const ScreenAxes& screen) const
{
  if (!nearest_)
  {
    return {};
  }
  std::string text = "nearest point " + lengthText(*distance_, 2) + " away";
  const Vec3 way = *nearest_ - hand_;
  std::pair<double, const char*> parts[3] = { { dot(way, screen.right), nullptr },
    { dot(way, screen.up), nullptr }, { dot(way, screen.forward), nullptr } };
  parts[0].second = parts[0].first > 0.0 ? "right" : "left";
  parts[1].second = parts[1].first > 0.0 ? "up" : "down";
  parts[2].second = parts[2].first > 0.0 ? "deeper" : "nearer to you";
  std::sort(std::begin(parts), std::end(parts),
    [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
  const char* separator = ": ";
  for (const auto& [length, word] : parts)
  {
    if (std::abs(length) > kMuch * *distance_)
    {
      text += separator + std::string(word);
      separator = ", ";
    }
  }
  return text;
}

} // namespace pointhaptics
