#include "Pictures.h"

#include "AsprsClasses.h"
#include "CloudAppearance.h"
#include "CloudOrientation.h"
#include "HapticSceneBuilder.h"
#include "InteractionPictures.h"
#include "OverlayPictures.h"
#include "PolyDataAccess.h"
#include "ProgressiveOrder.h"
#include "SplatPictures.h"
#include "vtkCloudAxes.h"
#include "vtkHapticProps.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Vector3.h"
#include "Haptics/Proxy.h"
#include "Shapes/Shapes.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
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
  placeCamera(renderer->GetActiveCamera(), orientation, 0.1, 28.0, 18.0);
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

void showTouch(vtkRenderer* renderer, const ProxyState& state, const double* workspace = nullptr)
{
  vtkNew<vtkHapticProps> props;
  if (workspace)
  {
    props->SetWorkspaceBounds(workspace);
  }
  props->AddTo(renderer);
  props->GetGauge()->RemoveFrom(renderer); // it has a picture of its own
  props->Update(state);
}

void showWorkspace(vtkRenderer* renderer)
{
  vtkNew<vtkHapticProps> props;
  props->AddTo(renderer);
}

/// Voxel means of a sphere, far enough apart to tell them from each other, in the workspace.
void buildVoxelMeans(const std::string& fault, vtkRenderer* renderer)
{
  const vtkSmartPointer<vtkPolyData> cloud = cloudOf(spiralSphere(4000, 0.038));
  addHeightArray(cloud, { 0, 0, 1 });
  vtkSmartPointer<vtkPolyData> means = resample(cloud, 0.008);
  look(renderer);
  if (fault == "dropped-point")
  {
    Vec3 camera;
    renderer->GetActiveCamera()->GetPosition(&camera.x);
    means = withoutNearest(means, camera);
  }
  showCloud(renderer, means, kHeightArrayName, 5.0);
  showWorkspace(renderer);
}

/// The proxy on a sphere: pink sphere, green normal, force arrow.
void buildSphereContact(const std::string& fault, vtkRenderer* renderer)
{
  const vtkSmartPointer<vtkPolyData> cloud = cloudOf(spiralSphere(20000, 0.03));
  addHeightArray(cloud, { 0, 0, 1 });
  look(renderer);
  showCloud(renderer, resample(cloud, 0.002), kHeightArrayName, 4.0);
  const Vec3 normal = normalized(Vec3{ 0.9, -0.6, 0.7 });
  ProxyState state = contactAt(0.03 * normal, normal, 0.004, 0.004);
  if (fault == "shifted-proxy")
  {
    state.sphereCenter += Vec3{ 0.0, 0.0, kProxyShift };
  }
  showTouch(renderer, state);
}

/// State of a hand that comes down at @p place, to @p depth below z = 0.
ProxyState touchFromAbove(const HapticScene& scene, const Vec3& place, double depth)
{
  Proxy proxy;
  proxy.setScene(&scene);
  ProxyState state;
  Vec3 hip = place;
  for (hip.z = 0.01; hip.z > -depth; hip.z -= 1e-4)
  {
    state = proxy.step(hip, 0.001);
  }
  return state;
}

/// A dense and a sparse region, coloured by ProxyRadius, with the small and the large proxy that stand there
/// and their normals: the paper's figure.
void buildDensityProxies(const std::string& fault, vtkRenderer* renderer)
{
  std::vector<Vec3> points;
  if (generateShape(Shape::DensityStep, 12000, 7, 0.0, points) != Status::Ok)
  {
    return;
  }
  const vtkSmartPointer<vtkPolyData> means = resample(cloudOf(points), 0.0005);
  Status status = Status::Ok;
  const std::shared_ptr<const HapticScene> scene = makeHapticScene(means, status);
  if (!scene)
  {
    return;
  }
  look(renderer);
  renderer->GetActiveCamera()->Elevation(12.0);
  renderer->GetActiveCamera()->OrthogonalizeViewUp();
  renderer->GetActiveCamera()->Zoom(1.75);
  showCloud(renderer, means, "ProxyRadius", 4.0, fault == "wrong-color" ? kColorShift : 0.0);
  ProxyState small = touchFromAbove(*scene, { 0.018, 0.0, 0.0 }, 0.002);
  ProxyState large = touchFromAbove(*scene, { -0.018, 0.0, 0.0 }, 0.002);
  if (fault == "equal-radii")
  {
    large.sphereCenter += (small.radius - large.radius) * large.normal;
    large.radius = small.radius;
  }
  small.force *= 1.25; // arrows are as long as the frame says
  large.force *= 1.25;
  // A frame close about the two, where the workspace's would be.
  const double frame[6] = { -0.04, 0.04, -0.04, 0.04, -0.001, 0.015 };
  showTouch(renderer, small, frame);
  showTouch(renderer, large, frame);
}

/// The proxy close up, with the gauge beside its arrow.
void buildForceGauge(const std::string& fault, vtkRenderer* renderer)
{
  look(renderer);
  renderer->GetActiveCamera()->Zoom(2.5);
  vtkNew<vtkHapticProps> props;
  props->AddTo(renderer);
  ProxyState state = contactAt({ 0, 0, 0 }, { 0, 0, 1 }, 0.004, 0.004);
  state.force *= fault == "wrong-force" ? 1.15 : 1.0;
  props->Update(state);
}

/// The voxel and the bandwidth of a picked point.
void buildPickMarker(const std::string& fault, vtkRenderer* renderer)
{
  static pointhaptics::PickMarker marker;
  look(renderer);
  const vtkSmartPointer<vtkPolyData> cloud = cloudOf(spiralSphere(4000, 0.038));
  addHeightArray(cloud, { 0, 0, 1 });
  showCloud(renderer, resample(cloud, 0.008), kHeightArrayName, 5.0);
  const double edge = fault == "wrong-voxel" ? 0.007 : 0.008;
  const Bounds voxel{ { 0.008, -0.040, 0.0 }, { 0.008 + edge, -0.040 + edge, edge } };
  marker.mark({ 0.012, -0.036, 0.004 }, voxel, fault == "wrong-bandwidth" ? 0.010 : 0.012);
  marker.addTo(renderer);
}

/// A touch on a sphere as a printed figure has it: one colour, cube, proxy and normal, nothing else.
void buildFigure(const std::string& fault, vtkRenderer* renderer)
{
  const vtkSmartPointer<vtkPolyData> cloud = cloudOf(spiralSphere(20000, 0.03));
  addHeightArray(cloud, { 0, 0, 1 });
  look(renderer);
  vtkNew<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  const vtkSmartPointer<vtkPolyData> means = resample(cloud, 0.002);
  mapper->SetInputData(means);
  actor->SetMapper(mapper);
  applyCloudAppearance(means, mapper, actor, kHeightArrayName, 5.0);
  renderer->AddActor(actor);
  if (fault != "colored")
  {
    applyFigureAppearance(mapper, actor, renderer);
  }
  vtkNew<vtkHapticProps> props;
  props->AddTo(renderer);
  const Vec3 normal = normalized(Vec3{ 0.9, -0.6, 0.7 });
  props->Update(contactAt(0.03 * normal, normal, 0.004, 0.004));
  props->SetHandVisibility(fault == "hand-shown");
}

/// A sphere coloured by the second component of a vector.
void buildComponentColors(const std::string& fault, vtkRenderer* renderer)
{
  const std::vector<Vec3> points = spiralSphere(20000, 0.03);
  const vtkSmartPointer<vtkPolyData> cloud = cloudOf(points);
  vtkNew<vtkFloatArray> flow;
  flow->SetName("Flow:rate"); // a colon of its own
  flow->SetNumberOfComponents(3);
  for (const Vec3& p : points)
  {
    flow->InsertNextTuple3(p.x, p.y, 2.0 * p.z);
  }
  cloud->GetPointData()->AddArray(flow);
  look(renderer);
  const char* component = fault == "other-component" ? ":z" : (fault == "magnitude" ? "" : ":1");
  showCloud(renderer, resample(cloud, 0.002), std::string("Flow:rate") + component, 5.0);
}

/// A long title and negative numbers, all within the picture.
void buildScalarBar(const std::string& fault, vtkRenderer* renderer)
{
  look(renderer);
  vtkNew<vtkScalarBarActor> bar;
  setUpScalarBar(bar);
  const auto colors = vtkSmartPointer<vtkLookupTable>::Take(newCloudColorMap());
  colors->SetTableRange(-0.00077, fault == "wrong-range" ? 0.0026 : 0.0025);
  bar->SetLookupTable(colors);
  bar->SetTitle("DistanceToSurface:x\n");
  placeScalarBar(bar, renderer);
  if (fault == "at-the-edge")
  {
    bar->SetPosition(0.90, 0.28);
    bar->SetWidth(0.08);
  }
  renderer->AddActor2D(bar);
}

/// The names of three classes beside their colours, all within the picture.
void buildClassLegend(const std::string& fault, vtkRenderer* renderer)
{
  look(renderer);
  vtkNew<vtkUnsignedCharArray> classes;
  for (const unsigned char number : { 2, 6, fault == "other-class" ? 9 : 5 })
  {
    classes->InsertNextValue(number);
  }
  vtkNew<vtkScalarBarActor> bar;
  setUpScalarBar(bar);
  bar->SetLookupTable(vtkSmartPointer<vtkLookupTable>::Take(newClassLegend(classes)));
  bar->SetTitle("Classification\n");
  placeScalarBar(bar, renderer);
  if (fault == "names-outside")
  {
    bar->SetTextPositionToPrecedeScalarBar();
  }
  renderer->AddActor2D(bar);
}

/// Box, labels and marker about a cloud of a map in millimetres, which the model turns and shrinks.
void buildCloudAxes(const std::string& fault, vtkRenderer* renderer)
{
  static const auto axes = vtkSmartPointer<vtkCloudAxes>::New();
  look(renderer);
  const double angle = fault == "no-turn" ? 0.0 : 0.3;
  const double scale = 4e-5;
  vtkNew<vtkMatrix4x4> model;
  const double rows[16] = { scale * std::cos(angle), -scale * std::sin(angle), 0, 0, scale * std::sin(angle),
    scale * std::cos(angle), 0, 0, 0, 0, scale, 0, 0, 0, 0, 1 };
  model->DeepCopy(rows);
  // The middle of the box, kilometres from the origin, comes to that of the workspace.
  const double middle[4] = { 4545600.0, 351200.0, 400.0, 1.0 };
  double there[4];
  model->MultiplyPoint(middle, there);
  for (int row = 0; row < 3; ++row)
  {
    model->SetElement(row, 3, -there[row]);
  }
  const double bounds[6] = { 4544900.0, 4546300.0, 350300.0, 352100.0, 0.0, 800.0 };
  axes->SetBounds(bounds);
  axes->SetUnitName(fault == "wrong-unit" ? "m" : "mm");
  axes->SetModelMatrix(model);
  axes->AddTo(renderer);
  axes->SetVisibility(fault != "hidden");
}

/// A beginning of the fair order, as a picture that moves shows it. Points in the order of the file would be
/// those of one end.
void showLevel(const std::string& fault, vtkRenderer* renderer, int part, double pointSize)
{
  std::vector<Vec3> points;
  if (generateShape(Shape::Idol, 40000, 3, 0.0, points) != Status::Ok)
  {
    return;
  }
  const vtkSmartPointer<vtkPolyData> means = resample(cloudOf(points), 0.0005);
  const PointAccess access(means->GetPoints());
  const std::vector<std::uint32_t> order = progressiveOrder(access.view()).indices;
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < means->GetNumberOfPoints() / part; ++i)
  {
    const vtkIdType index = fault == "unfair-order" ? i : static_cast<vtkIdType>(order[std::size_t(i)]);
    vertices->InsertNextCell(1, &index);
  }
  means->SetVerts(vertices);
  look(renderer);
  renderer->GetActiveCamera()->Zoom(1.65);
  showCloud(renderer, means, "ProxyRadius", pointSize);
}

void buildCoarseLevel(const std::string& fault, vtkRenderer* renderer)
{
  showLevel(fault, renderer, 16, 8.0);
}

void buildMiddleLevel(const std::string& fault, vtkRenderer* renderer)
{
  showLevel(fault, renderer, 4, 5.0);
}

/// The statue coloured by ProxyRadius: dark blue where it is dense, at the face, yellow where it is sparse.
void buildIdolRadius(const std::string& fault, vtkRenderer* renderer)
{
  std::vector<Vec3> points;
  if (generateShape(Shape::Idol, 40000, 3, 0.0, points) != Status::Ok)
  {
    return;
  }
  look(renderer);
  renderer->GetActiveCamera()->Zoom(1.65);
  showCloud(renderer, resample(cloudOf(points), 0.0005), "ProxyRadius", 3.0,
    fault == "wrong-color" ? kColorShift : 0.0);
}

} // namespace

void placeCamera(vtkCamera* camera, const CloudOrientation& orientation, double edge, double azimuthDegrees,
  double elevationDegrees)
{
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
  constexpr double kViewAngle = 30.0;
  const Vec3 up = normalized(orientation.up);
  const Vec3 right = normalized(cross(up, orientation.front), { 1.0, 0.0, 0.0 });
  const Vec3 front = cross(right, up);
  const double azimuth = azimuthDegrees * kDegree;
  const double elevation = elevationDegrees * kDegree;
  const Vec3 direction =
    std::cos(elevation) * (std::cos(azimuth) * front + std::sin(azimuth) * right) + std::sin(elevation) * up;
  // The cube's corners lie on a sphere of half its diagonal; seen obliquely it fills less, so come a little
  // nearer.
  const double distance = 0.5 * std::sqrt(3.0) * edge / std::sin(0.5 * kViewAngle * kDegree) * 0.92;
  const Vec3 position = distance * direction;
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetPosition(position.x, position.y, position.z);
  camera->SetViewUp(up.x, up.y, up.z);
  camera->SetViewAngle(kViewAngle);
  camera->SetClippingRange(0.05 * distance, 3.0 * distance);
}

bool buildPicture(
  const std::string& name, const std::string& mutation, const std::string& data, vtkRenderer* renderer)
{
  struct Picture
  {
    const char* name;
    std::vector<std::string> faults;
    std::function<void(const std::string& fault, vtkRenderer* renderer)> build;
  };
  const auto interaction = [&data](const char* log)
  {
    const std::string events = data + "/Interactions/" + log + ".log";
    return [events](const std::string& fault, vtkRenderer* window)
    { buildInteraction(events, fault, window); };
  };
  const std::vector<std::string> wrong = { "other-bindings", "lost-press" };
  const Picture pictures[] = { { "VoxelMeans", { "dropped-point" }, buildVoxelMeans },
    { "SphereContact", { "shifted-proxy" }, buildSphereContact },
    { "DensityProxies", { "wrong-color", "equal-radii" }, buildDensityProxies },
    { "IdolRadius", { "wrong-color" }, buildIdolRadius }, { "Splats", { "equal-sizes" }, buildSplats },
    { "CoarseSplats", { "equal-sizes", "all-points" }, buildCoarseSplats },
    { "Residuals", { "not-a-number-as-zero", "larger" }, buildResiduals },
    { "AmbientLight", { "no-light", "sky-below", "wrong-normals" }, buildAmbientLight },
    { "FirstGlance", { "no-tilt", "no-light", "no-depth", "no-brackets" }, buildFirstGlance },
    { "SmoothGlance", { "not-blended" }, buildSmoothGlance },
    { "CoarseAmbientLight", { "no-light" }, buildCoarseAmbientLight },
    { "HelpOverlay", { "missing-line" }, buildHelpOverlay },
    { "StatusOverlay", { "wrong-number" }, buildStatusOverlay },
    { "Sliders", { "wrong-value" }, buildSliders }, { "Chart", { "wrong-force" }, buildChart },
    { "IdealChart", { "wrong-ideal" }, buildIdealChart },
    { "ForceGauge", { "wrong-force" }, buildForceGauge },
    { "Marks", { "no-outline", "no-ring", "usual-colors" }, buildMarks },
    { "PickMarker", { "wrong-bandwidth", "wrong-voxel" }, buildPickMarker },
    { "HelpFits", { "large-font" }, buildHelpFits }, { "ErrorOverlay", { "no-message" }, buildErrorOverlay },
    { "Figure", { "colored", "hand-shown" }, buildFigure },
    { "ComponentColors", { "other-component", "magnitude" }, buildComponentColors },
    { "ScalarBar", { "wrong-range", "at-the-edge" }, buildScalarBar },
    { "ClassLegend", { "other-class", "names-outside" }, buildClassLegend },
    { "CloudAxes", { "hidden", "no-turn", "wrong-unit" }, buildCloudAxes },
    { "Progress", { "wrong-part" }, buildProgress }, { "CoarseLevel", { "unfair-order" }, buildCoarseLevel },
    { "MiddleLevel", { "unfair-order" }, buildMiddleLevel },
    { "ModelInteraction", wrong, interaction("ModelInteraction") },
    { "CameraInteraction", wrong, interaction("CameraInteraction") },
    { "HandInteraction", wrong, interaction("HandInteraction") },
    { "OverlayInteraction", wrong, interaction("OverlayInteraction") } };
  for (const Picture& picture : pictures)
  {
    const bool known = mutation.empty() ||
      std::find(picture.faults.begin(), picture.faults.end(), mutation) != picture.faults.end();
    if (name == picture.name && known)
    {
      picture.build(mutation, renderer);
      return true;
    }
  }
  return false;
}

} // namespace testing
} // namespace pointhaptics
