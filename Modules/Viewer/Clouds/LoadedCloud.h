/// @file
/// Makes one cloud of files, ready for the scene. It needs no window and no scene: any thread may do it.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "Core/Base/Status.h"
#include "Core/Resample/VoxelMeanSettings.h"
#include "HapticViewerOptions.h"
#include "IO/Info/CloudExtent.h"
#include "ShownCloud.h"

#include "PointHapticsViewerModule.h" // For export macro

#include <vtkSmartPointer.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkPolyData;

namespace pointhaptics
{

class HapticScene;

/// Receives the step of a load, "reading", "preparing", "measuring" or "resampling", and the part of it that
/// is done, 0 to 1. False ends the load, but for "preparing".
using LoadProgress = std::function<bool(const char* step, double part)>;

struct CloudRequest
{
  /// To read the files @p names, or take @c points, and resample them as @p given says.
  explicit CloudRequest(std::vector<std::string> names = {}, HapticViewerOptions given = {})
    : files(std::move(names))
    , options(std::move(given))
  {
  }

  std::vector<std::string> files;
  HapticViewerOptions options; ///< In @c colorBy and @c hidden upper and lower case do not matter.
  bool isOnlyRead = false;     ///< Neither placed nor resampled, and nothing is made for a picture.
  /// Points of a cloud optimised file that are read at most, by leaving out fine levels; see
  /// LoadedCloud::isCoarse. 0: all.
  vtkIdType mostPoints = 0;
  vtkSmartPointer<vtkPolyData> points; ///< Points instead of files; nobody else may hold them.
  std::string title;                   ///< Title of the points; files have their names.
  /// Placement of the cloud that is shown, and its transform now: both are kept where the new one fits the
  /// workspace as well. Empty: those of the options.
  std::optional<AffineTransform> placement;
  std::optional<AffineTransform> model;
  bool makesScene = false;            ///< True where the cloud will be felt.
  std::optional<ShownRequest> before; ///< Look of a coarse level of the same files: all points get it, too.
  bool isFeltOnly = false;            ///< Nothing is made for a picture: LoadedCloud::means have no arrays.
  /// Do not wait for the means before the first picture:
  /// LoadedCloud::isResampled. Effective where the options neither show nor record means, nor place the
  /// cloud, so that it may have no points in the workspace.
  bool resamplesLater = false;
  bool measuresLater = false; ///< Show large clouds plain first: LoadedCloud::measurement.

  POINTHAPTICSVIEWER_EXPORT std::string name() const; ///< For messages.
};

struct LoadedCloud
{
  vtkSmartPointer<vtkPolyData> cloud; ///< Nobody else's.
  vtkSmartPointer<vtkPolyData> felt;  ///< Points that were resampled: all, or those in the clipping box.
  Bounds bounds; ///< Bounds of the finite points after the options' transform; a fitted cloud leaves out far
                 ///< ones and rays that did not return.
  Bounds near;   ///< Bounds of all points but a few far ones, which are not drawn; empty: none is far.
  std::int64_t invalid = 0;   ///< Points that are not finite.
  std::int64_t noReturns = 0; ///< Points at (0, 0, 0) that are not drawn, see areNoReturns().
  CloudOrientation orientation;
  std::string colorBy;            ///< The requested array, spelt as the cloud or the pipeline writes it.
  std::string title;              ///< The names of the files, without their folders.
  bool isCoarse = false;          ///< CloudRequest::mostPoints left out points.
  std::vector<std::string> notes; ///< Parts of the files that the cloud lacks, a line each.

  std::shared_ptr<ShownCloud> shown; ///< How its points are drawn; null: it was only read.

  ShownRequest showing; ///< Request from which @c shown was made.
  /// Measures the points while the loader goes on, where @c shown is plain; else null.
  std::shared_ptr<ShownMeasurement> measurement;

  bool isResampled = true;   ///< If false, only placement, model and workspace below are set.
  bool findsLattice = false; ///< True if the lattice of the later resampling is still to be chosen.

  // Where it was resampled:
  AffineTransform placement; ///< Transform from the cloud's coordinates to the workspace, by the options.
  AffineTransform model;     ///< Transform of the resampling: placement, or CloudRequest::model.
  int latticeDimension = 0;  ///< Chosen number of voxels on each axis; 0 where the user gave it.
  Bounds workspace;          ///< The lattice's box.
  VoxelMeanSettings voxels;  ///< Settings of the resampling.
  vtkSmartPointer<vtkPolyData> means;       ///< With the arrays of both filters; nobody else's.
  std::shared_ptr<const HapticScene> scene; ///< Null: not wanted, or there is none: sceneStatus.
  Status sceneStatus = Status::Ok;
  int resamplings = 0; ///< Number of runs of the resampler.
  double resampleSeconds = 0.0;
};

/// The names of @p files without their folders.
POINTHAPTICSVIEWER_EXPORT std::string titleOf(const std::vector<std::string>& files);

/// Fills in LoadedCloud::bounds, invalid and noReturns of LoadedCloud::cloud and, where the options fit it,
/// near. A note says that far points are left out, or how to leave them out.
POINTHAPTICSVIEWER_EXPORT void findBounds(const CloudRequest& request, LoadedCloud& loaded);

/// Adds a note on rays that did not return: it explains why points of the file are missing. @pre
/// LoadedCloud::workspace is that of the scene.
POINTHAPTICSVIEWER_EXPORT void noteNoReturns(const CloudRequest& request, LoadedCloud& loaded);

/// True for arrays that means alone have.
bool isOfMeans(const std::string& name);

/// Name of an array in options and messages: arrays that the pipeline makes are in lower case.
std::string colorWord(const std::string& name);

/// The first of @p notes, and how many there are besides; empty where there is none.
std::string shortNote(const std::vector<std::string>& notes);

/// Writes the arrays of @p hidden as @p cloud has them, in any case; heights need not be there. False: @p
/// message names the array there is not, or of which there are several; @p option is the setting's name.
bool completeHidden(
  vtkPolyData* cloud, const std::string& option, std::vector<HiddenValues>& hidden, std::string& message);

/// Reads the files into one cloud, which has every array of each (io::mergeClouds()), and resamples it.
/// False: @p message says which file and why, or that @p progress ended it, and @p loaded is as it was.
POINTHAPTICSVIEWER_EXPORT bool loadCloud(
  const CloudRequest& request, const LoadProgress& progress, LoadedCloud& loaded, std::string& message);

} // namespace pointhaptics
