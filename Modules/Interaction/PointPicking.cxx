#include "PointPicking.h"

#include "PolyDataAccess.h"
#include "SmpExecutor.h"

#include "Core/AffineTransform.h"
#include "Core/NeighborQuery.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <cmath>
#include <cstdio>
#include <vector>

namespace pointhaptics
{
namespace
{

bool fieldValues(vtkPolyData* cloud, const char* name, vtkIdType count, double* values)
{
  vtkDataArray* array = cloud->GetFieldData()->GetArray(name);
  if (!array || array->GetNumberOfValues() < count)
  {
    return false;
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    const int components = array->GetNumberOfComponents();
    values[i] = array->GetComponent(i / components, static_cast<int>(i % components));
  }
  return true;
}

std::optional<Vec3> placeInCloud(vtkPolyData* cloud, const Vec3& inWorkspace)
{
  double elements[16];
  if (!fieldValues(cloud, "ModelToWorkspace", 16, elements))
  {
    return {};
  }
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(elements);
  if (matrix->Determinant() == 0.0)
  {
    return {};
  }
  matrix->Invert();
  const double p[4] = { inWorkspace.x, inWorkspace.y, inWorkspace.z, 1.0 };
  double q[4];
  matrix->MultiplyPoint(p, q);
  return Vec3{ q[0], q[1], q[2] };
}

void findVoxel(vtkPolyData* cloud, PickedPoint& picked)
{
  Vec3 origin;
  Vec3 spacing;
  if (!fieldValues(cloud, "LatticeOrigin", 3, &origin.x) ||
    !fieldValues(cloud, "LatticeSpacing", 3, &spacing.x))
  {
    return;
  }
  Vec3 voxel;
  Bounds bounds;
  for (int axis = 0; axis < 3; ++axis)
  {
    voxel[axis] = std::floor((picked.inWorkspace[axis] - origin[axis]) / spacing[axis]);
    bounds.minimum[axis] = origin[axis] + voxel[axis] * spacing[axis];
    bounds.maximum[axis] = bounds.minimum[axis] + spacing[axis];
  }
  picked.voxel = voxel;
  picked.voxelBounds = bounds;
}

} // namespace

bool pickPoint(
  vtkPolyData* cloud, vtkRenderer* renderer, double x, double y, double pixels, PickedPoint& picked)
{
  double viewport[4];
  renderer->GetViewport(viewport);
  const int* window = renderer->GetVTKWindow()->GetSize();
  const int* size = renderer->GetSize();
  const double left = viewport[0] * window[0];
  const double bottom = viewport[1] * window[1];
  vtkMatrix4x4* projection =
    renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), 0, 1);
  double best = INFINITY;
  vtkIdType found = -1;
  Vec3 p;
  const double* m = projection->GetData();
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    cloud->GetPoint(i, &p.x);
    const double w = m[12] * p.x + m[13] * p.y + m[14] * p.z + m[15];
    const double depth = (m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]) / w;
    if (!(w > 0.0) || !(depth < best))
    {
      continue;
    }
    const double column = left + 0.5 * size[0] * (1.0 + (m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3]) / w);
    const double row = bottom + 0.5 * size[1] * (1.0 + (m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7]) / w);
    if (std::hypot(column - x, row - y) <= pixels)
    {
      best = depth;
      found = i;
    }
  }
  if (found < 0)
  {
    return false;
  }
  picked = PickedPoint();
  picked.index = found;
  cloud->GetPoint(found, &picked.inWorkspace.x);
  picked.inCloud = placeInCloud(cloud, picked.inWorkspace);
  findVoxel(cloud, picked);
  return true;
}

Status measurePicked(vtkPolyData* cloud, const LocalBandwidthSettings& settings, PickedPoint& picked)
{
  const PointAccess access(cloud->GetPoints());
  NeighborQuery query;
  query.build(access.view(), SmpExecutor());
  // The point with its neighbourhood alone has the same bandwidth as among all.
  std::vector<double> positions{ picked.inWorkspace.x, picked.inWorkspace.y, picked.inWorkspace.z };
  vtkDataArray* pointCounts = cloud->GetPointData()->GetArray("VoxelPointCount");
  std::vector<double> counts;
  const auto addCount = [&](vtkIdType index)
  {
    if (pointCounts && pointCounts->GetNumberOfComponents() == 1)
    {
      counts.push_back(pointCounts->GetComponent(index, 0));
    }
  };
  addCount(picked.index);
  const auto add = [&](std::int64_t index)
  {
    if (index != picked.index)
    {
      Vec3 p;
      cloud->GetPoint(static_cast<vtkIdType>(index), &p.x);
      positions.insert(positions.end(), { p.x, p.y, p.z });
      addCount(static_cast<vtkIdType>(index));
    }
  };
  if (settings.fixedRadius)
  {
    query.visitBall(
      picked.inWorkspace, settings.radius, [&](const Vec3&, double, std::int64_t index) { add(index); });
  }
  else
  {
    std::vector<Neighbor> neighbors(std::size_t(settings.numberOfNeighbors) + 1);
    const int count = query.nearest(picked.inWorkspace, settings.numberOfNeighbors + 1, neighbors.data());
    for (int i = 0; i < count; ++i)
    {
      add(neighbors[std::size_t(i)].index);
    }
  }
  const PointView view(positions.data(), std::int64_t(positions.size() / 3));
  NeighborQuery neighborhood;
  neighborhood.build(view);
  LocalBandwidthSettings alone = settings;
  alone.smoothRadius = false;
  std::vector<double> bandwidths;
  std::vector<double> radii;
  const Status status = localBandwidths(view, counts, neighborhood, alone, bandwidths, radii);
  if (status == Status::Ok)
  {
    picked.bandwidth = bandwidths.front();
    picked.radius = radii.front();
  }
  return status;
}

std::string describePicked(vtkPolyData* cloud, const PickedPoint& picked)
{
  char line[200];
  std::string text;
  if (picked.inCloud)
  {
    std::snprintf(line, sizeof(line), "in the file  %.6g  %.6g  %.6g\n", picked.inCloud->x, picked.inCloud->y,
      picked.inCloud->z);
    text += line;
  }
  std::snprintf(line, sizeof(line), "in the workspace  %.2f  %.2f  %.2f mm", 1e3 * picked.inWorkspace.x,
    1e3 * picked.inWorkspace.y, 1e3 * picked.inWorkspace.z);
  text += line;
  if (picked.voxel)
  {
    std::snprintf(
      line, sizeof(line), "\nvoxel  %.0f  %.0f  %.0f", picked.voxel->x, picked.voxel->y, picked.voxel->z);
    text += line;
  }
  if (picked.bandwidth > 0.0)
  {
    std::snprintf(line, sizeof(line), "\nbandwidth %.3g mm, proxy radius %.3g mm", 1e3 * picked.bandwidth,
      1e3 * picked.radius);
    text += line;
  }
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    if (!array || !array->GetName() || std::string(array->GetName()) == "VoxelCovariance")
    {
      continue;
    }
    text += "\n" + std::string(array->GetName()) + " ";
    for (int c = 0; c < std::min(array->GetNumberOfComponents(), 9); ++c)
    {
      std::snprintf(line, sizeof(line), " %.6g", array->GetComponent(picked.index, c));
      text += line;
    }
  }
  return text;
}

} // namespace pointhaptics
