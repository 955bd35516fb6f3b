/// @file
/// From the files that are to be shown to one cloud ready for the scene. No window and no scene is needed for
/// it: any thread may do it.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "Core/Base/Status.h"
#include "Core/Resample/VoxelMeanSettings.h"
#include "ShownCloud.h"

#include "PointHapticsViewerModule.h" // For export macro

#include <vtkSmartPointer.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics
{

class HapticScene;
struct HapticViewerOptions;

struct POINTHAPTICSVIEWER_EXPORT CloudRequest
{
  /// To read @p files, or take @p points, and resample them as @p options say.
  static CloudRequest of(const std::vector<std::string>& files, const HapticViewerOptions& options);

  std::vector<std::string> files;
  double resolution = 0.0;          ///< How far cloud optimised files are read; 0: all points.
  std::vector<std::string> columns; ///< Names for the columns of texts; empty: as the files say.
  bool salvage = false;             ///< Files that are cut are read as far as they go.
  bool vertices = false;            ///< Meshes are their vertices; else samples of their faces.
  /// Of cloud optimised files: how many are read, by leaving out fine levels; see LoadedCloud::isCoarse. 0:
  /// all.
  vtkIdType mostPoints = 0;
  vtkSmartPointer<vtkPolyData> points; ///< Instead of files; nobody else's.
  std::string title;                   ///< Of the points; that of files is their names.
  std::string colorBy; ///< What findColorSource() takes, rgb, or nothing; upper or lower case as it may.
  std::string colorByName = "colorBy"; ///< What messages call it.
  std::string up = "auto";             ///< auto or an axis.
  AffineTransform transform;           ///< Of the cloud, for its bounds.
  /// How the cloud is resampled, with colorBy, up and transform as above. Null: it is only read.
  std::shared_ptr<const HapticViewerOptions> options;
  std::optional<AffineTransform> model; ///< Where the cloud is resampled; empty: where the options place it.
  bool makesScene = false;              ///< It will be felt.
  std::optional<ShownRequest> before; ///< How a coarse level of the same files was shown: so are all points.
  bool isFeltOnly = false;            ///< Nothing is made for a picture: LoadedCloud::means have no arrays.
  /// Gets what is done once the files are read, "measuring" or "resampling", and how much of it, 0 to 1; may
  /// be empty.
  std::function<void(const char* step, double part)> working;
  /// The first picture and what is near the hand do not wait for the means: LoadedCloud::isResampled. Of
  /// effect where canResampleLater().
  bool resamplesLater = false;
  bool measuresLater = false; ///< Large clouds are shown plain first: LoadedCloud::toMeasure.

  std::string name() const; ///< For messages.
  /// Whether the options say neither that means are shown or recorded, nor where the cloud is to lie, so that
  /// it may have no points there.
  bool canResampleLater() const;
};

struct LoadedCloud
{
  vtkSmartPointer<vtkPolyData> cloud; ///< Nobody else's.
  vtkSmartPointer<vtkPolyData> felt;  ///< What of it was resampled: all, or the points in the clipping box.
  Bounds bounds; ///< Of the finite points, after CloudRequest::transform; of a fitted cloud without far ones
                 ///< and rays that did not return.
  Bounds near;   ///< Of all points but a few far ones, which are not drawn; empty: none is far.
  std::int64_t invalid = 0;   ///< Points that are not finite.
  std::int64_t noReturns = 0; ///< Points at (0, 0, 0) that are not drawn, see areNoReturns().
  CloudOrientation orientation;
  std::string colorBy;            ///< What was asked for, exactly as the cloud or the pipeline writes it.
  std::string title;              ///< The names of the files, without their folders.
  bool isCoarse = false;          ///< CloudRequest::mostPoints left out points.
  double heightZero = 0.0;        ///< Where the array of heights begins, along the up axis; 0: it has none.
  std::vector<std::string> notes; ///< What the cloud does not have of the files, a line each.

  std::shared_ptr<ShownCloud> shown; ///< How its points are drawn; null: it was only read.

  ShownRequest showing;                   ///< What @c shown was made of.
  vtkSmartPointer<vtkPolyData> toMeasure; ///< With all arrays, where @c shown is plain; else null.

  bool isResampled = true;   ///< Else of what follows there are only placement, model and workspace.
  bool findsLattice = false; ///< Nobody has chosen a lattice for what is resampled later.

  // Where it was resampled:
  AffineTransform placement; ///< Where the options place the cloud: from its coordinates to the workspace.
  AffineTransform model;     ///< Where it was resampled: there, or CloudRequest::model.
  int latticeDimension = 0;  ///< Voxels on each axis, where nobody had chosen them; else 0.
  Bounds workspace;          ///< The lattice's box.
  VoxelMeanSettings voxels;  ///< What the means were resampled with.
  vtkSmartPointer<vtkPolyData> means;       ///< With the arrays of both filters; nobody else's.
  std::shared_ptr<const HapticScene> scene; ///< Null: not wanted, or there is none: sceneStatus.
  Status sceneStatus = Status::Ok;
  int resamplings = 0; ///< How often the resampler ran.
  double resampleSeconds = 0.0;
};

/// Bounds after a transform; the corners of a box would be too wide for a turned cloud.
struct CloudExtent
{
  Bounds all;                 ///< Of the finite points.
  Bounds returned;            ///< Of those but rays that did not return.
  std::int64_t finite = 0;    ///< Points.
  std::int64_t invalid = 0;   ///< The others.
  std::int64_t atZero = 0;    ///< Points at (0, 0, 0),
  std::int64_t noReturns = 0; ///< the same where areNoReturns(), else 0.
};

POINTHAPTICSVIEWER_EXPORT CloudExtent extentOf(
  vtkPolyData* cloud, const AffineTransform& transform = AffineTransform());

/// The names of @p files without their folders.
POINTHAPTICSVIEWER_EXPORT std::string titleOf(const std::vector<std::string>& files);

/// Fills in LoadedCloud::bounds, invalid and noReturns of LoadedCloud::cloud and, where the options fit it,
/// near; a note says of far points that they are left out, or how.
POINTHAPTICSVIEWER_EXPORT void findBounds(const CloudRequest& request, LoadedCloud& loaded);

/// Adds what becomes of rays that did not return: nobody sees else why points of the file are missing. @pre
/// LoadedCloud::workspace is that of the scene.
POINTHAPTICSVIEWER_EXPORT void noteNoReturns(const CloudRequest& request, LoadedCloud& loaded);

/// What options and messages call what a cloud is coloured by: what the pipeline makes in lower case.
std::string colorWord(const std::string& name);

/// The first of @p notes, and how many there are besides; empty where there is none.
std::string shortNote(const std::vector<std::string>& notes);

/// Reads the files into one cloud, which has every array of each (io::mergeClouds()), and resamples it.
/// @p goesOn is asked with the part of the work that is done, 0 to 1, which ascends; as soon as it answers
/// false, it ends. False: @p message says which file and why, and @p loaded is as it was.
POINTHAPTICSVIEWER_EXPORT bool loadCloud(const CloudRequest& request,
  const std::function<bool(double)>& goesOn, LoadedCloud& loaded, std::string& message);

} // namespace pointhaptics
