#include "ScreenView.h"

#include "vtkCamera.h"
#include "vtkInteractorObserver.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"

namespace pointhaptics
{

vtkRenderWindowInteractor* ScreenView::interactor() const
{
  return style_.GetInteractor();
}

vtkRenderer* ScreenView::renderer() const
{
  if (vtkRenderer* current = style_.GetCurrentRenderer())
  {
    return current;
  }
  if (vtkRenderer* byDefault = style_.GetDefaultRenderer())
  {
    return byDefault;
  }
  vtkRenderWindow* window = this->interactor() ? this->interactor()->GetRenderWindow() : nullptr;
  return window ? window->GetRenderers()->GetFirstRenderer() : nullptr;
}

ScreenAxes ScreenView::axes() const
{
  ScreenAxes axes;
  vtkCamera* camera = this->renderer()->GetActiveCamera();
  camera->OrthogonalizeViewUp();
  camera->GetViewUp(&axes.up.x);
  camera->GetDirectionOfProjection(&axes.forward.x);
  axes.right = cross(axes.forward, axes.up);
  return axes;
}

Vec3 ScreenView::forward() const
{
  Vec3 forward;
  this->renderer()->GetActiveCamera()->GetDirectionOfProjection(&forward.x);
  return forward;
}

Vec3 ScreenView::toWorkspace(double x, double y, double depth) const
{
  double world[4];
  vtkInteractorObserver::ComputeDisplayToWorld(this->renderer(), x, y, depth, world);
  return { world[0], world[1], world[2] };
}

Vec3 ScreenView::toDisplay(const Vec3& point) const
{
  double display[3];
  vtkInteractorObserver::ComputeWorldToDisplay(this->renderer(), point.x, point.y, point.z, display);
  return { display[0], display[1], display[2] };
}

Vec3 ScreenView::mouseMotion(const Vec3& anchor) const
{
  const double depth = this->toDisplay(anchor).z;
  const int* to = this->interactor()->GetEventPosition();
  const int* from = this->interactor()->GetLastEventPosition();
  return this->toWorkspace(to[0], to[1], depth) - this->toWorkspace(from[0], from[1], depth);
}

} // namespace pointhaptics
