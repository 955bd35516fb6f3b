/// @file
/// The clouds of the bandwidth benchmark.
#pragma once

#include "Core/Base/PointView.h"
#include "Shapes/Shapes.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{

constexpr double kPi = 3.14159265358979323846;

struct NamedCloud
{
  std::string name;
  std::vector<float> xyz;                ///< Finite points.
  vtkSmartPointer<vtkPolyData> polyData; ///< Uses xyz; no cells, no arrays.

  std::int64_t size() const { return std::int64_t(xyz.size() / 3); }
  PointView view() const { return { xyz.data(), size() }; }
};

/// @p count points of @p shape as floats, in random order, the same on every machine.
NamedCloud shapeCloud(Shape shape, std::int64_t count);
/// Every @p step-th point of the file, so that about @p count are left. Throws std::runtime_error where it
/// cannot be read.
NamedCloud fileCloud(const std::string& fileName, std::int64_t count);

/// Points per square metre at @p p of @p count points of the sphere or the density step.
double trueDensity(Shape shape, std::int64_t count, const Vec3& p);

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
