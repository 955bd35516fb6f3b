#include "vtkWorkspaceBrackets.h"

#include "vtkCellArray.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"

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
  this->SetShape(this->Lines);
  this->GetProperty()->SetColor(0.80, 0.82, 0.86); // for a dark ground
  this->GetProperty()->SetOpacity(kOpacity);
  this->GetProperty()->SetLineWidth(1.5F);
  this->SetHiddenOpacity(kHiddenOpacity);
}

vtkWorkspaceBrackets::~vtkWorkspaceBrackets() = default;

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

void vtkWorkspaceBrackets::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Box: " << this->Box[0] << ", " << this->Box[1] << ", " << this->Box[2] << ", "
     << this->Box[3] << ", " << this->Box[4] << ", " << this->Box[5] << "\n";
}
