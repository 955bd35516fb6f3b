#include "HapticSceneBuilder.h"

#include "SmpExecutor.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{

/// The array @p name with @p components per point, or null where it is missing or has another shape.
vtkDataArray* pointArray(vtkPolyData* cloud, const char* name, int components)
{
  vtkDataArray* array = cloud->GetPointData()->GetArray(name);
  const bool fits = array && array->GetNumberOfComponents() == components &&
    array->GetNumberOfTuples() == cloud->GetNumberOfPoints();
  return fits ? array : nullptr;
}

std::vector<double> copyScalars(vtkDataArray* array)
{
  std::vector<double> values;
  if (array)
  {
    values.resize(static_cast<std::size_t>(array->GetNumberOfTuples()));
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = array->GetComponent(static_cast<vtkIdType>(i), 0);
    }
  }
  return values;
}

std::vector<SymMat3> copyCovariances(vtkDataArray* array)
{
  std::vector<SymMat3> values;
  if (array)
  {
    values.resize(static_cast<std::size_t>(array->GetNumberOfTuples()));
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      double c[6];
      array->GetTuple(static_cast<vtkIdType>(i), c);
      values[i] = { c[0], c[1], c[2], c[3], c[4], c[5] };
    }
  }
  return values;
}

} // namespace

bool fieldValues(vtkPolyData* cloud, const char* name, int count, double* values)
{
  vtkDataArray* array = cloud->GetFieldData()->GetArray(name);
  if (!array || array->GetNumberOfValues() < count)
  {
    return false;
  }
  for (int i = 0; i < count; ++i)
  {
    const int components = array->GetNumberOfComponents();
    values[i] = array->GetComponent(i / components, i % components);
  }
  return true;
}

std::shared_ptr<const HapticScene> makeHapticScene(vtkPolyData* cloud, Status& status, bool useCovariance,
  const std::optional<LocalBandwidthSettings>& bandwidth, const VoxelMeanSettings* voxels)
{
  if (!cloud || cloud->GetNumberOfPoints() == 0)
  {
    status = Status::Empty;
    return nullptr;
  }
  HapticSceneInput input;
  input.points.resize(static_cast<std::size_t>(cloud->GetNumberOfPoints()));
  for (std::size_t i = 0; i < input.points.size(); ++i)
  {
    cloud->GetPoint(static_cast<vtkIdType>(i), &input.points[i].x);
  }
  input.counts = copyScalars(pointArray(cloud, "VoxelPointCount", 1));
  input.proxyRadii = copyScalars(pointArray(cloud, "ProxyRadius", 1));
  input.bandwidth = bandwidth;
  if (useCovariance)
  {
    input.covariances = copyCovariances(pointArray(cloud, "VoxelCovariance", 6));
  }
  double values[16];
  if (fieldValues(cloud, "LatticeSpacing", 3, values))
  {
    input.cellSize = std::max({ values[0], values[1], values[2] });
  }
  if (fieldValues(cloud, "LatticeOrigin", 3, values))
  {
    input.corner = Vec3{ values[0], values[1], values[2] };
  }
  if (fieldValues(cloud, "ModelToWorkspace", 16, values))
  {
    input.modelToWorkspace = AffineTransform::fromRows(values);
  }
  if (voxels)
  {
    auto origin = std::make_shared<SceneOrigin>();
    origin->voxels = *voxels;
    origin->bandwidth = bandwidth;
    origin->useCovariance = useCovariance;
    origin->modelToWorkspace = input.modelToWorkspace;
    input.origin = std::move(origin);
  }
  return HapticScene::create(std::move(input), status, SmpExecutor());
}

} // namespace pointhaptics
