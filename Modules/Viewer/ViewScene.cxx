#include "ViewScene.h"

#include "ResampledCloud.h"
#include "ScaleNote.h"

#include "CloudAppearance.h"
#include "HapticSceneBuilder.h"
#include "PolyDataAccess.h"
#include "ScreenMarks.h"
#include "ScreenScale.h"
#include "SteadyTime.h"
#include "StereoPicture.h"
#include "SurfaceArrays.h"
#include "vtkCloudAxes.h"
#include "vtkDepthShadingPass.h"
#include "vtkHapticProps.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Boxes.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkLookupTable.h>
#include <vtkMatrix4x4.h>
#include <vtkMatrixToLinearTransform.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace pointhaptics
{
namespace
{

/// The proxy sphere is drawn at least this large, over the workspace's edge.
constexpr double kSmallestSphere = 0.022;
/// Opacity of the plates behind texts that lie over points.
constexpr double kPlateOpacity = 0.6;
/// Points of a cloud that is not measured yet from which on its picture gets no finer.
constexpr std::int64_t kMostPlain = 50000;

} // namespace

ViewScene::ViewScene()
{
  bandwidth_->SetInputConnection(resampler_->GetOutputPort());
  mapper_->SetInputDataObject(bandwidth_->GetOutput()); // a connection would make the filters run
  actor_->SetMapper(mapper_);
  actor_->PickableOff();
  actor_->VisibilityOff();
  actor_->ForceOpaqueOn();
  renderer_->AddActor(actor_);
  pointsActor_->SetMapper(pointsMapper_);
  pointsActor_->PickableOff();
  pointsActor_->SetUserMatrix(pointsMatrix_);
  pointsActor_->ForceOpaqueOn();
  pointsActor_->GetProperty()->LightingOff();
  renderer_->AddActor(pointsActor_);
  renderer_->AddActor(brackets_);
  props_->AddTo(renderer_);
  props_->SetOutlineVisibility(true);
  axes_->AddTo(renderer_);
  clipMark_.addTo(renderer_);
  distance_.addTo(renderer_);
  applyGround(renderer_);
  applyDepthShading(renderer_);
  sizing_.follow(renderer_, vtkCommand::StartEvent, 1.0F); // before what is placed for each eye
  counting_.follow(resampler_);
  setUpScalarBar(scalarBar_);
  scalarBar_->SetLookupTable(mapper_->GetLookupTable());
  scalarBar_->VisibilityOff();
  renderer_->AddActor2D(scalarBar_);
}

ViewScene::~ViewScene() = default;

/// Chooses before every render how many points it shows, and leaves room for the scalar bar.
void ViewScene::beginFrame()
{
  applyTextScale(renderer_->GetRenderWindow(), this->textScale());
  tellStereo(renderer_);
  if (scalarBar_->GetVisibility() && !barBox_)
  {
    placeScalarBar(scalarBar_, renderer_);
  }
  if (shown_)
  {
    // Gaps between the lines of a sweep stay open when the camera comes nearer: sizes stay as in the first
    // view. Surfaces close.
    const bool isSweep = shown_->look.kind == CloudKind::Sweep || shown_->look.kind == CloudKind::Indoors;
    pointsMapper_->Settings().surfacePixels =
      isSweep ? pointsMapper_->Settings().largestPixels * placedDistance_ / this->viewDistance() : INFINITY;
  }
  this->detail().beginFrame(steadySeconds());
  if (vtkDepthShadingPass* shading = vtkDepthShadingPass::GetPassOf(renderer_))
  {
    shading->SetIsMoving(this->detail().isInMotion());
    shading->SetMovingFragments(this->detail().fragments());
    shading->SetBlendsSplats(this->detail().isFinest());
  }
}

/// A picture that is soon replaced stays coarse.
bool ViewScene::refinementDue()
{
  return !(loaded_.measurement && this->detail().drawnPoints() > kMostPlain) &&
    this->detail().refinementDue(steadySeconds());
}

vtkIdType ViewScene::numberOfPoints() const
{
  return loaded_.cloud ? loaded_.cloud->GetNumberOfPoints() : 0;
}

std::array<double, 6> ViewScene::workspaceBounds() const
{
  return { loaded_.workspace.minimum.x, loaded_.workspace.maximum.x, loaded_.workspace.minimum.y,
    loaded_.workspace.maximum.y, loaded_.workspace.minimum.z, loaded_.workspace.maximum.z };
}

double ViewScene::voxelSize() const
{
  Vec3 edges;
  fieldValues(bandwidth_->GetOutput(), "LatticeSpacing", 3, &edges.x);
  return std::cbrt(edges.x * edges.y * edges.z);
}

bool ViewScene::open(LoadedCloud loaded, const HapticViewerOptions& options, std::string& message)
{
  const bool isEmpty = loaded.isResampled && loaded.means->GetNumberOfPoints() == 0;
  const ColorRange before = this->colorRange();
  loaded_ = std::move(loaded);
  shown_ = std::move(loaded_.shown);
  cloudBounds_ = {};
  colorBy_ = loaded_.colorBy;
  mapsHeights_ = false;
  ownColor_ = colorBy_ != "rgb" && findColorSource(loaded_.cloud, colorBy_) ? colorBy_ : std::string();
  picture_ = options.picture;
  picture_.hidden = loaded_.showing.hidden; // as the arrays are written
  this->setClip(options.clip);
  memoryDue_ = steadySeconds() + kMemorySeconds;
  placedCamera_.clear();
  resamplings_ += loaded_.resamplings;
  setElements(modelMatrix_, loaded_.placement);
  this->chooseUnit(options);
  this->configure(options);
  this->showMeans(options);
  if (loaded_.showing.colors)
  {
    this->keepColorRange(before);
  }
  if (isEmpty)
  {
    message = "no point of the cloud lies in the workspace; leave out " + options.names.placement +
      " to fit the cloud to it";
    return false;
  }
  return true;
}

void ViewScene::chooseUnit(const HapticViewerOptions& options)
{
  const LengthUnit chosen{ options.unit, options.metresPerUnit, UnitEvidence::None };
  LengthUnit likely = options.unitIsChosen ? chosen : lengthUnitOf(loaded_.cloud, loaded_.bounds);
  const bool isSaid = likely.evidence == UnitEvidence::File;
  this->setUnit(isSaid ? likely : chosen);
  likelyUnit_ = likely.name == unit_.name ? LengthUnit{ "", 1.0, UnitEvidence::None } : likely;
}

std::string ViewScene::scaleNote() const
{
  return describeScale(modelMatrix_, unit_.name, unit_.metres);
}

void ViewScene::setUnit(const LengthUnit& unit)
{
  unit_ = unit;
  axes_->SetUnitName(unit.name);
  this->applyMarks();
  if (shown_)
  {
    this->applyLook();
  }
}

/// Sets the filters as those that made the means, for means after a change.
void ViewScene::configure(const HapticViewerOptions& options)
{
  const vtkSmartPointer<vtkPolyData> felt = std::exchange(loaded_.felt, nullptr);
  resampler_->SetInputData(felt ? felt : loaded_.cloud);
  configureFilters(options, loaded_, resampler_, bandwidth_);
  vtkNew<vtkMatrix4x4> model;
  setElements(model, loaded_.model);
  vtkNew<vtkMatrixToLinearTransform> linear;
  linear->SetInput(model);
  resampler_->SetTransform(linear);
}

void ViewScene::showMeans(const HapticViewerOptions& options)
{
  // The output looks as if the filters had run, which they shall not.
  bandwidth_->GetOutput()->ShallowCopy(loaded_.means);
  loaded_.means = nullptr;
  mapper_->Settings().sizeArray = "MeanBandwidth";
  this->drawPoints();
  const std::array<double, 6> bounds = this->workspaceBounds();
  resampler_->SetWorkspaceBounds(bounds.data()); // it stays, whatever the user does to the model
  props_->SetWorkspaceBounds(bounds.data());
  brackets_->SetBox(bounds.data());
  feltDetail_.setWorkspace(loaded_.workspace);
  const Vec3 extent = loaded_.workspace.extent();
  const double edge = std::max({ extent.x, extent.y, extent.z });
  props_->SetSmallestSphereRadius(kSmallestSphere * edge);
  const Vec3 up = normalized(loaded_.placement.applyToVector(loaded_.orientation.up));
  mapper_->Settings().sky = pointsMapper_->Settings().sky = { up.x, up.y, up.z };
  fixedPixels_ = options.pointSize;
  this->applyPicture();
  showsFelt_ = showsFelt_ || options.felt;
  vtkNew<vtkMatrix4x4> model;
  setElements(model, loaded_.model);
  this->placeModel(model);
  this->applyColors();
}

void ViewScene::chooseArrays()
{
  bandwidth_->SetComputeDensity(colorBy_ == "Density");
  bandwidth_->SetComputeProxyRadius(colorBy_ == "ProxyRadius");
  vtkPolyData* averaged = loaded_.cloud;
  if (showsFelt_ && colorBy_ == kHeightArrayName && !averaged->GetPointData()->HasArray(kHeightArrayName))
  {
    addHeightArray(averaged, loaded_.orientation.up);
  }
}

/// Colours points and means by the chosen array, or by the default where they lack it.
void ViewScene::applyColors()
{
  // The colours of heights by default have no map: one that is asked for colours the array of heights.
  const bool hasMap = picture_.colorMap != "auto";
  if (colorBy_.empty() && hasMap && shown_->colors.rule == ColorRule::Height && !hasColors(loaded_.cloud))
  {
    colorBy_ = kHeightArrayName;
    mapsHeights_ = true;
  }
  else if (mapsHeights_ && !hasMap)
  {
    colorBy_.clear();
    mapsHeights_ = false;
  }
  vtkPolyData* output = bandwidth_->GetOutput();
  applyCloudAppearance(output, mapper_, actor_, colorBy_);
  actor_->GetProperty()->SetColor(kClayColor[0], kClayColor[1], kClayColor[2]);
  mapper_->SetScalarVisibility(colorBy_ == kClayName ? false : mapper_->GetScalarVisibility());
  applyColorMap(mapper_, picture_.colorMap, picture_.colorRange);
  this->chooseDrawn();
  this->colorPoints();
  const bool isThere = colorBy_.empty() || colorBy_ == kClayName ||
    (drawsFelt_ ? findColorSource(output, colorBy_).has_value()
                : (colorBy_ == "rgb" && hasColors(shown_->points)) ||
          findColorSource(shown_->points, colorBy_).has_value());
  coloredBy_ = isThere ? colorBy_ : std::string();
  this->applyLook();
}

ShownRequest ViewScene::showing() const
{
  ShownRequest request;
  request.orientation = loaded_.orientation;
  request.kind = shown_->look.kind;
  request.colors = shown_->colors;
  request.hidden = picture_.hidden;
  return request;
}

ViewScene::ColorRange ViewScene::colorRange()
{
  ColorRange range{ coloredBy_, {}, {} };
  std::copy_n(mapper_->GetLookupTable()->GetRange(), 2, range.ofMeans);
  std::copy_n(pointsMapper_->GetLookupTable()->GetRange(), 2, range.ofPoints);
  return range;
}

/// Keeps the colours of places and values, where more points would widen the range.
void ViewScene::keepColorRange(const ColorRange& before)
{
  if (before.coloredBy == coloredBy_ && picture_.colorRange.empty())
  {
    mapper_->GetLookupTable()->SetRange(before.ofMeans[0], before.ofMeans[1]);
    pointsMapper_->GetLookupTable()->SetRange(before.ofPoints[0], before.ofPoints[1]);
  }
}

std::vector<std::string> ViewScene::colorChoices() const
{
  std::vector<std::string> names; // the default choice first, where it has a name
  const auto add = [&names](const std::string& name)
  {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
    {
      names.push_back(name);
    }
  };
  const ColorRule rule = shown_->colors.rule;
  add(rule == ColorRule::Rgb ? "rgb" : "");
  add(rule == ColorRule::Classes && !showsFelt_ ? shown_->colors.array : "");
  add(rule == ColorRule::Clay ? kClayName : "");
  add(kHeightArrayName);
  add(hasColors(shown_->points) ? "rgb" : "");
  for (const char* name : { "classification", "intensity", "returnnumber" })
  {
    // Arrays that were added for drawing are never averaged: with the means only the file's are offered.
    vtkDataArray* array = findArrayAnyCase(showsFelt_ ? loaded_.cloud : shown_->points, name);
    add(array ? array->GetName() : "");
  }
  add(shown_->points->GetPointData()->HasArray(kFileArrayName) ? kFileArrayName : "");
  add(ownColor_);
  for (const char* name : { kClayName, "Density", "ProxyRadius", kResidualArrayName })
  {
    add(name);
  }
  return names;
}

bool ViewScene::setColorBy(const std::string& name)
{
  colorBy_ = name;
  mapsHeights_ = false;
  this->chooseArrays();
  this->applyColors();
  return this->awaitsColors();
}

void ViewScene::showAmbient(bool ambient)
{
  ambient_ = ambient;
  mapper_->Settings().ambientLight = ambient;
  if (shown_)
  {
    this->colorPoints();
  }
  this->detail().recolor();
}

bool ViewScene::wantsResiduals() const
{
  return colorBy_ == kResidualArrayName && !loaded_.cloud->GetPointData()->HasArray(kResidualArrayName);
}

void ViewScene::completeMeans(bool useCovariance)
{
  vtkPolyData* output = bandwidth_->GetOutput();
  vtkPointData* data = output->GetPointData();
  const bool residuals = loaded_.isResampled && this->wantsResiduals() && !data->HasArray(kResidualArrayName);
  const bool normals = loaded_.isResampled && ambient_ && !data->HasArray(kSurfaceNormalArrayName);
  Status status = Status::Ok;
  if (const auto scene = residuals || normals ? this->makeScene(useCovariance, status) : nullptr)
  {
    addSurfaceArrays(output, *scene, residuals, normals);
    this->meansChanged();
  }
}

void ViewScene::meansChanged()
{
  loaded_.scene.reset();
  if (!std::exchange(loaded_.isResampled, true) && drawsFelt_)
  {
    this->applyColors();
  }
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
  if (colors && picture_.colorRange.empty() &&
    !loaded_.cloud->GetPointData()->HasArray(source->array.c_str()))
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
  this->applyMarks();
  if (shown_)
  {
    this->applyColors();
  }
}

/// Sets the colours of cloud and background, and shows or hides what stands beside the cloud.
void ViewScene::applyLook()
{
  vtkPolyData* drawn = drawsFelt_ ? bandwidth_->GetOutput() : shown_->points.Get();
  const std::string ground = groundOf(picture_);
  applyGround(renderer_, ground);
  scalarBar_->SetLookupTable(this->drawnMapper()->GetLookupTable());
  const std::optional<ColorSource> source = findColorSource(drawn, colorBy_);
  if (source && holdsLabels(source->array))
  {
    const auto legend = vtkSmartPointer<vtkLookupTable>::Take(
      newClassLegend(drawn->GetPointData()->GetArray(source->array.c_str()),
        source->array == kFileArrayName ? this->fileNames() : std::vector<std::string>()));
    this->markHidden(legend, source->array);
    scalarBar_->SetLookupTable(legend);
  }
  const std::string name = source ? describeColorSource(drawn, *source) : std::string();
  const bool isLength = this->wantsResiduals() || (source && source->array == kHeightArrayName);
  const bool isDensity = source && source->array == "Density";
  const std::string unit = isLength ? " (" + unit_.name + ")"
    : isDensity                     ? " (1/" + (drawsFelt_ ? "m" : unit_.name) + "\u00b2)"
                                    : "";
  scalarBar_->SetTitle((name + unit + "\n").c_str());
  wantsScalarBar_ = !figure_ && source.has_value();
  scalarBar_->SetVisibility(wantsScalarBar_ && !(barBox_ && barBox_->empty()));
  const Vec3 ink = inkOn(ground);
  for (vtkTextProperty* text : { scalarBar_->GetTitleTextProperty(), scalarBar_->GetLabelTextProperty(),
         scalarBar_->GetAnnotationTextProperty() })
  {
    text->SetColor(ink.x, ink.y, ink.z);
    // Points of any colour may lie behind.
    const double plate = isLightGround(ground) ? 1.0 : 0.0;
    text->SetBackgroundColor(plate, plate, plate);
    text->SetBackgroundOpacity(picture_.isHighContrast() ? 1.0 : kPlateOpacity);
  }
  if (figure_)
  {
    applyFigureAppearance(mapper_, actor_, renderer_);
    applyFigureAppearance(pointsMapper_, pointsActor_, renderer_);
  }
  const Vec3 edges = isLightGround(ground) ? Vec3{ 0.25, 0.27, 0.32 } : Vec3{ 0.80, 0.82, 0.86 };
  brackets_->GetProperty()->SetColor(edges.x, edges.y, edges.z);
  brackets_->SetVisibility(!figure_);
  props_->GetWorkspaceActor()->SetVisibility(figure_);
  axes_->SetVisibility(wantsAxes_ && !figure_);
  props_->SetHandVisibility(!figure_);
  this->detail().recolor();
}

/// Ends the box where the workspace does: people look at the part of a monument that is in reach.
void ViewScene::placeAxes(vtkMatrix4x4* model)
{
  if (!axes_->GetVisibility() || !loaded_.cloud)
  {
    return;
  }
  const Bounds& cloud = this->cloudBounds();
  vtkNew<vtkMatrix4x4> toCloud;
  vtkMatrix4x4::Invert(model, toCloud);
  const Bounds reach =
    boxOfCorners(loaded_.workspace, [&toCloud](const Vec3& corner) { return transformed(toCloud, corner); });
  double bounds[6];
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = std::max(cloud.minimum[axis], reach.minimum[axis]);
    bounds[2 * axis + 1] = std::max(bounds[2 * axis], std::min(cloud.maximum[axis], reach.maximum[axis]));
  }
  axes_->SetBounds(bounds);
  axes_->SetModelMatrix(model);
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
    this->applyProjection();
    renderer_->ResetCameraClippingRange();
  }
}

std::shared_ptr<const HapticScene> ViewScene::makeScene(bool useCovariance, Status& status)
{
  status = Status::Ok;
  return loaded_.scene ? loaded_.scene
                       : makeHapticScene(bandwidth_->GetOutput(), status, useCovariance,
                           bandwidth_->GetSettings(), &resampler_->GetSettings());
}

} // namespace pointhaptics
