#include "PickMarker.h"

#include "vtkActor2D.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCoordinate.h"
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

namespace pointhaptics
{
namespace
{

constexpr double kVoxelColor[3] = { 0.85, 0.0, 0.0 };
constexpr double kBandwidthColor[3] = { 0.0, 0.35, 0.85 };
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

PickMarker::PickMarker()
{
  setUpLines(boxActor_, box_->GetOutputPort(), kVoxelColor);
  vtkNew<vtkAppendPolyData> circles;
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkRegularPolygonSource* circle = circles_[axis];
    circle->SetNormal(axis == 0, axis == 1, axis == 2);
    circle->SetNumberOfSides(48);
    circle->GeneratePolygonOff();
    circles->AddInputConnection(circle->GetOutputPort());
  }
  setUpLines(circlesActor_, circles->GetOutputPort(), kBandwidthColor);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> arms;
  constexpr double kArms[4][2] = { { 1.0, 0.0 }, { 0.0, 1.0 }, { -1.0, 0.0 }, { 0.0, -1.0 } };
  for (const auto& [x, y] : kArms)
  {
    const vtkIdType ends[2] = { points->InsertNextPoint(x * kArmBegin, y * kArmBegin, 0.0),
      points->InsertNextPoint(x * kArmEnd, y * kArmEnd, 0.0) };
    arms->InsertNextCell(2, ends);
  }
  vtkNew<vtkPolyData> cross;
  cross->SetPoints(points);
  cross->SetLines(arms);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(cross);
  cross_->SetMapper(mapper);
  cross_->GetProperty()->SetColor(0.1, 0.1, 0.1);
  cross_->GetProperty()->SetLineWidth(2.0f);
  cross_->GetPositionCoordinate()->SetCoordinateSystemToWorld();
  this->hide();
}

PickMarker::~PickMarker() = default;

void PickMarker::addTo(vtkRenderer* renderer)
{
  renderer->AddActor(boxActor_);
  renderer->AddActor(circlesActor_);
  renderer->AddActor2D(cross_);
}

void PickMarker::mark(const Vec3& point, const std::optional<Bounds>& voxel, double bandwidth)
{
  if (voxel)
  {
    const double bounds[6] = { voxel->minimum.x, voxel->maximum.x, voxel->minimum.y, voxel->maximum.y,
      voxel->minimum.z, voxel->maximum.z };
    box_->SetBounds(bounds);
  }
  for (auto& circle : circles_)
  {
    circle->SetCenter(point.x, point.y, point.z);
    circle->SetRadius(std::max(bandwidth, 1e-12));
  }
  cross_->GetPositionCoordinate()->SetValue(point.x, point.y, point.z);
  boxActor_->SetVisibility(voxel.has_value());
  circlesActor_->SetVisibility(bandwidth > 0.0);
  cross_->VisibilityOn();
}

bool PickMarker::hide()
{
  const bool wasShown = cross_->GetVisibility() != 0;
  boxActor_->VisibilityOff();
  circlesActor_->VisibilityOff();
  cross_->VisibilityOff();
  return wasShown;
}

} // namespace pointhaptics
