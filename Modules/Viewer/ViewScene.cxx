#include "ViewScene.h"

#include "ResampledCloud.h"
#include "ScaleNote.h"

#include "CloudAppearance.h"
#include "HapticSceneBuilder.h"
#include "SurfaceArrays.h"
#include "vtkCloudAxes.h"
#include "vtkHapticProps.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Lattice.h"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkLookupTable.h>
#include <vtkMatrix4x4.h>
#include <vtkMatrixToLinearTransform.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkVariant.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Scales for applyDepthShading() in edges of the workspace; photographed colours show the shape themselves.
constexpr double kDepthShadingScale = 0.03;
constexpr double kDepthShadingScaleOfColors = 0.08;
/// Above the noise of a depth camera in a room: the splats of a wall cast no shadows on each other.
constexpr double kDepthToleranceOfColors = 0.015;
/// The proxy sphere is drawn at least this large, over the workspace's edge.
constexpr double kSmallestSphere = 0.022;
/// Cosine between the surface normal and the direction to the camera from which on a contact counts as seen.
constexpr double kFacingEnough = 0.25;

} // namespace

ViewScene::ViewScene()
{
  bandwidth_->SetInputConnection(resampler_->GetOutputPort());
  mapper_->SetInputDataObject(bandwidth_->GetOutput()); // a connection would make the filters run
  actor_->SetMapper(mapper_);
  actor_->PickableOff();
  renderer_->AddActor(actor_);
  props_->AddTo(renderer_);
  axes_->AddTo(renderer_);
  applyBackground(renderer_);
  vtkNew<vtkCallbackCommand> sizing;
  sizing->SetClientData(this);
  sizing->SetCallback(
    [](vtkObject*, unsigned long, void* self, void*) { static_cast<ViewScene*>(self)->beginFrame(); });
  renderer_->AddObserver(vtkCommand::StartEvent, sizing);
  vtkNew<vtkCallbackCommand> counting;
  counting->SetClientData(this);
  counting->SetCallback(
    [](vtkObject*, unsigned long, void* self, void*) { ++static_cast<ViewScene*>(self)->resamplings_; });
  resampler_->AddObserver(vtkCommand::StartEvent, counting);
  setUpScalarBar(scalarBar_);
  scalarBar_->SetLookupTable(mapper_->GetLookupTable());
  scalarBar_->VisibilityOff();
  renderer_->AddActor2D(scalarBar_);
}

ViewScene::~ViewScene()
{
  renderer_->RemoveObservers(vtkCommand::StartEvent);
  resampler_->RemoveObservers(vtkCommand::StartEvent);
}

/// Before every render: how many points it shows, and room for the scalar bar.
void ViewScene::beginFrame()
{
  if (scalarBar_->GetVisibility())
  {
    placeScalarBar(scalarBar_, renderer_);
  }
  detail_.beginFrame(
    std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count());
}

vtkIdType ViewScene::numberOfPoints() const
{
  return cloud_ ? cloud_->GetNumberOfPoints() : 0;
}

void ViewScene::getWorkspaceBounds(double bounds[6]) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = workspace_.minimum[axis];
    bounds[2 * axis + 1] = workspace_.maximum[axis];
  }
}

void ViewScene::getVoxel(double edges[3]) const
{
  vtkDataArray* spacing = bandwidth_->GetOutput()->GetFieldData()->GetArray("LatticeSpacing");
  for (int axis = 0; axis < 3; ++axis)
  {
    edges[axis] = spacing ? spacing->GetVariantValue(axis).ToDouble() : 0.0;
  }
}

bool ViewScene::open(
  const std::vector<std::string>& files, const HapticViewerOptions& options, std::string& message)
{
  LoadedCloud loaded;
  return loadCloud(
           CloudRequest::of(files, options), [](double) { return true; }, loaded, message) &&
    this->open(std::move(loaded), options, message);
}

bool ViewScene::open(LoadedCloud loaded, const HapticViewerOptions& options, std::string& message)
{
  cloud_ = loaded.cloud;
  cloudBounds_ = {};
  colorBy_ = loaded.colorBy;
  ownColor_ = colorBy_ != "rgb" && findColorSource(cloud_, colorBy_) ? colorBy_ : std::string();
  unit_ = options.unit;
  cloudUp_ = loaded.orientation.up;
  axes_->SetMetresPerUnit(options.metresPerUnit);
  orientation_ = loaded.orientation;
  orientation_.up = normalized(loaded.placement.applyToVector(orientation_.up));
  orientation_.front = normalized(loaded.placement.applyToVector(orientation_.front));
  title_ = loaded.title;
  scene_ = loaded.scene;
  resamplings_ += loaded.resamplings;
  setElements(modelMatrix_, loaded.placement);
  scaleNote_ = describeScale(modelMatrix_, options.unit, options.metresPerUnit);
  this->configure(loaded, options);
  this->showMeans(loaded, options);
  if (loaded.means->GetNumberOfPoints() == 0)
  {
    message = "no point of the cloud lies in the workspace; leave out " + options.names.placement +
      " to fit the cloud to it";
    return false;
  }
  return true;
}

/// The filters, as those were that made the means: for what is made after a change.
void ViewScene::configure(const LoadedCloud& loaded, const HapticViewerOptions& options)
{
  resampler_->SetInputData(cloud_);
  configureFilters(options, loaded, resampler_, bandwidth_);
  vtkNew<vtkMatrix4x4> model;
  setElements(model, loaded.model);
  vtkNew<vtkMatrixToLinearTransform> linear;
  linear->SetInput(model);
  resampler_->SetTransform(linear);
}

void ViewScene::showMeans(const LoadedCloud& loaded, const HapticViewerOptions& options)
{
  // As if the filters had run, which they shall not.
  bandwidth_->GetOutput()->ShallowCopy(loaded.means);
  mapper_->SetSizeArrayName("MeanBandwidth");
  workspace_ = loaded.workspace;
  double bounds[6];
  getWorkspaceBounds(bounds);
  resampler_->SetWorkspaceBounds(bounds); // it stays, whatever the user does to the model
  props_->SetWorkspaceBounds(bounds);
  detail_.setWorkspace(workspace_);
  const Vec3 extent = workspace_.extent();
  const double edge = std::max({ extent.x, extent.y, extent.z });
  props_->SetForceScale(0.06 * edge);
  props_->SetSmallestSphereRadius(kSmallestSphere * edge);
  mapper_->SetFixedPixels(options.pointSize);
  mapper_->SetSkyDirection(&orientation_.up.x);
  this->applyColors();
}

void ViewScene::chooseArrays()
{
  bandwidth_->SetComputeDensity(colorBy_ == "Density");
  bandwidth_->SetComputeProxyRadius(colorBy_ == "ProxyRadius");
}

/// Colours the means by what is asked for, or as if nothing were where they do not have it.
void ViewScene::applyColors()
{
  vtkPolyData* output = bandwidth_->GetOutput();
  const Vec3 extent = workspace_.extent();
  const bool showsColors = hasColors(output) && (colorBy_.empty() || colorBy_ == "rgb");
  const double edge = std::max({ extent.x, extent.y, extent.z });
  applyDepthShading(renderer_, (showsColors ? kDepthShadingScaleOfColors : kDepthShadingScale) * edge,
    showsColors ? kDepthToleranceOfColors * edge : 0.0);
  applyCloudAppearance(output, mapper_, actor_, colorBy_);
  coloredBy_ = showsColors || findColorSource(output, colorBy_) ? colorBy_ : std::string();
  isColored_ = mapper_->GetScalarVisibility() != 0;
  actor_->GetProperty()->GetColor(plainColor_);
  this->applyLook();
}

std::vector<std::string> ViewScene::colorChoices() const
{
  std::vector<std::string> names;
  if (hasColors(cloud_))
  {
    names.emplace_back("rgb");
  }
  names.emplace_back(kHeightArrayName);
  if (!ownColor_.empty())
  {
    names.push_back(ownColor_);
  }
  for (const char* name : { "Density", "ProxyRadius", kResidualArrayName })
  {
    if (std::find(names.begin(), names.end(), name) == names.end())
    {
      names.emplace_back(name);
    }
  }
  return names;
}

bool ViewScene::setColorBy(const std::string& name)
{
  colorBy_ = name;
  this->chooseArrays();
  vtkPointData* data = cloud_->GetPointData();
  const bool lacksHeight = name == kHeightArrayName && !data->HasArray(kHeightArrayName);
  if (lacksHeight)
  {
    addHeightArray(cloud_, cloudUp_);
  }
  vtkPolyData* output = bandwidth_->GetOutput();
  const bool isThere = name.empty() || (name == "rgb" && hasColors(output)) || findColorSource(output, name);
  if (isThere)
  {
    this->applyColors();
  }
  return !isThere;
}

void ViewScene::showAmbient(bool ambient)
{
  mapper_->SetAmbientLight(ambient);
  detail_.recolor();
}

bool ViewScene::wantsResiduals() const
{
  return colorBy_ == kResidualArrayName && !cloud_->GetPointData()->HasArray(kResidualArrayName);
}

void ViewScene::completeMeans(bool useCovariance)
{
  vtkPolyData* output = bandwidth_->GetOutput();
  vtkPointData* data = output->GetPointData();
  const bool residuals = this->wantsResiduals() && !data->HasArray(kResidualArrayName);
  const bool normals = this->isAmbient() && !data->HasArray(kSurfaceNormalArrayName);
  Status status = Status::Ok;
  if (const auto scene = residuals || normals ? this->makeScene(useCovariance, status) : nullptr)
  {
    addSurfaceArrays(output, *scene, residuals, normals);
    this->meansChanged();
  }
}

void ViewScene::meansChanged()
{
  scene_.reset();
  vtkPolyData* output = bandwidth_->GetOutput();
  const std::optional<ColorSource> source = findColorSource(output, colorBy_);
  if (!source || coloredBy_ != colorBy_)
  {
    if (source)
    {
      this->applyColors();
    }
    return;
  }
  auto* colors = vtkLookupTable::SafeDownCast(mapper_->GetLookupTable());
  if (colors && !cloud_->GetPointData()->HasArray(source->array.c_str()))
  {
    followColorRange(output, *source, colors);
  }
}

void ViewScene::showAxes(bool visible)
{
  wantsAxes_ = visible;
  axes_->SetVisibility(wantsAxes_ && !figure_);
}

void ViewScene::showFigure(bool figure)
{
  figure_ = figure;
  this->applyLook();
}

/// Colours of the cloud and the background, and what stands beside the cloud.
void ViewScene::applyLook()
{
  vtkPolyData* output = bandwidth_->GetOutput();
  mapper_->SetScalarVisibility(isColored_); // the range of the colours stays
  actor_->GetProperty()->SetColor(plainColor_);
  applyBackground(renderer_);
  scalarBar_->SetLookupTable(mapper_->GetLookupTable());
  const std::optional<ColorSource> source = findColorSource(output, colorBy_);
  const std::string name = source ? describeColorSource(output, *source) : std::string();
  scalarBar_->SetTitle((name + (this->wantsResiduals() ? " (" + unit_ + ")\n" : "\n")).c_str());
  scalarBar_->SetVisibility(!figure_ && source.has_value());
  if (figure_)
  {
    applyFigureAppearance(mapper_, actor_, renderer_);
  }
  axes_->SetVisibility(wantsAxes_ && !figure_);
  props_->SetHandVisibility(!figure_);
  detail_.recolor();
}

/// The box ends where the workspace does: of a monument the part in reach is what is looked at.
void ViewScene::placeAxes(vtkMatrix4x4* model)
{
  if (!axes_->GetVisibility() || !cloud_)
  {
    return;
  }
  if (cloudBounds_.empty())
  {
    cloudBounds_ = transformedBounds(cloud_, AffineTransform());
  }
  vtkNew<vtkMatrix4x4> toCloud;
  vtkMatrix4x4::Invert(model, toCloud);
  Bounds reach;
  for (int corner = 0; corner < 8; ++corner)
  {
    const double in[4] = { corner & 1 ? workspace_.maximum.x : workspace_.minimum.x,
      corner & 2 ? workspace_.maximum.y : workspace_.minimum.y,
      corner & 4 ? workspace_.maximum.z : workspace_.minimum.z, 1.0 };
    double out[4];
    toCloud->MultiplyPoint(in, out);
    reach.include({ out[0], out[1], out[2] });
  }
  double bounds[6];
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = std::max(cloudBounds_.minimum[axis], reach.minimum[axis]);
    bounds[2 * axis + 1] =
      std::max(bounds[2 * axis], std::min(cloudBounds_.maximum[axis], reach.maximum[axis]));
  }
  axes_->SetBounds(bounds);
  axes_->SetModelMatrix(model);
}

void ViewScene::placeCamera(const ProxyState* contact)
{
  Vec3 center;
  double edge = 0.0;
  framingCube(bandwidth_->GetOutput(), workspace_, center, edge);
  const double aside = orientation_.fromSensor ? 16.0 : 28.0;
  const double above = orientation_.fromSensor ? 12.0 : 18.0;
  vtkCamera* camera = renderer_->GetActiveCamera();
  // A contact is wanted on the side we see: the smallest turn that shows it, or else the one that faces it
  // most.
  double best = -2.0;
  double azimuth = aside;
  for (double turn : { 0.0, -60.0, 60.0, 120.0, -120.0, 180.0 })
  {
    pointhaptics::placeCamera(camera, orientation_, center, edge, aside + turn, above);
    Vec3 forward;
    camera->GetDirectionOfProjection(&forward.x);
    const double facing = contact && contact->contact ? -dot(contact->normal, forward) : 1.0;
    if (facing > best)
    {
      best = facing;
      azimuth = aside + turn;
    }
    if (best > kFacingEnough)
    {
      break;
    }
  }
  pointhaptics::placeCamera(camera, orientation_, center, edge, azimuth, above);
  renderer_->ResetCameraClippingRange();
}

void ViewScene::setCamera(const std::vector<double>& camera)
{
  if (camera.size() == 9)
  {
    vtkCamera* active = renderer_->GetActiveCamera();
    active->SetPosition(&camera[0]);
    active->SetFocalPoint(&camera[3]);
    active->SetViewUp(&camera[6]);
    active->OrthogonalizeViewUp();
    renderer_->ResetCameraClippingRange();
  }
}

std::shared_ptr<const HapticScene> ViewScene::makeScene(bool useCovariance, Status& status)
{
  status = Status::Ok;
  return scene_ ? scene_
                : makeHapticScene(bandwidth_->GetOutput(), status, useCovariance, bandwidth_->GetSettings());
}

bool writePicture(vtkRenderWindow* window, const std::string& fileName, std::string& message)
{
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  grabber->ReadFrontBufferOff();
  grabber->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grabber->GetOutputPort());
  writer->SetFileName(fileName.c_str());
  vtkNew<vtkCallbackCommand> silence; // the message says it
  silence->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  writer->AddObserver(vtkCommand::ErrorEvent, silence);
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    message = fmt::format("{}: cannot be written; check that its folder exists and can be written", fileName);
    return false;
  }
  return true;
}

} // namespace pointhaptics
