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

/// Draws edges and handles in front of the cloud, placed anew before each render. Faces are counted xmin,
/// xmax, ymin ... zmax from 0. GUI thread only.
class POINTHAPTICSRENDERING_EXPORT ClipBoxMark
{
public:
  ClipBoxMark();
  /// Removes it from its renderer.
  ~ClipBoxMark();
  ClipBoxMark(const ClipBoxMark&) = delete;
  ClipBoxMark& operator=(const ClipBoxMark&) = delete;

  /// Adds it to one renderer, for good.
  void addTo(vtkRenderer* renderer);
  /// Sets the box in the frame of the cloud.
  void setBox(const Bounds& box);
  /// Sets the matrix from the frame of the cloud to that of the picture; copied. Default: the identity.
  void setModel(vtkMatrix4x4* model);
  /// Sets the face whose handle stands out.
  void setActiveFace(int face);
  int activeFace() const;
  /// Default: off.
  void setVisible(bool visible);
  bool isVisible() const;

  /// Finds the face whose handle is at a place of the window, in pixels from its lower left corner.
  std::optional<int> faceAt(double x, double y) const;
  /// Outward way of @p face, in the unit of the cloud, when its handle is dragged by so many pixels.
  double wayOf(int face, double pixelsRight, double pixelsUp) const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace pointhaptics
