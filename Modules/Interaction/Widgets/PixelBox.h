/// @file
/// A rectangle of the picture.
#pragma once

#include "vtkActor2D.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty2D.h"

namespace pointhaptics
{

/// Pixels from the position of its actor, filled or as a frame. Hidden at first.
class PixelBox
{
public:
  PixelBox(bool isFilled, double red, double green, double blue, double opacity = 1.0)
  {
    const vtkIdType corners[5] = { 0, 1, 2, 3, 0 };
    vtkNew<vtkCellArray> cell;
    cell->InsertNextCell(isFilled ? 4 : 5, corners);
    points_->SetNumberOfPoints(4);
    vtkNew<vtkPolyData> shape;
    shape->SetPoints(points_);
    isFilled ? shape->SetPolys(cell) : shape->SetLines(cell);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(shape);
    actor_->SetMapper(mapper);
    actor_->GetProperty()->SetColor(red, green, blue);
    actor_->GetProperty()->SetOpacity(opacity);
    actor_->VisibilityOff();
  }
  void place(double left, double right, double bottom, double top)
  {
    points_->SetPoint(0, left, bottom, 0.0);
    points_->SetPoint(1, right, bottom, 0.0);
    points_->SetPoint(2, right, top, 0.0);
    points_->SetPoint(3, left, top, 0.0);
    points_->Modified();
  }
  vtkActor2D* actor() const { return actor_; }

private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkActor2D> actor_;
};

} // namespace pointhaptics
