/// @file
/// Converts between pixels of an interactor style's picture and the workspace.
#pragma once

#include "Core/Base/Vector3.h"

#include "PointHapticsInteractionModule.h" // For export macro

class vtkInteractorObserver;
class vtkRenderer;
class vtkRenderWindowInteractor;

namespace pointhaptics
{

/// The axes of the screen in the workspace, unit vectors.
struct ScreenAxes
{
  Vec3 right;
  Vec3 up;
  Vec3 forward; ///< Away from the person.
};

/// GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT ScreenView
{
public:
  /// @p style must outlive this.
  explicit ScreenView(vtkInteractorObserver& style)
    : style_(style)
  {
  }

  /// Interactor of the style; null while it has none.
  vtkRenderWindowInteractor* interactor() const;
  /// The renderer under the mouse, else the style's default one, else the first of the window. May be null.
  vtkRenderer* renderer() const;

  ///@{
  /// @pre renderer() is not null. Display: pixels from the lower left, and the depth that
  /// toDisplay() gives.
  /// axes() makes the camera's view up orthogonal, forward() leaves the camera as it is.
  ScreenAxes axes() const;
  Vec3 forward() const;
  Vec3 toWorkspace(double x, double y, double depth) const;
  Vec3 toDisplay(const Vec3& point) const;
  ///@}
  /// Motion of @p anchor in the view plane when the mouse goes from its last position to this one. @pre
  /// renderer() and interactor() are not null.
  Vec3 mouseMotion(const Vec3& anchor) const;

private:
  vtkInteractorObserver& style_;
};

} // namespace pointhaptics
