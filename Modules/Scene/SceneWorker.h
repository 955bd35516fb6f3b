/// @file
/// Makes scenes in a thread of its own: resampling, the servo loop's snapshot, the arrays of the picture.
#pragma once

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Base/Status.h"
#include "Core/Resample/VoxelMeanSettings.h"
#include "Haptics/HapticScene.h"

#include "PointHapticsSceneModule.h" // For export macro

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
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

  std::array<double, 16> modelToWorkspace{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }; ///< Row by row.
  bool useCovariance = true;
  VoxelMeanSettings voxels;                   ///< Scene and picture are those of the finest level.
  std::optional<BandwidthSettings> bandwidth; ///< The rule of the radii, and the arrays of the picture.
  /// Arrays of the picture that take long: see SurfaceArrays.h. A picture with them is left out of a build
  /// that is followed by another.
  bool hasResiduals = false;
  bool hasNormals = false;
  /// While the model rests, scenes of what is near the hand are made that are as fine as the points there
  /// (LocalSceneBuilder), and published with this request's number. Needs a hand and covariances.
  bool refinesNearHand = false;
  /// Nobody has chosen the lattice: that of the scene of the whole cloud is as chooseLattice() finds it, what
  /// is near the hand has that of @c voxels.
  bool findsLattice = false;
  /// A box about the hand and what it touches, in the workspace; empty: there is no hand. May be missing.
  /// Called in the worker's threads.
  std::function<Bounds()> hand;
  /// Called in the worker's threads with a finished scene and the request's number: a scene of what is near
  /// the hand, where one is made, and that of the whole cloud, or null where there is nothing in the
  /// workspace; before the picture's arrays are made. Two calls may meet.
  std::function<void(std::shared_ptr<const HapticScene>, std::uint64_t)> publish;
};

/// Result of a request.
struct BuiltScene
{
  std::uint64_t number = 0; ///< Number of the request: 1, 2, ...
  std::array<double, 16> modelToWorkspace{};
  vtkSmartPointer<vtkPolyData> means; ///< With the arrays of both filters; nobody else has it.
  vtkIdType numberOfPoints = 0;       ///< Number of the cloud's points.
  int latticeDimension = 0;           ///< Dimension that SceneRequest::findsLattice found; else 0.
  bool empty = true;                  ///< No scene was made: @p status says why.
  Status status = Status::Empty;
  std::string problem; ///< Failures of the filters; empty: none.
};

/// One build of the whole cloud is in flight at a time; of the requests that come meanwhile only the newest
/// is built. The picture may be left out of a build that is followed by another, but not for longer than
/// kPictureSeconds. A second thread builds what is near the hand (LocalSceneProvider) in the same way, and
/// goes first: new voxels are felt before the whole cloud is resampled. While the model rests it looks at the
/// hand 100 times a second, 25 times a hand that rests, if the newest request says so, and makes finer scenes
/// of where that comes.
///
/// request(), adopt(), setCloud(), take(), wait() and cancel() from one thread (the GUI's), which waits in
/// the last two only. VTK objects pass from thread to thread whole: the worker has filters of its own, and
/// what one side hands over it lets go of.
class POINTHAPTICSSCENE_EXPORT SceneWorker
{
public:
  static constexpr double kPictureSeconds = 0.1;

  SceneWorker();
  ~SceneWorker(); ///< Waits for the builds in flight.
  SceneWorker(const SceneWorker&) = delete;
  SceneWorker& operator=(const SceneWorker&) = delete;

  /// The cloud of the requests from now on; nothing of the former one can be taken any more. Its points and
  /// arrays are shared and must not be changed; the object itself is the worker's.
  void setCloud(vtkSmartPointer<vtkPointSet> cloud);
  /// @return the request's number.
  std::uint64_t request(SceneRequest request);
  /// A scene of the cloud that was made elsewhere as @p request would make it, or null where there was
  /// nothing in the workspace, takes the place of what would be built: it is published at once and may be
  /// refined. What is in flight still is dropped, and nothing of it can be taken. @return the request's
  /// number.
  std::uint64_t adopt(SceneRequest request, std::shared_ptr<const HapticScene> scene);
  /// How often the whole cloud was resampled.
  std::uint64_t numberOfBuilds() const;
  /// The newest finished build that was not taken yet. False: there is none.
  bool take(BuiltScene& built);
  /// True if a build is in flight or waits.
  bool busy() const;
  /// Returns when nothing is in flight and nothing waits; finer scenes near the hand may still come.
  void wait();
  /// Forgets the requests that wait and the result that was not taken, and waits for the builds in flight.
  /// Nothing is called or published afterwards, finer scenes neither, until the next request.
  void cancel();

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace pointhaptics
