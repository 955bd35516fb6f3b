/// @file
/// The scene of what is near the hand: new voxels sooner than those of the whole cloud.
#pragma once

#include "Core/PointIndex.h"
#include "Core/VoxelResampler.h"
#include "Haptics/HapticScene.h"
#include "SceneWorker.h"

#include "SmpExecutor.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <memory>

class vtkPointSet;

namespace pointhaptics
{

/// Resamples the cloud about the hand and makes a scene of that (ScenePart); it looks at the points there
/// only, which it finds by a PointIndex of its own. Objects are used by one thread at a time.
class NearSceneBuilder
{
public:
  NearSceneBuilder();
  ~NearSceneBuilder();

  /// The cloud of the builds from now on; may be null. Its points must not be changed.
  void setCloud(vtkSmartPointer<vtkPointSet> cloud);

  /// A scene of what is near the hand of @p request, with @p whole, the newest scene of the whole cloud,
  /// beside it: within what it covers it is felt as the whole cloud resampled by @p request would be. Null
  /// where that is of no use or cannot be: no hand, no such whole (ScenePart::about()), nothing near the hand
  /// or most of the cloud; or on an error, which the scene of the whole cloud will tell of.
  std::shared_ptr<const HapticScene> build(
    const SceneRequest& request, std::shared_ptr<const HapticScene> whole);

private:
  bool prepare(const SceneRequest& request);
  HapticSceneInput input(const SceneRequest& request) const;

  SmpExecutor smp_;
  vtkSmartPointer<vtkPointSet> cloud_;
  PointIndex index_;
  bool isIndexed_ = false;
  VoxelResampler engine_;
  VoxelRequest voxels_;
  // Never updated: they hold the request's settings.
  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkKernelBandwidthFilter> bandwidth_;
};

} // namespace pointhaptics
