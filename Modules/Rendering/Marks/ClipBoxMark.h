/// @file
/// A box about a part of a cloud, with a handle on each face.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include <memory>
#include <optional>

class vtkMatrix4x4;
class vtkRenderer;

namespace pointhaptics
{

/// Edges and handles in front of the cloud, placed anew before each render. Faces are counted xmin, xmax,
/// ymin ... zmax from 0. GUI thread only.
class POINTHAPTICSRENDERING_EXPORT ClipBoxMark
{
public:
  ClipBoxMark();
  /// Takes it out of its renderer.
  ~ClipBoxMark();
  ClipBoxMark(const ClipBoxMark&) = delete;
  ClipBoxMark& operator=(const ClipBoxMark&) = delete;

  /// To one renderer, for good.
  void addTo(vtkRenderer* renderer);
  /// In the frame of the cloud.
  void setBox(const Bounds& box);
  /// From the frame of the cloud to that of the picture; copied. Default: the identity.
  void setModel(vtkMatrix4x4* model);
  /// The face whose handle stands out.
  void setActiveFace(int face);
  int activeFace() const;
  /// Default: off.
  void setVisible(bool visible);
  bool isVisible() const;

  /// The face whose handle is at a place of the window, in pixels from its lower left corner.
  std::optional<int> faceAt(double x, double y) const;
  /// How far @p face goes outward, in the unit of the cloud, when its handle is dragged by so many pixels.
  double wayOf(int face, double pixelsRight, double pixelsUp) const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace pointhaptics
