#include "vtkPickMarker.h"

#include "vtkActor2D.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCoordinate.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutlineSource.h"
#include "vtkOverlayActor.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty.h"
#include "vtkProperty2D.h"
#include "vtkRegularPolygonSource.h"
#include "vtkRenderer.h"

#include <algorithm>

namespace
{

constexpr double kVoxelColor[3] = { 0.85, 0.0, 0.0 };
constexpr double kBandwidthColor[3] = { 0.0, 0.35, 0.85 };
constexpr double kCrossColor[3] = { 0.1, 0.1, 0.1 };
/// Pixels from the middle where the arms of the cross begin and end.
constexpr double kArmBegin = 8.0;
constexpr double kArmEnd = 18.0;

void setUpLines(vtkOverlayActor* actor, vtkAlgorithmOutput* shape, const double color[3])
{
  actor->SetShape(shape);
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  actor->GetProperty()->SetLineWidth(2.0f);
  actor->SetHiddenOpacity(1.0);
}

} // namespace

struct vtkPickMarker::Internals
{
  vtkNew<vtkOutlineSource> box;
  vtkNew<vtkOverlayActor> boxActor;
  vtkNew<vtkRegularPolygonSource> circles[3];
  vtkNew<vtkAppendPolyData> sphere;
  vtkNew<vtkOverlayActor> sphereActor;
  vtkNew<vtkPolyData> cross;
  vtkNew<vtkPolyDataMapper2D> crossMapper;
  vtkNew<vtkActor2D> crossActor;
  bool hasBox = false;
  bool hasSphere = false;
};

vtkStandardNewMacro(vtkPickMarker);

vtkPickMarker::vtkPickMarker()
  : Parts(new Internals)
{
  Internals& parts = *this->Parts;
  setUpLines(parts.boxActor, parts.box->GetOutputPort(), kVoxelColor);
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkRegularPolygonSource* circle = parts.circles[axis];
    circle->SetNormal(axis == 0, axis == 1, axis == 2);
    circle->SetNumberOfSides(48);
    circle->GeneratePolygonOff();
    parts.sphere->AddInputConnection(circle->GetOutputPort());
  }
  setUpLines(parts.sphereActor, parts.sphere->GetOutputPort(), kBandwidthColor);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> arms;
  for (const double direction : { 1.0, -1.0 })
  {
    for (const bool upright : { false, true })
    {
      const vtkIdType begin = points->InsertNextPoint(
        upright ? 0.0 : direction * kArmBegin, upright ? direction * kArmBegin : 0.0, 0.0);
      points->InsertNextPoint(upright ? 0.0 : direction * kArmEnd, upright ? direction * kArmEnd : 0.0, 0.0);
      const vtkIdType ends[2] = { begin, begin + 1 };
      arms->InsertNextCell(2, ends);
    }
  }
  parts.cross->SetPoints(points);
  parts.cross->SetLines(arms);
  parts.crossMapper->SetInputData(parts.cross);
  parts.crossActor->SetMapper(parts.crossMapper);
  parts.crossActor->GetProperty()->SetColor(kCrossColor[0], kCrossColor[1], kCrossColor[2]);
  parts.crossActor->GetProperty()->SetLineWidth(2.0f);
  parts.crossActor->GetPositionCoordinate()->SetCoordinateSystemToWorld();
  this->SetVisibility(false);
}

vtkPickMarker::~vtkPickMarker() = default;

void vtkPickMarker::Mark(const double point[3], const double voxel[6], double bandwidth)
{
  Internals& parts = *this->Parts;
  parts.hasBox = voxel != nullptr;
  if (voxel)
  {
    double bounds[6];
    std::copy(voxel, voxel + 6, bounds);
    parts.box->SetBounds(bounds);
  }
  parts.hasSphere = bandwidth > 0.0;
  for (auto& circle : parts.circles)
  {
    circle->SetCenter(point[0], point[1], point[2]);
    circle->SetRadius(std::max(bandwidth, 1e-12));
  }
  parts.crossActor->GetPositionCoordinate()->SetValue(point[0], point[1], point[2]);
  this->SetVisibility(true);
}

void vtkPickMarker::SetVisibility(bool visible)
{
  this->Parts->boxActor->SetVisibility(visible && this->Parts->hasBox);
  this->Parts->sphereActor->SetVisibility(visible && this->Parts->hasSphere);
  this->Parts->crossActor->SetVisibility(visible);
}

bool vtkPickMarker::GetVisibility() const
{
  return const_cast<vtkActor2D*>(this->Parts->crossActor.Get())->GetVisibility() != 0;
}

void vtkPickMarker::AddTo(vtkRenderer* renderer)
{
  renderer->AddActor(this->Parts->boxActor);
  renderer->AddActor(this->Parts->sphereActor);
  renderer->AddActor2D(this->Parts->crossActor);
}

void vtkPickMarker::RemoveFrom(vtkRenderer* renderer)
{
  renderer->RemoveActor(this->Parts->boxActor);
  renderer->RemoveActor(this->Parts->sphereActor);
  renderer->RemoveActor2D(this->Parts->crossActor);
}

void vtkPickMarker::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Visibility: " << this->GetVisibility() << "\n";
}
