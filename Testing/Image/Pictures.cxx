#include "Pictures.h"

#include "CloudAppearance.h"
#include "CloudOrientation.h"
#include "vtkHapticProps.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Shapes.h"
#include "Core/Vector3.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <vector>

namespace pointhaptics
{
namespace testing
{
namespace
{

/// Centre of a proxy that is wrong by this much is to be seen: 2 pixels.
constexpr double kProxyShift = 0.001;
/// Part of the colour range by which the wrong colours are off.
constexpr double kColorShift = 0.2;

vtkSmartPointer<vtkPolyData> cloudOf(const std::vector<Vec3>& positions)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : positions)
  {
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

/// Points on a sphere along a spiral: even, and the same everywhere.
std::vector<Vec3> spiralSphere(int count, double radius)
{
  const double goldenAngle = 3.14159265358979323846 * (3.0 - std::sqrt(5.0));
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double across = std::sqrt(1.0 - z * z);
    points.push_back(
      radius * Vec3{ across * std::cos(goldenAngle * i), across * std::sin(goldenAngle * i), z });
  }
  return points;
}

vtkSmartPointer<vtkPolyData> resample(vtkPolyData* cloud, double voxelSize)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
  resampler->SetVoxelSize(voxelSize);
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  bandwidth->SetInputConnection(resampler->GetOutputPort());
  bandwidth->Update();
  return bandwidth->GetOutput();
}

void look(vtkRenderer* renderer)
{
  CloudOrientation orientation;
  placeCamera(renderer->GetActiveCamera(), orientation, {}, 0.1, 28.0, 18.0);
  applyBackground(renderer);
}

/// The cloud without its point nearest the camera: that one is certainly seen.
vtkSmartPointer<vtkPolyData> withoutNearest(vtkPolyData* cloud, const Vec3& camera)
{
  vtkIdType nearest = 0;
  double best = INFINITY;
  Vec3 p;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    cloud->GetPoint(i, &p.x);
    if (norm(p - camera) < best)
    {
      best = norm(p - camera);
      nearest = i;
    }
  }
  auto mutant = vtkSmartPointer<vtkPolyData>::New();
  mutant->ShallowCopy(cloud);
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    if (i != nearest)
    {
      vertices->InsertNextCell(1, &i);
    }
  }
  mutant->SetVerts(vertices);
  return mutant;
}

/// @param colorShift moves the colour range by this part of it.
void showCloud(vtkRenderer* renderer, vtkPolyData* cloud, const std::string& colorBy, double pointSize,
  double colorShift = 0.0)
{
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  mapper->SetInputData(cloud);
  actor->SetMapper(mapper);
  applyCloudAppearance(cloud, mapper, actor, colorBy, pointSize);
  auto* colors = vtkLookupTable::SafeDownCast(mapper->GetLookupTable());
  const double* range = colors->GetTableRange();
  const double shift = colorShift * (range[1] - range[0]);
  colors->SetTableRange(range[0] + shift, range[1] + shift);
  renderer->AddActor(actor);
}

/// A contact at @p point with the hand @p depth below it; the stiffness is the default 800 N/m.
ProxyState contactAt(const Vec3& point, const Vec3& normal, double depth, double radius)
{
  ProxyState state;
  state.contact = true;
  state.proxy = point;
  state.normal = normal;
  state.hip = point - depth * normal;
  state.force = 800.0 * depth * normal;
  state.radius = radius;
  state.sphereCenter = point + radius * normal;
  return state;
}

void showTouch(vtkRenderer* renderer, const ProxyState& state)
{
  vtkNew<vtkHapticProps> props;
  props->AddTo(renderer);
  props->Update(state);
}

void showWorkspace(vtkRenderer* renderer)
{
  vtkNew<vtkHapticProps> props;
  props->AddTo(renderer);
}

/// Voxel means of a sphere, far enough apart to tell them from each other, in the workspace.
void buildVoxelMeans(bool dropsPoint, vtkRenderer* renderer)
{
  const vtkSmartPointer<vtkPolyData> cloud = cloudOf(spiralSphere(4000, 0.038));
  addHeightArray(cloud, { 0, 0, 1 });
  vtkSmartPointer<vtkPolyData> means = resample(cloud, 0.008);
  look(renderer);
  if (dropsPoint)
  {
    Vec3 camera;
    renderer->GetActiveCamera()->GetPosition(&camera.x);
    means = withoutNearest(means, camera);
  }
  showCloud(renderer, means, kHeightArrayName, 5.0);
  showWorkspace(renderer);
}

/// The proxy on a sphere: pink sphere, green normal, force arrow.
void buildSphereContact(bool shiftsProxy, vtkRenderer* renderer)
{
  const vtkSmartPointer<vtkPolyData> cloud = cloudOf(spiralSphere(20000, 0.03));
  addHeightArray(cloud, { 0, 0, 1 });
  look(renderer);
  showCloud(renderer, resample(cloud, 0.002), kHeightArrayName, 4.0);
  const Vec3 normal = normalized(Vec3{ 0.9, -0.6, 0.7 });
  ProxyState state = contactAt(0.03 * normal, normal, 0.004, 0.004);
  if (shiftsProxy)
  {
    state.sphereCenter += Vec3{ 0.0, 0.0, kProxyShift };
  }
  showTouch(renderer, state);
}

/// ProxyRadius as colour over a step of density, with the small and the large proxy it gives.
void buildProxyRadiusMap(bool wrongColors, vtkRenderer* renderer)
{
  std::vector<Vec3> points;
  if (generateShape(Shape::DensityStep, 12000, 7, 0.0, points) != Status::Ok)
  {
    return;
  }
  const vtkSmartPointer<vtkPolyData> means = resample(cloudOf(points), 0.0005);
  look(renderer);
  renderer->GetActiveCamera()->Elevation(25.0);
  renderer->GetActiveCamera()->OrthogonalizeViewUp();
  showCloud(renderer, means, "ProxyRadius", 4.0, wrongColors ? kColorShift : 0.0);
  double range[2];
  means->GetPointData()->GetArray("ProxyRadius")->GetRange(range);
  const Vec3 up{ 0, 0, 1 };
  showTouch(renderer, contactAt({ 0.025, 0, 0 }, up, 0.002, 0.25 * range[1]));
  showTouch(renderer, contactAt({ -0.025, 0, 0 }, up, 0.002, range[1]));
}

} // namespace

bool buildPicture(const std::string& name, const std::string& mutation, vtkRenderer* renderer)
{
  const auto build = [&](void (*function)(bool, vtkRenderer*), const char* fault)
  {
    const bool known = mutation.empty() || mutation == fault;
    if (known)
    {
      function(!mutation.empty(), renderer);
    }
    return known;
  };
  if (name == "VoxelMeans")
  {
    return build(buildVoxelMeans, "dropped-point");
  }
  if (name == "SphereContact")
  {
    return build(buildSphereContact, "shifted-proxy");
  }
  if (name == "ProxyRadiusMap")
  {
    return build(buildProxyRadiusMap, "wrong-color");
  }
  return false;
}

} // namespace testing
} // namespace pointhaptics
