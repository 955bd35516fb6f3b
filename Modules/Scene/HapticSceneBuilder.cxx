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

/// The field array @p name if it holds at least @p values numbers.
vtkDataArray* fieldArray(vtkPolyData* cloud, const char* name, vtkIdType values)
{
  vtkDataArray* array = cloud->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfValues() >= values ? array : nullptr;
}

double fieldValue(vtkDataArray* array, vtkIdType i)
{
  const int components = array->GetNumberOfComponents();
  return array->GetComponent(i / components, static_cast<int>(i % components));
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
  if (vtkDataArray* spacing = fieldArray(cloud, "LatticeSpacing", 3))
  {
    input.cellSize = std::max({ fieldValue(spacing, 0), fieldValue(spacing, 1), fieldValue(spacing, 2) });
  }
  if (vtkDataArray* origin = fieldArray(cloud, "LatticeOrigin", 3))
  {
    input.corner = Vec3{ fieldValue(origin, 0), fieldValue(origin, 1), fieldValue(origin, 2) };
  }
  if (vtkDataArray* matrix = fieldArray(cloud, "ModelToWorkspace", 16))
  {
    for (vtkIdType i = 0; i < 12; ++i)
    {
      input.modelToWorkspace.m[i / 4][i % 4] = fieldValue(matrix, i);
    }
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
