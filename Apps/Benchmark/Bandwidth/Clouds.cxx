#include "Benchmark/Bandwidth/Clouds.h"

#include "vtkPointCloudReader.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

constexpr double kSphereRadius = 0.025; // of Shape::Sphere
constexpr double kPlaneEdge = 0.08;     // of Shape::DensityStep
constexpr double kStepRatio = 16.0;

void giveBody(NamedCloud& cloud)
{
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetArray(cloud.xyz.data(), vtkIdType(cloud.xyz.size()), 1);
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  cloud.polyData = vtkSmartPointer<vtkPolyData>::New();
  cloud.polyData->SetPoints(points);
}

} // namespace

NamedCloud shapeCloud(Shape shape, std::int64_t count)
{
  NamedCloud cloud;
  cloud.name = shapeName(shape);
  std::vector<Vec3> points;
  (void)generateShape(shape, count, 1, 0.0, points);
  for (const Vec3& p : points)
  {
    cloud.xyz.insert(cloud.xyz.end(), { float(p.x), float(p.y), float(p.z) });
  }
  giveBody(cloud);
  return cloud;
}

NamedCloud fileCloud(const std::string& fileName, std::int64_t count)
{
  vtkNew<vtkPointCloudReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  if (const std::string message = reader->GetErrorMessage(); !message.empty())
  {
    throw std::runtime_error(message);
  }
  NamedCloud cloud;
  cloud.name = std::filesystem::path(fileName).filename().string();
  const vtkIdType all = reader->GetOutput()->GetNumberOfPoints();
  const vtkIdType step = std::max<vtkIdType>(1, all / std::max<std::int64_t>(1, count));
  for (vtkIdType i = 0; i < all; i += step)
  {
    Vec3 p;
    reader->GetOutput()->GetPoint(i, &p.x);
    if (isFinite(p))
    {
      cloud.xyz.insert(cloud.xyz.end(), { float(p.x), float(p.y), float(p.z) });
    }
  }
  giveBody(cloud);
  return cloud;
}

double trueDensity(Shape shape, std::int64_t count, const Vec3& p)
{
  if (shape == Shape::Sphere)
  {
    return double(count) / (4.0 * kPi * kSphereRadius * kSphereRadius);
  }
  const double sparse = double(count) / (0.5 * kPlaneEdge * kPlaneEdge * (1.0 + kStepRatio));
  return p.x > 0.0 ? kStepRatio * sparse : sparse;
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
