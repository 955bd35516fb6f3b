#include "HapticSceneBuilder.h"

#include "PolyDataAccess.h"
#include "SmpExecutor.h"

#include "vtkDataArray.h"
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

/// Tuples as values that consist of so many numbers. Empty where @p array is null.
template <typename Value>
std::vector<Value> valuesOf(vtkDataArray* array)
{
  std::vector<Value> values(array ? std::size_t(array->GetNumberOfTuples()) : 0);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    array->GetTuple(vtkIdType(i), reinterpret_cast<double*>(&values[i]));
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
  input.counts = valuesOf<double>(pointArray(cloud, "VoxelPointCount", 1));
  input.proxyRadii = valuesOf<double>(pointArray(cloud, "ProxyRadius", 1));
  input.bandwidth = bandwidth;
  if (useCovariance)
  {
    input.covariances = valuesOf<SymMat3>(pointArray(cloud, "VoxelCovariance", 6));
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
