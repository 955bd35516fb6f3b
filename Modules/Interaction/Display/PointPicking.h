/// @file
/// The point under the mouse, and its properties.
#pragma once

#include "Core/Bandwidth/LocalBandwidth.h"
#include "Core/Base/PointView.h"
#include "Core/Base/Vector3.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkType.h"

#include <functional>
#include <optional>
#include <set>
#include <string>

class vtkActor;
class vtkMatrix4x4;
class vtkPolyData;
class vtkRenderer;

namespace pointhaptics
{

/// Properties of a picked point.
struct PickedPoint
{
  vtkIdType index = -1;              ///< Index in the picked cloud.
  Vec3 inWorkspace;                  ///< Position in the workspace, metres.
  std::optional<Vec3> shown;         ///< Place on the drawn cloud under the pointer, where depths tell it.
  std::optional<Vec3> inCloud;       ///< In the frame of the file, where the cloud says how it was mapped.
  std::optional<Vec3> voxel;         ///< Whole numbers from 0, where the cloud has a lattice.
  std::optional<Bounds> voxelBounds; ///< Bounds of that voxel in the workspace.
  double bandwidth = 0.0;            ///< Bandwidth b, metres; 0: not measured.
  double radius = 0.0;               ///< Radius of the proxy, metres; not smoothed (see
                                     ///< LocalBandwidthSettings).
};

/// The point of the file that belongs to a picked mean.
struct PickedOfFile
{
  vtkPolyData* cloud = nullptr; ///< In the frame of the file; null: none was.
  vtkIdType index = -1;
  std::set<std::string> leftOut; ///< Arrays that were made for the picture.
};

/// Picks the point of @p cloud (in the workspace's frame: the output of vtkVoxelMeanResampler) that is drawn
/// at the display position (@p x, @p y) of @p renderer's window, or within @p pixels of it: the one nearest
/// to what the picture shows there, see vtkDepthShadingPass::FindShown(); without such a picture the one
/// nearest to the camera. What is drawn farther from the cloud than its points are apart is no part of it.
/// False: there is none. Cost: a few ns a point. GUI thread only.
/// @param toWorkspace of a cloud in another frame, as that of its file; null: it is in the workspace.
/// @param isDrawn of points, by index and place in the frame of @p cloud; empty: all are.
POINTHAPTICSINTERACTION_EXPORT bool pickPoint(vtkPolyData* cloud, vtkRenderer* renderer, double x, double y,
  double pixels, PickedPoint& picked, vtkMatrix4x4* toWorkspace = nullptr,
  const std::function<bool(vtkIdType, const Vec3&)>& isDrawn = {});

/// True if @p actor draws a point, by its index and its place in the frame of the points: its clipping
/// planes, and the box and the lengths of a vtkSplatMapper, leave it. Both must outlive the result.
POINTHAPTICSINTERACTION_EXPORT std::function<bool(vtkIdType, const Vec3&)> drawnBy(vtkActor* actor);

/// Fills in bandwidth and radius, as vtkKernelBandwidthFilter computes them with @p settings. Searches the
/// point's neighbours among all points of @p cloud: about 0.1 s for a million. Errors: those of
/// localBandwidths.
POINTHAPTICSINTERACTION_EXPORT Status measurePicked(
  vtkPolyData* cloud, const LocalBandwidthSettings& settings, PickedPoint& picked);

/// Position, voxel, bandwidth and the values of all point arrays of @p cloud, one a line; lengths of the
/// workspace in millimetres. Coordinates of the file, the height among them, have decimals down to a
/// thousandth of a voxel and at least three, so that a northing in metres shows its millimetres; no number
/// below 1e9 has an exponent, but for those below 1e-4. Where @p ofFile is given, place and values are those
/// of that point of the file, and of the mean only what the file does not have; coordinates have the decimals
/// of the file's grid, where it has one (field data "LasScale").
POINTHAPTICSINTERACTION_EXPORT std::string describePicked(
  vtkPolyData* cloud, const PickedPoint& picked, const PickedOfFile& ofFile = {});

} // namespace pointhaptics
