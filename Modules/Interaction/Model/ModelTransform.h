/// @file
/// Transform of the model into the haptic workspace, with undo.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkSmartPointer.h"
#include "vtkTransform.h"

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <utility>

class vtkMatrix4x4;

namespace pointhaptics
{

/// Maps the cloud's frame into the workspace's (x_T = T x + t); metres. It is rotated and scaled about the
/// centre of the workspace. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT ModelTransform
{
public:
  ModelTransform();
  ~ModelTransform();
  ModelTransform(const ModelTransform&) = delete;
  ModelTransform& operator=(const ModelTransform&) = delete;

  /// Called after each change.
  void setObserver(std::function<void()> changed) { changed_ = std::move(changed); }

  /// Box of the hand: xmin, xmax, ymin, ymax, zmin, zmax. Default: the 10 cm cube about the origin.
  void setWorkspaceBounds(const double bounds[6]) { std::copy(bounds, bounds + 6, workspace_.begin()); }
  const std::array<double, 6>& workspaceBounds() const { return workspace_; }
  Bounds workspace() const
  {
    const std::array<double, 6>& w = workspace_;
    return { { w[0], w[2], w[4] }, { w[1], w[3], w[5] } };
  }
  Vec3 center() const { return this->workspace().center(); }
  double edge() const; ///< Longest edge of the box.

  /// The transform, for reading; always the same object.
  vtkTransform* transform() const { return transform_; }
  /// Sets the transform, to which reset() goes back. undo() ends here.
  void setMatrix(vtkMatrix4x4* matrix);
  /// As setMatrix() without telling the observer: the scene of this matrix is there already.
  void adoptMatrix(vtkMatrix4x4* matrix);

  ///@{
  /// Degrees, right-handed, about an axis of the workspace; metres; a factor above 0. Values that are not
  /// finite, an axis or a factor of 0 are ignored.
  void rotate(double degrees, const Vec3& axis);
  void translate(const Vec3& offset);
  void scale(double factor);
  ///@}
  /// Restores the matrix of setMatrix().
  void reset();
  /// Takes back the last change. The last 100 are kept. False: there is none.
  bool undo();

  ///@{
  /// Joins the changes in between, such as the steps of a drag, into one for undo(). Gestures that overlap
  /// are one.
  void beginGesture();
  void endGesture() { gestures_ = std::max(0, gestures_ - 1); }
  ///@}

private:
  using Elements = std::array<double, 16>;
  void remember();
  void report();

  vtkSmartPointer<vtkTransform> transform_;
  vtkSmartPointer<vtkMatrix4x4> initial_;
  std::array<double, 6> workspace_{ -0.05, 0.05, -0.05, 0.05, -0.05, 0.05 };
  std::deque<Elements> history_; ///< Matrices before the last changes, oldest first.
  int gestures_ = 0;             ///< Gestures under way.
  bool isRemembered_ = false;    ///< True if the matrix before the gesture is in the history.
  std::function<void()> changed_;
};

} // namespace pointhaptics
