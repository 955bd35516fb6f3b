/// @file
/// From the files that are to be shown to one cloud ready for the scene. No window and no scene is needed for
/// it: any thread may do it.
#pragma once

#include "CloudOrientation.h"
#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"

#include "PointHapticsViewerModule.h" // For export macro

#include <vtkSmartPointer.h>

#include <functional>
#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics
{

struct HapticViewerOptions;

struct CloudRequest
{
  /// To read @p files as @p options say.
  static CloudRequest of(const std::vector<std::string>& files, const HapticViewerOptions& options);

  std::vector<std::string> files;
  std::string colorBy; ///< What findColorSource() takes, rgb, or nothing; upper or lower case as it may.
  std::string colorByName = "colorBy"; ///< What messages call it.
  std::string up = "auto";             ///< auto or an axis.
  AffineTransform transform;           ///< Of the cloud, for its bounds.
  bool choosesLattice = false;         ///< Nobody else does.
};

struct LoadedCloud
{
  vtkSmartPointer<vtkPolyData> cloud; ///< Nobody else's.
  Bounds bounds;                      ///< Of the finite points, after CloudRequest::transform.
  CloudOrientation orientation;
  std::string colorBy;      ///< What was asked for, exactly as the cloud or the pipeline writes it.
  int latticeDimension = 0; ///< chooseLatticeDimension(), where that was wanted; else 0.
  std::string title;        ///< The names of the files, without their folders.
};

/// Bounds of the finite points after @p transform; the corners of a box would be too wide for a turned cloud.
Bounds transformedBounds(vtkPolyData* cloud, const AffineTransform& transform);

/// The names of @p files without their folders.
POINTHAPTICSVIEWER_EXPORT std::string titleOf(const std::vector<std::string>& files);

/// Reads the files into one cloud. @p goesOn is asked with the part of the work that is done, 0 to 1, which
/// ascends; as soon as it answers false, reading ends. False: @p message says which file and why, and
/// @p loaded is as it was.
POINTHAPTICSVIEWER_EXPORT bool loadCloud(const CloudRequest& request,
  const std::function<bool(double)>& goesOn, LoadedCloud& loaded, std::string& message);

/// The same with points that are there: makes ready what is the caller's alone. @p format as the reader calls
/// it; empty: none.
bool prepareCloud(const CloudRequest& request, vtkSmartPointer<vtkPolyData> points, const std::string& title,
  const std::string& format, const std::function<bool(double)>& goesOn, LoadedCloud& loaded,
  std::string& message);

} // namespace pointhaptics
