/// @file
/// Makes the felt scene and the shown voxel means after a change of the model.
#pragma once

#include "ScenePublisher.h"
#include "SceneWorker.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Lifetime.h"
#include "Haptics/ServoLoop.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

class vtkActor;
class vtkMatrix4x4;
class vtkPolyData;
class vtkTransform;

namespace pointhaptics
{

class ModelTransform;

/// Options of the requests; a change of the arrays makes a new request.
struct SceneOptions
{
  /// Use VoxelCovariance in the scenes if the resampler makes it.
  bool useCovariance = true;
  /// Feel scenes near the hand that are as fine as the points there, where these tell
  /// more than the resampler's voxels. They are made in the background from the cloud itself, in some
  /// milliseconds; until then the global scene is felt. Without useCovariance this has no effect.
  bool refinesNearHand = false;
  /// Compute the arrays of pointhaptics::addSurfaceArrays(): the distance of each mean from the felt surface,
  /// and its normals. They come some time after the scene is felt, and while the model moves the picture
  /// keeps the old ones.
  bool computeResiduals = false;
  bool computeNormals = false;
};

/// Makes a NEW HapticScene after a change of the model, in a thread of its own (SceneWorker) with filters of
/// its own, which copy the settings of those given here. The servo loop gets it as soon as it is finished:
/// the servo thread never waits and never sees a half-made scene. Changes that come meanwhile are covered by
/// the next scene. Until poll() finds the result, the cloud's actor shows the old voxel means at the model's
/// present place. Then the result becomes the output of the given filters, without their running, and the
/// actor's mapper is given that data if it is connected to them. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT ScenePipeline
{
public:
  /// @p model must outlive this.
  explicit ScenePipeline(ModelTransform& model);
  ~ScenePipeline();
  ScenePipeline(const ScenePipeline&) = delete;
  ScenePipeline& operator=(const ScenePipeline&) = delete;

  ///@{
  /// Set the parts, in any order; null takes one away. The servo loop may be destroyed at any time. The
  /// resampler's Transform becomes this object's.
  void setServo(ServoLoop* servo);
  void setResampler(vtkVoxelMeanResampler* resampler);
  void setBandwidthFilter(vtkKernelBandwidthFilter* filter);
  void setCloudActor(vtkActor* actor);
  ///@}
  /// Sets a function that is called when a new scene is shown, also an empty one.
  void setObserver(std::function<void(const BuiltScene&)> shown) { shownObserver_ = std::move(shown); }

  const SceneOptions& options() const { return options_; }
  void setOptions(const SceneOptions& options);

  /// Notes that the input of the scene has changed, such as the filters' settings: poll() or update()
  /// requests a new one.
  void invalidate() { isInvalid_ = true; }
  /// Notes that the resampler has another cloud as its input, or the same anew, and that the model is in
  /// place. poll() requests its scene. @param findsLattice
  /// SceneRequest::findsLattice, until a scene is shown; the resampler gets the dimensions.
  void startCloud(bool findsLattice);
  /// Nothing is felt until another cloud is.
  void release();
  /// Notes that the model has moved. With @p requestsNow the new scene is requested at once.
  void moveModel(bool requestsNow);
  /// Requests a scene where something has changed, and shows a finished one. Call it from a timer.
  void poll();
  /// Waits until the scene of the present model is published and shown. False: there is no point in the
  /// workspace (an empty scene was published).
  bool update();
  /// Takes a scene of the present model that was made elsewhere, with the settings of the given filters; its
  /// means are the output of the last of these. It is felt and shown without being resampled. Null: there is
  /// no point in the workspace.
  void adopt(std::shared_ptr<const HapticScene> scene);

  /// True if the felt scene is not yet that of the present model.
  bool isChanged() const { return isInvalid_ || requested_ != shownNumber_; }
  /// True if no new scene can come before the next change, also where there is no resampler.
  bool isSettled() const { return !this->isChanged() || !resampler_; }
  bool hasCloud() const { return resampler_ != nullptr; }
  bool isEmpty() const { return isEmpty_; }
  /// Errors of the filters that made the scene; empty: none.
  const std::string& problem() const { return problem_; }
  vtkIdType numberOfPoints() const { return numberOfPoints_; }
  vtkIdType numberOfVoxels() const { return numberOfVoxels_; }
  /// Number of times that the cloud was resampled here.
  std::uint64_t numberOfBuilds() const { return worker_.numberOfBuilds(); }
  /// Output of the last filter; null: there is none.
  vtkPolyData* cloud() const;
  /// May be null.
  vtkKernelBandwidthFilter* bandwidthFilter() const { return bandwidth_; }

private:
  void publishMoved();
  void preview();
  bool isCloudSent() const;
  void sendCloud();
  SceneRequest makeRequest();
  void request();
  void showFinished();
  void show(const BuiltScene& built);

  ModelTransform& model_;
  SceneOptions options_;
  WatchedPointer<ServoLoop> servo_;
  vtkSmartPointer<vtkVoxelMeanResampler> resampler_;
  vtkSmartPointer<vtkKernelBandwidthFilter> bandwidth_;
  vtkSmartPointer<vtkActor> actor_;
  vtkSmartPointer<vtkTransform> resampled_; ///< Transform with which the shown means were resampled.
  vtkSmartPointer<vtkMatrix4x4> preview_;
  std::function<void(const BuiltScene&)> shownObserver_;
  bool isInvalid_ = true;
  bool isEmpty_ = true;
  std::string problem_;
  bool findsLattice_ = false;
  std::uint64_t requested_ = 0; ///< Numbers of the newest request for a scene, and of the shown one.
  std::uint64_t shownNumber_ = 0;
  const void* sentCloud_ = nullptr;
  vtkMTimeType sentCloudTime_ = 0;
  vtkIdType numberOfPoints_ = 0;
  vtkIdType numberOfVoxels_ = 0;
  ScenePublisher publisher_;
  SceneWorker worker_; ///< Last member: it ends first.
};

} // namespace pointhaptics
