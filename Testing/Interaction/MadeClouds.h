/// @file
/// Clouds for tests of what is felt and seen of one.
#pragma once

#include "Shapes/Shapes.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <vector>

namespace pointhaptics
{
namespace trial
{

/// A cloud of @p points as numbers of the VTK type @p type.
inline vtkSmartPointer<vtkPolyData> cloudOf(const std::vector<Vec3>& points, int type = VTK_DOUBLE)
{
  vtkNew<vtkPoints> places;
  places->SetDataType(type);
  for (const Vec3& p : points)
  {
    places->InsertNextPoint(&p.x);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(places);
  return cloud;
}

/// @p count points in floats on a shape, always the same ones.
inline vtkSmartPointer<vtkPolyData> shapeCloud(Shape shape, std::int64_t count, double noise = 0.0)
{
  std::vector<Vec3> points;
  EXPECT_EQ(generateShape(shape, count, 1, noise, points), Status::Ok);
  return cloudOf(points, VTK_FLOAT);
}

/// Points on whole millimetres at z = 0: x from @p x0 to @p x1, y as far as @p halfWidth from 0; metres.
inline vtkSmartPointer<vtkPolyData> flatCloud(double x0, double x1, double halfWidth)
{
  const auto millimetres = [](double metres) { return int(std::lround(1000.0 * metres)); };
  const int rows = millimetres(halfWidth);
  std::vector<Vec3> points;
  for (int x = millimetres(x0); x <= millimetres(x1); ++x)
  {
    for (int y = -rows; y <= rows; ++y)
    {
      points.emplace_back(0.001 * x, 0.001 * y, 0.0);
    }
  }
  return cloudOf(points);
}

} // namespace trial
} // namespace pointhaptics
