/// @file
/// A flat cloud for tests of what is felt and seen of one.
#pragma once

#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cmath>

namespace pointhaptics
{
namespace trial
{

/// Points on whole millimetres at z = 0: x from @p x0 to @p x1, y as far as @p halfWidth from 0; metres.
inline vtkSmartPointer<vtkPolyData> flatCloud(double x0, double x1, double halfWidth)
{
  const auto millimetres = [](double metres) { return int(std::lround(1000.0 * metres)); };
  const int rows = millimetres(halfWidth);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int x = millimetres(x0); x <= millimetres(x1); ++x)
  {
    for (int y = -rows; y <= rows; ++y)
    {
      points->InsertNextPoint(0.001 * x, 0.001 * y, 0.0);
    }
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

}
} // namespace pointhaptics
