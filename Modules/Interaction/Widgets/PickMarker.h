/// @file
/// Marks where the picked point is.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkNew.h"

#include <optional>

class vtkActor2D;
class vtkOutlineSource;
class vtkOverlayActor;
class vtkRegularPolygonSource;
class vtkRenderer;

namespace pointhaptics
{

/// The point's voxel as a box, its bandwidth as three circles, and a cross of one size on the screen, so that
/// a voxel of a pixel is found. What the cloud hides of the marker is drawn all the same. Frame: workspace,
/// metres. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT PickMarker
{
public:
  PickMarker();
  ~PickMarker();
  PickMarker(const PickMarker&) = delete;
  PickMarker& operator=(const PickMarker&) = delete;

  /// Adds it to @p renderer; once is enough.
  void addTo(vtkRenderer* renderer);
  /// Marks @p point; its @p voxel, and circles of radius @p bandwidth where that is above 0.
  void mark(const Vec3& point, const std::optional<Bounds>& voxel, double bandwidth);
  /// False: it was hidden already.
  bool hide();

private:
  vtkNew<vtkOutlineSource> box_;
  vtkNew<vtkOverlayActor> boxActor_;
  vtkNew<vtkRegularPolygonSource> circles_[3];
  vtkNew<vtkOverlayActor> circlesActor_;
  vtkNew<vtkActor2D> cross_;
};

} // namespace pointhaptics
