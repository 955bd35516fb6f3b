/// @file
/// Distance and direction from a hand in free space to the cloud.
#pragma once

#include "ScreenView.h"

#include "Core/Base/Vector3.h"
#include "Core/Neighbors/NeighborQuery.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkType.h"

#include <memory>
#include <optional>
#include <string>

namespace pointhaptics
{

class ScenePipeline;
struct ProxyState;

/// Distance from the hand to the felt means, where the model is at rest. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT HandDistance
{
public:
  /// @p scenes must outlive this.
  explicit HandDistance(const ScenePipeline& scenes)
    : scenes_(scenes)
  {
  }

  /// Takes the hand of @p latest; null: the distance is not needed. The first call after the cloud has
  /// changed makes an index, 0.1 us a point; later ones take some microseconds.
  void update(const ProxyState* latest);

  /// Point nearest to the hand, which touches nothing; workspace, metres.
  const std::optional<Vec3>& nearest() const { return nearest_; }
  const Vec3& hand() const { return hand_; }
  /// Distance in metres; 0 in contact. Nothing: it is not needed, or there is no point.
  std::optional<double> distance() const { return distance_; }
  /// "nearest point 3.1 mm away: left, ahead", as the person sees it; empty where there is nothing to say.
  std::string text(const ScreenAxes& screen) const;

private:
  bool index();

  const ScenePipeline& scenes_;
  std::unique_ptr<NeighborQuery> query_;
  const void* cloud_ = nullptr;
  vtkMTimeType cloudTime_ = 0;
  Vec3 hand_;
  std::optional<Vec3> nearest_;
  std::optional<double> distance_;
};

} // namespace pointhaptics
