#include "Benchmark/Resample/Clouds.h"

#include "Shapes/Shapes.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

constexpr std::int64_t kPiece = 1000000;
constexpr double kUnscaledRadius = 0.025; // of Shape::Sphere
constexpr double kPi = 3.14159265358979323846;

using FloatPoint = std::array<float, 3>;

void fillRandomly(float* xyz, std::int64_t count)
{
  std::vector<Vec3> piece;
  for (std::int64_t begin = 0; begin < count; begin += kPiece)
  {
    const std::int64_t size = std::min(kPiece, count - begin);
    (void)generateShape(Shape::Sphere, size, std::uint64_t(1 + begin / kPiece), 0.0, piece);
    for (const Vec3& p : piece)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        *xyz++ = float(p[axis] * (kSphereRadius / kUnscaledRadius));
      }
    }
  }
}

void sortIntoRows(float* xyz, std::int64_t count)
{
  const double area = 4.0 * kPi * kSphereRadius * kSphereRadius;
  const double pitch = std::sqrt(area / double(count));
  std::vector<std::pair<double, FloatPoint>> places; // row and fraction of the turn; the point
  places.reserve(std::size_t(count));
  for (std::int64_t i = 0; i < count; ++i)
  {
    const FloatPoint p = { xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2] };
    const double row = std::floor((double(p[0]) + kSphereRadius) / pitch);
    const double turn = 0.5 + std::atan2(double(p[2]), double(p[1])) / (2.0 * kPi);
    places.emplace_back(row + 0.999 * turn, p);
  }
  std::sort(places.begin(), places.end());
  for (const auto& place : places)
  {
    xyz = std::copy(place.second.begin(), place.second.end(), xyz);
  }
}

} // namespace

const char* orderName(PointOrder order)
{
  return order == PointOrder::Random ? "random" : "scan";
}

vtkSmartPointer<vtkPolyData> sphereCloud(std::int64_t count, PointOrder order)
{
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(count);
  fillRandomly(coordinates->GetPointer(0), count);
  if (order == PointOrder::Scan)
  {
    sortIntoRows(coordinates->GetPointer(0), count);
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

void addAttributes(vtkPolyData* cloud)
{
  const PointView points = viewOf(cloud);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName(kColors);
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(points.size());
  vtkNew<vtkFloatArray> normals;
  normals->SetName(kNormals);
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(points.size());
  vtkNew<vtkFloatArray> intensity;
  intensity->SetName(kIntensity);
  intensity->SetNumberOfTuples(points.size());
  vtkNew<vtkUnsignedCharArray> labels;
  labels->SetName(kLabels);
  labels->SetNumberOfTuples(points.size());
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Vec3 normal = points[i] * (1.0 / kSphereRadius);
    for (int axis = 0; axis < 3; ++axis)
    {
      normals->SetComponent(i, axis, normal[axis]);
      colors->SetComponent(i, axis, std::floor(127.5 * (1.0 + normal[axis])));
    }
    intensity->SetValue(i, float(std::abs(normal.z)));
    labels->SetValue(i, static_cast<unsigned char>(normal.z > 0.0 ? i % 3 : 3));
  }
  cloud->GetPointData()->AddArray(colors);
  cloud->GetPointData()->SetNormals(normals);
  cloud->GetPointData()->AddArray(intensity);
  cloud->GetPointData()->AddArray(labels);
}

PointView viewOf(vtkPolyData* cloud)
{
  auto* coordinates = vtkFloatArray::SafeDownCast(cloud->GetPoints()->GetData());
  return { coordinates->GetPointer(0), cloud->GetNumberOfPoints() };
}

ResampleTask taskOn(vtkPolyData* cloud, std::int64_t dimension)
{
  ResampleTask task;
  task.cloud = cloud;
  const double half = 0.5 * kWorkspaceEdge;
  task.workspace.include({ -half, -half, -half });
  task.workspace.include({ half, half, half });
  task.dimension = dimension;
  task.leaf = kWorkspaceEdge / double(dimension);
  return task;
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
