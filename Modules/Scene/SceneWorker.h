/// @file
/// Makes scenes and their pictures in the background.
#pragma once

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Base/Status.h"
#include "Haptics/HapticScene.h"

#include "PointHapticsSceneModule.h" // For export macro

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

class vtkKernelBandwidthFilter;
class vtkPointSet;
class vtkPolyData;
class vtkVoxelMeanResampler;

namespace pointhaptics
{

/// Input of one scene. The settings of the filters are copied when it is made: later changes belong to the
/// next request.
struct SceneRequest
{
  /// Copies the settings of @p resampler, its input and transform aside, and those of @p filter, which may be
  /// null.
  POINTHAPTICSSCENE_EXPORT static SceneRequest of(
    vtkVoxelMeanResampler* resampler, vtkKernelBandwidthFilter* filter);

  SceneOrigin recipe;                      ///< Of the global scene.
  std::optional<BandwidthSettings> arrays; ///< Arrays that the picture has beside those of the voxels.
  /// Arrays of the picture that take long: see SurfaceArrays.h. A build that is followed by another leaves
  /// out a picture with them.
  bool hasResiduals = false;
  bool hasNormals = false;
  /// Make fine scenes near the hand (LocalSceneBuilder). Needs a hand and covariances.
  bool refinesNearHand = false;
  /// Choose the lattice of the global scene by chooseLattice().
  bool findsLattice = false;
  /// Returns a box about the HIP and the contact point, in the workspace; empty: there is no hand. May be
  /// missing. Called in the worker's threads.
  std::function<Bounds()> hand;
  /// Receives finished scenes, in the worker's threads: the global one with the request's number, or null
  /// where nothing lies in the workspace, before the picture's arrays are made; and finer ones with the
  /// number of the request whose global scene they lie beside, after that. Two calls may meet.
  std::function<void(std::shared_ptr<const HapticScene>, std::uint64_t)> publish;
};

/// Result of a request.
struct BuiltScene
{
  std::uint64_t number = 0; ///< Number of the request: 1, 2, ...
  AffineTransform modelToWorkspace;
  vtkSmartPointer<vtkPolyData> means; ///< With the arrays of both filters; nobody else has it.
  vtkIdType numberOfPoints = 0;       ///< Number of the cloud's points.
  int latticeDimension = 0;           ///< Dimension that SceneRequest::findsLattice found; else 0.
  bool empty = true;                  ///< No scene was made: @p status says why.
  Status status = Status::Empty;
  std::string problem; ///< Failures of the filters; empty: none.
};

/// Builds the global scene of one request at a time; of the requests that come meanwhile only the newest is
/// built. The picture may be left out of a build that is followed by another, but not for longer than
/// kPictureSeconds. If the newest request says so, a second thread looks at the hand 100 times a second, or
/// 25 times at a hand that rests, and makes finer scenes on its way (LocalSceneProvider), where the model is
/// by the newest request: a model that moves is felt finely before the whole cloud is resampled there.
///
/// request(), adopt(), setCloud(), take(), wait() and cancel() belong to one thread (the GUI's), which waits
/// in the last two only. A data object of VTK belongs to one thread at a time: each thread has a copy of the
/// cloud that shares its arrays, and a picture is handed over whole.
class POINTHAPTICSSCENE_EXPORT SceneWorker
{
public:
  static constexpr double kPictureSeconds = 0.1;

  SceneWorker();
  ~SceneWorker(); ///< Waits for the builds in flight.
  SceneWorker(const SceneWorker&) = delete;
  SceneWorker& operator=(const SceneWorker&) = delete;

  /// Sets the cloud of the following requests; results of the former one can no longer be taken. Its points
  /// and arrays are shared and must not be changed. Null: there is none.
  void setCloud(vtkPointSet* cloud);
  /// @return the request's number.
  std::uint64_t request(SceneRequest request);
  /// Takes a scene that was made elsewhere, as @p request would make it, in place of a build; null where
  /// nothing lies in the workspace. It is published at once and may be refined. Builds in flight are dropped,
  /// and none of their results can be taken. @return the request's number.
  std::uint64_t adopt(SceneRequest request, std::shared_ptr<const HapticScene> scene);
  /// Number of times that the whole cloud was resampled.
  std::uint64_t numberOfBuilds() const;
  /// Takes the newest finished build once. False: there is none.
  bool take(BuiltScene& built);
  /// True if a build is in flight or waits.
  bool busy() const;
  /// Waits until no build is in flight and no request waits; finer scenes near the hand may still come.
  void wait();
  /// Forgets waiting requests and the result that was not taken, and waits for the builds in flight.
  /// Afterwards nothing is called or published, not even finer scenes, until the next request.
  void cancel();

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace pointhaptics
