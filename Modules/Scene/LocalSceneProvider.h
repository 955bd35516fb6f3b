/// @file
/// The scene of what is near the hand: new voxels sooner than those of the whole cloud.
#pragma once

#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResampler.h"
#include "FeelScenes.h"

#include "vtkSmartPointer.h"

#include <chrono>
#include <memory>

class vtkPoints;

namespace pointhaptics
{

/// Makes scenes of what is near a hand; it looks at the points there only, which it finds by a PointIndex of
/// its own. Objects are used by one thread at a time.
class POINTHAPTICSSCENE_EXPORT LocalSceneProvider
{
public:
  LocalSceneProvider();
  ~LocalSceneProvider();

  /// The cloud of the scenes from now on; may be null. Its points must not be changed.
  void setCloud(vtkSmartPointer<vtkPoints> points);

  /// A scene of what is near @p hand, with @p global, the newest scene of the whole cloud, beside it: within
  /// what it covers it is felt as the whole cloud resampled by @p recipe would be. Without one (null) nothing
  /// is felt elsewhere; that takes a look at each point and no index of them.
  /// Null where it is of no use or cannot be: no hand, a global scene that does not fit
  /// (LocalRegion::about()), nothing near the hand or most of the cloud, no global scene and points sparser
  /// than voxels; or on an error, which the scene of the whole cloud will tell of.
  std::shared_ptr<const HapticScene> build(
    const SceneOrigin& recipe, const Bounds& hand, std::shared_ptr<const HapticScene> global);

  /// A scene of what is near @p hand, as fine as the points there, beside @p global, whose origin is known;
  /// null where the last one serves, or none is of use (LocalSceneBuilder). Points are indexed when the hand
  /// first comes where such a scene is of use.
  std::shared_ptr<const HapticScene> refine(
    const Bounds& hand, const std::shared_ptr<const HapticScene>& global);

  /// The scene of @p origin, a Region or a Fine one, made again beside @p global, which was made as
  /// origin.global says. Null where it cannot be.
  std::shared_ptr<const HapticScene> make(
    const SceneOrigin& origin, const std::shared_ptr<const HapticScene>& global);

  /// True if the points are indexed by now: not before a scene is made of them.
  bool isIndexed() const { return index_ != nullptr; }

private:
  bool index();
  bool resample(const LocalRegion& region);
  bool prepare(const SceneOrigin& recipe);

  SmpExecutor smp_;
  vtkSmartPointer<vtkPoints> points_;
  std::shared_ptr<const PointIndex> index_; ///< Null: not made yet.
  LocalSceneFollower fine_;                 ///< Beside the global scene that was refined last.
  std::chrono::steady_clock::time_point lastLook_;
  VoxelResampler engine_;
  VoxelRequest voxels_;
};

} // namespace pointhaptics
