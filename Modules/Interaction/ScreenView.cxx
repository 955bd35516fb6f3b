#include "ScreenView.h"

#include "ScreenMarks.h"

#include "vtkCamera.h"
#include "vtkInteractorObserver.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"

#include <array>

namespace pointhaptics
{
namespace
{

/// Pixels of the window.
struct Viewport
{
  explicit Viewport(vtkRenderer* renderer)
  {
    const double* parts = renderer->GetViewport();
    const int* size = renderer->GetVTKWindow()->GetSize();
    left = parts[0] * size[0];
    bottom = parts[1] * size[1];
    width = (parts[2] - parts[0]) * size[0];
    height = (parts[3] - parts[1]) * size[1];
  }
  double left;
  double bottom;
  double width;
  double height;
};

} // namespace

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
  vtkCamera* camera = this->renderer()->GetActiveCamera();
  camera->OrthogonalizeViewUp();
  const CameraView view(camera);
  return { cross(view.forward, view.up), view.up, view.forward };
}

Vec3 ScreenView::forward() const
{
  return CameraView(this->renderer()->GetActiveCamera()).forward;
}

Vec3 ScreenView::toWorkspace(double x, double y, double depth) const
{
  vtkRenderer* renderer = this->renderer();
  const std::array<double, 2> place = placeInPicture(renderer, x, y);
  vtkNew<vtkMatrix4x4> fromPicture;
  pointerProjection(renderer, x, 0.0, 1.0, fromPicture);
  fromPicture->Invert();
  const Viewport part(renderer);
  const double in[4] = { 2.0 * (place[0] - part.left) / part.width - 1.0,
    2.0 * (place[1] - part.bottom) / part.height - 1.0, depth, 1.0 };
  double out[4];
  fromPicture->MultiplyPoint(in, out);
  return { out[0] / out[3], out[1] / out[3], out[2] / out[3] };
}

Vec3 ScreenView::toDisplay(const Vec3& point) const
{
  vtkRenderer* renderer = this->renderer();
  vtkNew<vtkMatrix4x4> toPicture;
  pointerProjection(renderer, 0.0, 0.0, 1.0, toPicture);
  const double in[4] = { point.x, point.y, point.z, 1.0 };
  double out[4];
  toPicture->MultiplyPoint(in, out);
  const Viewport part(renderer);
  return { part.left + 0.5 * part.width * (1.0 + out[0] / out[3]),
    part.bottom + 0.5 * part.height * (1.0 + out[1] / out[3]), out[2] / out[3] };
}

Vec3 ScreenView::mouseMotion(const Vec3& anchor) const
{
  const double depth = this->toDisplay(anchor).z;
  const int* to = this->interactor()->GetEventPosition();
  const int* from = this->interactor()->GetLastEventPosition();
  return this->toWorkspace(to[0], to[1], depth) - this->toWorkspace(from[0], from[1], depth);
}

} // namespace pointhaptics
