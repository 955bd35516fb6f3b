#include "PointPicking.h"

#include "AsprsClasses.h"
#include "CloudAppearance.h"
#include "CoordinateText.h"
#include "PolyDataAccess.h"
#include "ScreenMarks.h"
#include "SmpExecutor.h"
#include "vtkDepthShadingPass.h"
#include "vtkSplatMapper.h"

#include "Core/Base/AffineTransform.h"
#include "Core/Neighbors/NeighborQuery.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pointhaptics
{
namespace
{

/// Coordinates of the file are shown down to this part of a voxel.
constexpr double kStepInVoxels = 1e-3;
constexpr int kMostComponents = 9;
/// Neighbours whose reach tells how far points are apart: those around a point of a grid.
constexpr int kNeighbors = 8;

/// From the workspace to the frame of the file; nothing: the cloud does not say.
std::optional<AffineTransform> toFile(vtkPolyData* cloud)
{
  double elements[16];
  if (!fieldValues(cloud, "ModelToWorkspace", 16, elements))
  {
    return {};
  }
  const AffineTransform model = AffineTransform::fromRows(elements);
  return model.determinant() == 0.0 ? std::nullopt : std::optional(model.inverse());
}

/// Step to which coordinates of the file are shown: a thousandth of the smallest edge of a voxel; 0 where the
/// cloud has no voxels.
double coordinateStep(vtkPolyData* cloud)
{
  Vec3 spacing;
  const std::optional<AffineTransform> back = toFile(cloud);
  if (!back || !fieldValues(cloud, "LatticeSpacing", 3, &spacing.x))
  {
    return 0.0;
  }
  const double edges[3] = { norm(back->applyToVector({ spacing.x, 0.0, 0.0 })),
    norm(back->applyToVector({ 0.0, spacing.y, 0.0 })), norm(back->applyToVector({ 0.0, 0.0, spacing.z })) };
  return kStepInVoxels * *std::min_element(edges, edges + 3);
}

/// Describes an array on a line of its own.
std::string describeArray(vtkDataArray* array, vtkIdType index, double step)
{
  const std::string name = array->GetName();
  std::string text = "\n" + name + " ";
  for (int c = 0; c < std::min(array->GetNumberOfComponents(), kMostComponents); ++c)
  {
    const double value = array->GetComponent(index, c);
    text += " " + (name == kHeightArrayName ? coordinateText(value, step) : valueText(value));
  }
  if (array->GetNumberOfComponents() == 1 && holdsAsprsClasses(name))
  {
    text += std::string(" (") + asprsClass(int(array->GetComponent(index, 0))).name + ")";
  }
  return text;
}

/// Describes each array on a line, but those of @p leftOut, which gets their names.
std::string describeArrays(vtkPolyData* cloud, vtkIdType index, double step, std::set<std::string>& leftOut)
{
  std::string text;
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    const std::string name = array && array->GetName() ? array->GetName() : "";
    if (!name.empty() && leftOut.insert(name).second)
    {
      text += describeArray(array, index, step);
    }
  }
  return text;
}

/// Text of the place of a point in the file, with the decimals of its grid, or down to @p step.
std::string placeInFile(const PickedOfFile& ofFile, double step)
{
  Vec3 p;
  ofFile.cloud->GetPoint(ofFile.index, &p.x);
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int decimals = gridDecimals(ofFile.cloud, axis, p[axis]);
    text += "  " + (decimals < 0 ? coordinateText(p[axis], step) : fixedText(p[axis], decimals));
  }
  return text;
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

std::function<bool(vtkIdType, const Vec3&)> drawnBy(vtkActor* actor)
{
  auto* mapper = vtkSplatMapper::SafeDownCast(actor->GetMapper());
  if (!mapper)
  {
    return {};
  }
  vtkNew<vtkMatrix4x4> toPicture;
  toPicture->DeepCopy(actor->GetMatrix());
  vtkDataArray* lengths = mapper->GetInput()->GetPointData()->GetArray(mapper->Settings().sizeArray.c_str());
  return
    [mapper, lengths, toPicture = vtkSmartPointer<vtkMatrix4x4>(toPicture)](vtkIdType index, const Vec3& p)
  {
    if (lengths && lengths->GetComponent(index, 0) < 0.0)
    {
      return false;
    }
    const std::array<double, 6>& box = mapper->Settings().clipBox;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (p[axis] < box[std::size_t(2 * axis)] || p[axis] > box[std::size_t(2 * axis + 1)])
      {
        return false;
      }
    }
    Vec3 out = transformed(toPicture, p);
    vtkPlaneCollection* planes = mapper->GetClippingPlanes();
    for (int i = 0; planes && i < planes->GetNumberOfItems(); ++i)
    {
      if (planes->GetItem(i)->EvaluateFunction(&out.x) < 0.0)
      {
        return false;
      }
    }
    return true;
  };
}

namespace
{

/// True if a place that is drawn belongs to the surface at the point @p found, which is nearest to it: it is
/// no farther than twice the reach of the point's neighbours, or than @p slack.
bool isOfSurface(
  vtkPolyData* cloud, vtkIdType found, const Vec3& shown, double slack, vtkMatrix4x4* toWorkspace)
{
  const auto placeOf = [&](vtkIdType i)
  {
    Vec3 p;
    cloud->GetPoint(i, &p.x);
    return toWorkspace ? transformed(toWorkspace, p) : p;
  };
  const Vec3 middle = placeOf(found);
  const double away = norm2(shown - middle);
  if (away <= slack * slack)
  {
    return true;
  }
  // Count the neighbours within half of that distance.
  int nearer = 0;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints() && nearer < kNeighbors; ++i)
  {
    nearer += i != found && 4.0 * norm2(placeOf(i) - middle) < away ? 1 : 0;
  }
  return nearer < kNeighbors && nearer < std::max(vtkIdType(1), cloud->GetNumberOfPoints() - 1);
}

/// Length of @p pixels of the picture as deep as @p place.
double lengthOf(vtkRenderer* renderer, double pixels, const Vec3& place)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const CameraView view(camera);
  const double halfHeight = camera->GetParallelProjection() ? camera->GetParallelScale()
                                                            : dot(place - view.eye, view.forward) *
      std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
  return 2.0 * halfHeight * pixels / std::max(1, renderer->GetSize()[1]);
}

/// Finds the point that pickPoint() takes: by the place that is @p shown, or else by its pixel. -1: none.
vtkIdType findPicked(vtkPolyData* cloud, vtkRenderer* renderer, double x, double y, double pixels,
  const Vec3* shown, vtkMatrix4x4* toWorkspace, const std::function<bool(vtkIdType, const Vec3&)>& isDrawn)
{
  const ScreenProjection project(renderer, x);
  const std::array<double, 2> pointer = placeInPicture(renderer, x, y);
  const double pointerX = pointer[0] - renderer->GetOrigin()[0];
  const double pointerY = pointer[1] - renderer->GetOrigin()[1];
  const CameraView view(renderer->GetActiveCamera());
  double best = INFINITY;
  vtkIdType found = -1;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    Vec3 p;
    cloud->GetPoint(i, &p.x);
    const Vec3 at = toWorkspace ? transformed(toWorkspace, p) : p;
    const double away = shown ? norm2(at - *shown) : dot(at - view.eye, view.forward);
    if (!(away < best))
    {
      continue;
    }
    const Pixel pixel = shown ? Pixel() : project(at);
    const bool isNear = shown || (pixel.seen && std::hypot(pixel.x - pointerX, pixel.y - pointerY) <= pixels);
    if (isNear && (!isDrawn || isDrawn(i, p)))
    {
      best = away;
      found = i;
    }
  }
  return found;
}

} // namespace

bool pickPoint(vtkPolyData* cloud, vtkRenderer* renderer, double x, double y, double pixels,
  PickedPoint& picked, vtkMatrix4x4* toWorkspace, const std::function<bool(vtkIdType, const Vec3&)>& isDrawn)
{
  Vec3 shown;
  const bool isShown = vtkDepthShadingPass::FindShown(renderer, x, y, pixels, &shown.x);
  vtkIdType found =
    isShown ? findPicked(cloud, renderer, x, y, pixels, &shown, toWorkspace, isDrawn) : vtkIdType(-1);
  const bool isOfCloud =
    found >= 0 && isOfSurface(cloud, found, shown, lengthOf(renderer, pixels, shown), toWorkspace);
  if (!isOfCloud)
  {
    found = findPicked(cloud, renderer, x, y, pixels, nullptr, toWorkspace, isDrawn);
  }
  if (found < 0)
  {
    return false;
  }
  picked = PickedPoint();
  picked.index = found;
  picked.shown = isOfCloud ? std::optional<Vec3>(shown) : std::nullopt;
  cloud->GetPoint(found, &picked.inWorkspace.x);
  if (const std::optional<AffineTransform> back = toFile(cloud))
  {
    picked.inCloud = back->apply(picked.inWorkspace);
  }
  findVoxel(cloud, picked);
  return true;
}

Status measurePicked(vtkPolyData* cloud, const LocalBandwidthSettings& settings, PickedPoint& picked)
{
  const PointAccess access(cloud->GetPoints());
  NeighborQuery query;
  query.build(access.view(), SmpExecutor());
  // The point has the same bandwidth among its neighbours alone as among all points.
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
  std::vector<double> bandwidths;
  std::vector<double> radii;
  const Status status = localBandwidths(view, counts, neighborhood, settings, bandwidths, radii);
  if (status == Status::Ok)
  {
    picked.bandwidth = bandwidths.front();
    picked.radius = radii.front();
  }
  return status;
}

std::string describePicked(vtkPolyData* cloud, const PickedPoint& picked, const PickedOfFile& ofFile)
{
  std::string text;
  const double step = coordinateStep(cloud);
  if (ofFile.cloud)
  {
    text = "in the file" + placeInFile(ofFile, step) + "\n";
  }
  else if (picked.inCloud)
  {
    text = "in the file";
    for (int axis = 0; axis < 3; ++axis)
    {
      text += "  " + coordinateText((*picked.inCloud)[axis], step);
    }
    text += "\n";
  }
  const Vec3& place = picked.inWorkspace;
  text +=
    fmt::format("in the workspace  {:.2f}  {:.2f}  {:.2f} mm", 1e3 * place.x, 1e3 * place.y, 1e3 * place.z);
  if (picked.voxel)
  {
    text += fmt::format("\nvoxel  {:.0f}  {:.0f}  {:.0f}", picked.voxel->x, picked.voxel->y, picked.voxel->z);
  }
  if (picked.bandwidth > 0.0)
  {
    text += fmt::format(
      "\nbandwidth {:.3g} mm, proxy radius {:.3g} mm", 1e3 * picked.bandwidth, 1e3 * picked.radius);
  }
  std::set<std::string> leftOut = ofFile.leftOut;
  leftOut.insert("VoxelCovariance");
  if (picked.bandwidth > 0.0)
  {
    leftOut.insert("MeanBandwidth"); // told above, with its unit
  }
  if (ofFile.cloud)
  {
    text += describeArrays(ofFile.cloud, ofFile.index, step, leftOut);
  }
  return text + describeArrays(cloud, picked.index, step, leftOut);
}

} // namespace pointhaptics
