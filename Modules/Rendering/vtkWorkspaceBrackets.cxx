#include "vtkWorkspaceBrackets.h"

#include "vtkCellArray.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtk_glew.h"

#include <algorithm>

namespace
{

constexpr double kPart = 0.06;
constexpr double kOpacity = 0.55;
constexpr double kHiddenOpacity = 0.12;

} // namespace

vtkStandardNewMacro(vtkWorkspaceBrackets);

vtkWorkspaceBrackets::vtkWorkspaceBrackets()
{
  for (Look* look : { &this->Seen, &this->Hidden })
  {
    look->Mapper->SetInputData(this->Lines);
    look->Actor->SetMapper(look->Mapper);
    look->Actor->GetProperty()->SetColor(0.80, 0.82, 0.86);
    look->Actor->GetProperty()->LightingOff();
    look->Actor->GetProperty()->SetLineWidth(1.5F);
  }
  this->Seen.Actor->GetProperty()->SetOpacity(kOpacity);
  this->Hidden.Actor->GetProperty()->SetOpacity(kHiddenOpacity);
  this->SetMapper(this->Seen.Mapper);
  this->PickableOff();
}

vtkWorkspaceBrackets::~vtkWorkspaceBrackets() = default;

void vtkWorkspaceBrackets::SetColor(double red, double green, double blue)
{
  for (Look* look : { &this->Seen, &this->Hidden })
  {
    look->Actor->GetProperty()->SetColor(red, green, blue);
  }
}

void vtkWorkspaceBrackets::SetBox(const double box[6])
{
  if (std::equal(box, box + 6, this->Box))
  {
    return;
  }
  std::copy(box, box + 6, this->Box);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  for (int corner = 0; corner < 8; ++corner)
  {
    const double from[3] = { box[corner & 1], box[2 + (corner >> 1 & 1)], box[4 + (corner >> 2 & 1)] };
    const vtkIdType begin = points->InsertNextPoint(from);
    for (int axis = 0; axis < 3; ++axis)
    {
      double to[3] = { from[0], from[1], from[2] };
      const double edge = box[2 * axis + 1] - box[2 * axis];
      to[axis] += (corner >> axis & 1) != 0 ? -kPart * edge : kPart * edge;
      const vtkIdType line[2] = { begin, points->InsertNextPoint(to) };
      lines->InsertNextCell(2, line);
    }
  }
  this->Lines->SetPoints(points);
  this->Lines->SetLines(lines);
  this->Modified();
}

void vtkWorkspaceBrackets::Draw(Look& look, vtkRenderer* renderer)
{
  look.Actor->GetProperty()->Render(look.Actor, renderer);
  look.Mapper->Render(renderer, look.Actor);
}

/// Once where the cloud hides it, once where it does not.
int vtkWorkspaceBrackets::RenderOverlay(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  auto* window = renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
  if (!window || !this->GetVisibility())
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
  this->Draw(this->Hidden, renderer);
  state->vtkglDepthFunc(GL_LEQUAL);
  this->Draw(this->Seen, renderer);
  state->vtkglDepthMask(GL_TRUE);
  return 1;
}

void vtkWorkspaceBrackets::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Box: " << this->Box[0] << ", " << this->Box[1] << ", " << this->Box[2] << ", "
     << this->Box[3] << ", " << this->Box[4] << ", " << this->Box[5] << "\n";
}
