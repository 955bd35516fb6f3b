#include "vtkOverlayActor.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtk_glew.h"

vtkStandardNewMacro(vtkOverlayActor);

vtkOverlayActor::vtkOverlayActor()
{
  this->Shape->ScalarVisibilityOff();
  this->SetMapper(this->Shape);
  this->Hidden->GetProperty(); // older than what it copies
  this->GetProperty()->LightingOff();
  this->PickableOff();
  this->UseBoundsOff();
}

vtkOverlayActor::~vtkOverlayActor() = default;

void vtkOverlayActor::SetShape(vtkPolyData* shape)
{
  this->Shape->SetInputData(shape);
}

void vtkOverlayActor::SetShape(vtkAlgorithmOutput* shape)
{
  this->Shape->SetInputConnection(shape);
}

/// Once where something hides it, once where nothing does.
int vtkOverlayActor::RenderOverlay(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  auto* window = renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
  if (!window || !this->GetVisibility() || this->Shape->GetNumberOfInputConnections(0) == 0)
  {
    return 0;
  }
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglEnable(GL_BLEND);
  glEnable(GL_DEPTH_CLAMP);
  const auto draw = [this, renderer](vtkActor* looks)
  {
    looks->GetProperty()->Render(looks, renderer);
    this->Shape->Render(renderer, looks);
    looks->GetProperty()->PostRender(looks, renderer);
  };
  if (this->HiddenOpacity > 0.0)
  {
    if (this->Hidden->GetProperty()->GetMTime() < this->GetProperty()->GetMTime() ||
      this->Hidden->GetProperty()->GetOpacity() != this->HiddenOpacity)
    {
      this->Hidden->GetProperty()->DeepCopy(this->GetProperty());
      this->Hidden->GetProperty()->SetOpacity(this->HiddenOpacity);
    }
    this->Hidden->SetUserMatrix(this->GetUserMatrix());
    state->vtkglDepthMask(GL_FALSE);
    state->vtkglDepthFunc(GL_GREATER);
    draw(this->Hidden);
  }
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LEQUAL);
  draw(this);
  glDisable(GL_DEPTH_CLAMP);
  return 1;
}

void vtkOverlayActor::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Hidden->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkOverlayActor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HiddenOpacity: " << this->HiddenOpacity << "\n";
}
