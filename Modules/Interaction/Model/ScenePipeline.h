/// @file
/// From a change of the model to the scene that is felt and the voxel means that are shown.
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
#include <utility>

class vtkActor;
class vtkMatrix4x4;
class vtkPolyData;
class vtkTransform;

namespace pointhaptics
{

class ModelTransform;

/// Whether an array or a refinement is made is part of each request; a change of the arrays asks for a new
/// one.
struct SceneOptions
{
  /// Use VoxelCovariance in the scenes if the resampler makes it.
  bool useCovariance = true;
  /// While the model rests, feel scenes near the hand that are as fine as the points there, where that tells
  /// more than the resampler's voxels. They are made in the background from the cloud itself, in some
  /// milliseconds; until they are there the whole cloud's is felt. Of no effect without useCovariance.
  bool refinesNearHand = false;
  /// The arrays of pointhaptics::addSurfaceArrays(): the distance of each mean from the surface that is felt,
  /// and its normals. They come some time after the scene is felt, and while the model moves the picture
  /// keeps those it has.
  bool computeResiduals = false;
  bool computeNormals = false;
};

/// A change of the model makes a NEW HapticScene, in a thread of its own (SceneWorker) with filters of its
/// own, which have the settings of those given here. It goes to the servo loop as soon as it is finished: the
/// servo thread never waits and never sees a half-made scene. Changes that come while one is made are made up
/// for by the next one. Until poll() finds it the cloud's actor shows the old voxel means where the model is
/// now; then the output of the given filters becomes what the thread has made, without their running, and the
/// actor's mapper, where it is connected to them, is given that data instead. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT ScenePipeline
{
public:
  /// @p model must outlive this.
  explicit ScenePipeline(ModelTransform& model);
  ~ScenePipeline();
  ScenePipeline(const ScenePipeline&) = delete;
  ScenePipeline& operator=(const ScenePipeline&) = delete;

  ///@{
  /// The parts, in any order; null takes one away. The servo loop may be destroyed at any time. The
  /// resampler's Transform becomes this object's.
  void setServo(ServoLoop* servo);
  void setResampler(vtkVoxelMeanResampler* resampler);
  void setBandwidthFilter(vtkKernelBandwidthFilter* filter);
  void setCloudActor(vtkActor* actor);
  ///@}
  /// Called when a new scene is there and shown, also an empty one.
  void setObserver(std::function<void(const BuiltScene&)> shown) { shownObserver_ = std::move(shown); }

  const SceneOptions& options() const { return options_; }
  void setOptions(const SceneOptions& options);

  /// Something that the scene is made from has changed, such as the filters' settings: poll() or update()
  /// asks for a new one.
  void invalidate() { isInvalid_ = true; }
  /// Another cloud, or the same anew, is the resampler's input; the model is where it is to be. poll() asks
  /// for its scene: what is near the hand is felt first. @param findsLattice SceneRequest::findsLattice,
  /// until a scene is shown; the resampler gets the dimensions.
  void startCloud(bool findsLattice);
  /// The model has moved. With @p requestsNow the new scene is asked for at once.
  void moveModel(bool requestsNow);
  /// Asks for a scene where something has changed, and shows what is finished. To be called from a timer.
  void poll();
  /// Waits until the scene of the model as it is now is published and shown. False: there is no point in the
  /// workspace (an empty scene was published).
  bool update();
  /// The scene of the model as it is now was made elsewhere, with the settings of the given filters, and its
  /// means are the output of the last of these: it is felt and shown without being resampled. Null: there is
  /// no point in the workspace.
  void adopt(std::shared_ptr<const HapticScene> scene);

  /// True if what is felt is not yet made for the model as it is.
  bool isChanged() const { return isInvalid_ || requested_ != shownNumber_; }
  /// True if nothing new can come before the next change: also where there is no resampler.
  bool isSettled() const { return !this->isChanged() || !resampler_; }
  bool hasCloud() const { return resampler_ != nullptr; }
  bool isEmpty() const { return isEmpty_; }
  vtkIdType numberOfPoints() const { return numberOfPoints_; }
  vtkIdType numberOfVoxels() const { return numberOfVoxels_; }
  /// How often the cloud was resampled here.
  std::uint64_t numberOfBuilds() const;
  /// The output of the last filter there is; null: there is none.
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
  bool findsLattice_ = false;
  std::uint64_t requested_ = 0; ///< The newest request for a scene, and the one that is shown.
  std::uint64_t shownNumber_ = 0;
  const void* sentCloud_ = nullptr;
  vtkMTimeType sentCloudTime_ = 0;
  vtkIdType numberOfPoints_ = 0;
  vtkIdType numberOfVoxels_ = 0;
  ScenePublisher publisher_;
  SceneWorker worker_; ///< Last: it ends first.
};

} // namespace pointhaptics
