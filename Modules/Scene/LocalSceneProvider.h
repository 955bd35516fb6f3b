/// @file
/// Scenes of what is near the hand, finer than that of the whole cloud.
#pragma once

#include "Core/Neighbors/PointIndex.h"
#include "FeelScenes.h"

#include "vtkSmartPointer.h"

#include <chrono>
#include <memory>

class vtkPoints;

namespace pointhaptics
{

/// Makes scenes of what is near a hand (LocalSceneBuilder); it looks at the points there only, which it finds
/// by a PointIndex of its own. Objects are used by one thread at a time.
class POINTHAPTICSSCENE_EXPORT LocalSceneProvider
{
public:
  /// The cloud of the scenes from now on; may be null. Its points must not be changed.
  void setCloud(vtkSmartPointer<vtkPoints> points);

  /// A scene of what is near @p hand where the model is at @p place, as fine as the points there, beside
  /// @p global; null where the last one serves, none is of use, or the global one cannot be moved there.
  /// Points are indexed when the hand first comes where such a scene is of use.
  std::shared_ptr<const HapticScene> refine(
    const Bounds& hand, const std::shared_ptr<const HapticScene>& global, const AffineTransform& place);

  /// The local scene of @p origin made again beside @p global, which was made as origin.global says. Null
  /// where it cannot be.
  std::shared_ptr<const HapticScene> make(
    const SceneOrigin& origin, const std::shared_ptr<const HapticScene>& global);

  /// True if the points are indexed by now: not before a scene is made of them.
  bool isIndexed() const { return index_ != nullptr; }

private:
  bool index();

  SmpExecutor smp_;
  vtkSmartPointer<vtkPoints> points_;
  std::shared_ptr<const PointIndex> index_;   ///< Null: not made yet.
  std::shared_ptr<const HapticScene> global_; ///< The scene that was refined last,
  std::shared_ptr<const HapticScene> moved_;  ///< and where the model was then; null: it cannot be there.
  LocalSceneFollower fine_;                   ///< Beside that.
  std::chrono::steady_clock::time_point lastLook_;
};

} // namespace pointhaptics
