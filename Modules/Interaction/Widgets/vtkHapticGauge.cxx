#include "vtkHapticGauge.h"

#include "vtkActor2D.h"
#include "vtkCellArray.h"
#include "vtkCoordinate.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty2D.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace
{

/// Pixels, from the anchor's display position.
constexpr double kAside = 22.0;
constexpr double kWidth = 9.0;
constexpr double kHeight = 60.0;
constexpr double kTextAside = kAside + kWidth + 6.0;

/// A rectangle in pixels, kept where the anchor is drawn.
struct Bar
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkPolyData> shape;
  vtkNew<vtkPolyDataMapper2D> mapper;
  vtkNew<vtkActor2D> actor;

  void setUp(bool filled, double red, double green, double blue, double opacity)
  {
    const vtkIdType corners[5] = { 0, 1, 2, 3, 0 };
    this->points->SetNumberOfPoints(4);
    this->shape->SetPoints(this->points);
    vtkNew<vtkCellArray> cell;
    cell->InsertNextCell(filled ? 4 : 5, corners);
    filled ? this->shape->SetPolys(cell) : this->shape->SetLines(cell);
    this->mapper->SetInputData(this->shape);
    this->actor->SetMapper(this->mapper);
    this->actor->GetProperty()->SetColor(red, green, blue);
    this->actor->GetProperty()->SetOpacity(opacity);
    this->actor->GetPositionCoordinate()->SetCoordinateSystemToWorld();
    this->actor->VisibilityOff();
  }
  void setHeight(double bottom, double top, double side)
  {
    this->points->SetPoint(0, side * kAside, bottom, 0.0);
    this->points->SetPoint(1, side * (kAside + kWidth), bottom, 0.0);
    this->points->SetPoint(2, side * (kAside + kWidth), top, 0.0);
    this->points->SetPoint(3, side * kAside, top, 0.0);
    this->points->Modified();
    this->shape->Modified();
  }
};

} // namespace

struct vtkHapticGauge::Internals
{
  Bar ground;
  Bar fill;
  Bar frame;
  /// The text's own position is pixels from a corner that follows the anchor.
  vtkNew<vtkTextActor> number;
  vtkNew<vtkCoordinate> anchor;
  double part = 0.0; // of the full bar
  double side = 1.0; // -1: left

  void place();
};

void vtkHapticGauge::Internals::place()
{
  this->ground.setHeight(-0.5 * kHeight, 0.5 * kHeight, this->side);
  this->frame.setHeight(-0.5 * kHeight, 0.5 * kHeight, this->side);
  this->fill.setHeight(-0.5 * kHeight, (this->part - 0.5) * kHeight, this->side);
  this->number->SetPosition(this->side * kTextAside, 0.0);
  vtkTextProperty* text = this->number->GetTextProperty();
  this->side > 0.0 ? text->SetJustificationToLeft() : text->SetJustificationToRight();
}

vtkStandardNewMacro(vtkHapticGauge);

vtkHapticGauge::vtkHapticGauge()
  : Parts(new Internals)
{
  Internals& parts = *this->Parts;
  parts.ground.setUp(true, 1.0, 1.0, 1.0, 0.75);
  parts.fill.setUp(true, 0.95, 0.42, 0.02, 1.0);
  parts.frame.setUp(false, 0.15, 0.15, 0.18, 1.0);
  parts.anchor->SetCoordinateSystemToWorld();
  vtkTextProperty* text = parts.number->GetTextProperty();
  text->SetFontSize(15);
  text->SetBold(true);
  text->SetColor(0.08, 0.08, 0.10);
  text->SetBackgroundColor(1.0, 1.0, 1.0);
  text->SetBackgroundOpacity(0.6);
  text->SetVerticalJustificationToCentered();
  parts.number->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  parts.number->GetPositionCoordinate()->SetReferenceCoordinate(parts.anchor);
  parts.number->VisibilityOff();
  parts.place();
}

vtkHapticGauge::~vtkHapticGauge() = default;

void vtkHapticGauge::Show(const double anchor[3], double newtons)
{
  if (!std::isfinite(anchor[0] + anchor[1] + anchor[2]) || !std::isfinite(newtons))
  {
    return;
  }
  Internals& parts = *this->Parts;
  parts.part = std::min(1.0, std::abs(newtons) / this->MaximumForce);
  parts.place();
  for (Bar* bar : { &parts.ground, &parts.fill, &parts.frame })
  {
    bar->actor->GetPositionCoordinate()->SetValue(anchor[0], anchor[1], anchor[2]);
  }
  parts.anchor->SetValue(anchor[0], anchor[1], anchor[2]);
  char words[40];
  std::snprintf(words, sizeof(words), " %.2f N ", newtons);
  parts.number->SetInput(words);
  this->SetVisibility(true);
}

void vtkHapticGauge::SetLeft(bool left)
{
  this->Parts->side = left ? -1.0 : 1.0;
  this->Parts->place();
}

bool vtkHapticGauge::GetLeft() const
{
  return this->Parts->side < 0.0;
}

void vtkHapticGauge::SetVisibility(bool visible)
{
  for (Bar* bar : { &this->Parts->ground, &this->Parts->fill, &this->Parts->frame })
  {
    bar->actor->SetVisibility(visible);
  }
  this->Parts->number->SetVisibility(visible);
}

bool vtkHapticGauge::GetVisibility() const
{
  return const_cast<vtkTextActor*>(this->Parts->number.Get())->GetVisibility() != 0;
}

void vtkHapticGauge::AddTo(vtkRenderer* renderer)
{
  for (Bar* bar : { &this->Parts->ground, &this->Parts->fill, &this->Parts->frame })
  {
    renderer->AddActor2D(bar->actor);
  }
  renderer->AddActor2D(this->Parts->number);
}

void vtkHapticGauge::RemoveFrom(vtkRenderer* renderer)
{
  for (Bar* bar : { &this->Parts->ground, &this->Parts->fill, &this->Parts->frame })
  {
    renderer->RemoveActor2D(bar->actor);
  }
  renderer->RemoveActor2D(this->Parts->number);
}

void vtkHapticGauge::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumForce: " << this->MaximumForce << "\n";
  os << indent << "Visibility: " << this->GetVisibility() << "\n";
}
