#include "vtkOverlayLines.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtk_glew.h"

vtkStandardNewMacro(vtkOverlayLines);

vtkOverlayLines::vtkOverlayLines()
{
  for (Look* look : { &this->Seen, &this->Hidden })
  {
    look->Actor->SetMapper(look->Mapper);
    look->Actor->GetProperty()->LightingOff();
  }
  this->SetOpacities(1.0, 0.0);
  this->SetMapper(this->Seen.Mapper); // for the bounds
  this->PickableOff();
}

vtkOverlayLines::~vtkOverlayLines() = default;

void vtkOverlayLines::SetLines(vtkPolyData* lines)
{
  this->Seen.Mapper->SetInputData(lines);
  this->Hidden.Mapper->SetInputData(lines);
}

void vtkOverlayLines::SetColor(double red, double green, double blue)
{
  for (Look* look : { &this->Seen, &this->Hidden })
  {
    look->Actor->GetProperty()->SetColor(red, green, blue);
  }
}

void vtkOverlayLines::SetOpacities(double seen, double hidden)
{
  this->Seen.Opacity = seen;
  this->Hidden.Opacity = hidden;
  for (Look* look : { &this->Seen, &this->Hidden })
  {
    look->Actor->GetProperty()->SetOpacity(look->Opacity);
  }
}

void vtkOverlayLines::SetLineWidth(float width)
{
  for (Look* look : { &this->Seen, &this->Hidden })
  {
    look->Actor->GetProperty()->SetLineWidth(width);
  }
}

void vtkOverlayLines::Draw(Look& look, vtkRenderer* renderer)
{
  if (look.Opacity > 0.0)
  {
    look.Actor->GetProperty()->Render(look.Actor, renderer);
    look.Mapper->Render(renderer, look.Actor);
  }
}

/// Once where the cloud hides it, once where it does not.
int vtkOverlayLines::RenderOverlay(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  auto* window = renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
  if (!window || !this->GetVisibility() || !this->Seen.Mapper->GetInput())
  {
    return 0;
  }
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglEnable(GL_BLEND);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglDepthFunc(GL_GREATER);
  vtkOverlayLines::Draw(this->Hidden, renderer);
  state->vtkglDepthFunc(GL_LEQUAL);
  vtkOverlayLines::Draw(this->Seen, renderer);
  state->vtkglDepthMask(GL_TRUE);
  return 1;
}

void vtkOverlayLines::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SeenOpacity: " << this->Seen.Opacity << "\n";
  os << indent << "HiddenOpacity: " << this->Hidden.Opacity << "\n";
}
