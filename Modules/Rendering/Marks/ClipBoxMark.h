/// @file
/// A box about a part of a cloud, with a handle on each face.
#pragma once

#include "Core/Base/PointView.h"
#include "EventLink.h"
#include "ScreenMarks.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <array>
#include <optional>

class vtkRenderer;

namespace pointhaptics
{

/// Draws edges and handles in front of the cloud, placed anew before each render. Faces are counted xmin,
/// xmax, ymin ... zmax from 0. GUI thread only.
class POINTHAPTICSRENDERING_EXPORT ClipBoxMark
{
public:
  ClipBoxMark() = default;
  /// Removes it from its renderer.
  ~ClipBoxMark();
  ClipBoxMark(const ClipBoxMark&) = delete;
  ClipBoxMark& operator=(const ClipBoxMark&) = delete;

  /// Adds it to one renderer, for good.
  void addTo(vtkRenderer* renderer);
  /// Sets the box in the frame of the cloud.
  void setBox(const Bounds& box) { box_ = box; }
  /// Sets the matrix from the frame of the cloud to that of the picture; copied. Default: the identity.
  void setModel(vtkMatrix4x4* model) { model_->DeepCopy(model); }
  /// Sets the face whose handle stands out.
  void setActiveFace(int face) { active_ = face; }
  int activeFace() const { return active_; }
  /// Default: off.
  void setVisible(bool visible);
  bool isVisible() const { return isVisible_; }

  /// Finds the face whose handle is at a place of the window, in pixels from its lower left corner.
  std::optional<int> faceAt(double x, double y) const;
  /// Outward way of @p face, in the unit of the cloud, when its handle is dragged by so many pixels.
  double wayOf(int face, double pixelsRight, double pixelsUp) const;

private:
  std::array<ScreenLines*, 3> all() { return { &edges_, &rims_, &handles_ }; }
  Vec3 corner(int index) const;
  Vec3 middleOf(int face) const;
  void draw();
  void drawHandle(const Pixel& at, const unsigned char color[3]);

  Bounds box_;
  vtkNew<vtkMatrix4x4> model_;
  int active_ = 1;
  bool isVisible_ = false;
  ScreenLines edges_{ 1.5F };
  ScreenLines rims_{ 6.0F };
  ScreenLines handles_{ 3.0F };
  EventLink onStart_{ [this] { this->draw(); } };
  vtkWeakPointer<vtkRenderer> renderer_;
};

} // namespace pointhaptics
