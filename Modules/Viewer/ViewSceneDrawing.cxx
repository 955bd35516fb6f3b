// Draws a scene: points or means, where the model is, and the camera.
#include "ViewScene.h"

#include "CloudAppearance.h"
#include "CloudParts.h"
#include "PolyDataAccess.h"
#include "SteadyTime.h"
#include "SurfaceArrays.h"
#include "vtkKernelBandwidthFilter.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkMatrix4x4.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace pointhaptics
{
namespace
{

/// Depth differences up to this multiple of the median bandwidth count as one surface where means are drawn.
constexpr double kStepsOfMeans = 1.1;
/// A model that was enlarged by more than this factor is shown within the workspace only.
constexpr double kShownWhole = 1.05;

std::vector<double> pictureCamera(vtkCamera* camera)
{
  const double* view = camera->GetViewTransformMatrix()->GetData();
  std::vector<double> numbers(view, view + 16);
  numbers.push_back(camera->GetViewAngle());
  numbers.push_back(camera->GetParallelScale());
  return numbers;
}

double scaleOf(vtkMatrix4x4* matrix)
{
  return std::cbrt(std::abs(matrix->Determinant()));
}

/// A contact counts as seen from this cosine on, between the surface normal and the direction to the camera.
constexpr double kFacingEnough = 0.25;

} // namespace

/// Shows points or means, with what belongs to them.
void ViewScene::chooseDrawn()
{
  const bool drawsFelt =
    showsFelt_ || (isOfMeans(colorBy_) && !shown_->points->GetPointData()->HasArray(colorBy_.c_str()));
  if (drawsFelt != drawsFelt_)
  {
    const bool isEnabled = this->detail().isEnabled();
    this->detail().setEnabled(false);
    drawsFelt_ = drawsFelt;
    this->detail().setEnabled(isEnabled);
  }
  this->applyNoise();
  actor_->SetVisibility(drawsFelt_);
  pointsActor_->SetVisibility(!drawsFelt_);
}

bool ViewScene::setShowsFelt(bool felt)
{
  showsFelt_ = felt;
  if (shown_)
  {
    this->chooseArrays();
    this->applyColors();
  }
  return shown_ && this->awaitsColors();
}

void ViewScene::colorPoints()
{
  vtkPolyData* points = shown_->points;
  vtkPointData* data = points->GetPointData();
  const CloudColors& colors = shown_->colors;
  double light = 1.0;
  if (colorBy_ == kHeightArrayName && !data->HasArray(kHeightArrayName))
  {
    addHeightArray(points, loaded_.orientation.up);
  }
  if (colorBy_ == "Density" && !data->HasArray("Density"))
  {
    addDensity(points);
  }
  const bool isAutomatic = colorBy_.empty() || isOfMeans(colorBy_);
  if (isAutomatic && data->HasArray(kLookColorName))
  {
    pointsMapper_->SetScalarModeToUsePointFieldData();
    pointsMapper_->SelectColorArray(kLookColorName);
    pointsMapper_->SetColorModeToDirectScalars();
    pointsMapper_->ScalarVisibilityOn();
    light = colors.lightStrength;
  }
  else if (colorBy_ == kClayName || (isAutomatic && colors.rule == ColorRule::Clay))
  {
    pointsMapper_->ScalarVisibilityOff();
  }
  else
  {
    const std::string name = isAutomatic ? std::string("rgb") : colorBy_;
    applyCloudAppearance(points, pointsMapper_, pointsActor_, name);
    applyColorMap(pointsMapper_, picture_.colorMap, picture_.colorRange);
    light = name == "rgb" ? colors.lightStrength : 1.0;
  }
  pointsMapper_->Settings().lightStrength = ambient_ ? 1.0 : light;
  pointsActor_->GetProperty()->SetColor(kClayColor[0], kClayColor[1], kClayColor[2]);
}

void ViewScene::drawPoints()
{
  this->applyHidden();
  drawShown(*shown_, pointsMapper_);
  detail_.setOrder(shown_->order);
  this->applyPointSizes();
}

Vec3 ViewScene::towardsViewer() const
{
  return normalized(loaded_.placement.applyToVector(shown_->look.front));
}

/// Returns freed memory of reading, measuring and drawing to the system, about 200 bytes a point, once these
/// are over.
void ViewScene::returnMemory()
{
  if (steadySeconds() >= memoryDue_ && !loaded_.measurement)
  {
    memoryDue_ = INFINITY;
#ifdef __GLIBC__
    malloc_trim(0);
#endif
  }
}

bool ViewScene::followMeasurement(bool waits)
{
  this->returnMemory();
  if (!loaded_.measurement || !loaded_.measurement->isReady(waits))
  {
    return false;
  }
  const std::shared_ptr<ShownCloud> measured = loaded_.measurement->take();
  loaded_.measurement.reset();
  if (!measured)
  {
    return false;
  }
  memoryDue_ = steadySeconds() + kMemorySeconds;
  measured->order = shown_->order; // of the same points
  shown_ = measured;
  const bool isPlaced = placedCamera_ == pictureCamera(renderer_->GetActiveCamera());
  this->drawPoints();
  this->applyColors();
  if (isPlaced)
  {
    this->placeCamera();
  }
  return true;
}

/// Sets the noise of the shading. Discs of means face the viewer, so they form steps on steep surfaces.
void ViewScene::applyNoise()
{
  vtkDataArray* bandwidths = bandwidth_->GetOutput()->GetPointData()->GetArray("MeanBandwidth");
  const double noise = !drawsFelt_ ? scaleOf(pointsMatrix_) * shown_->look.noiseLength
    : bandwidths                   ? kStepsOfMeans * quantileOfPositive(bandwidths, 5)
                                   : 0.0;
  applyDepthShading(renderer_, noise, shown_->look.noisePerDistance);
}

/// Places the model. It may leave the workspace where it is rotated; enlarged, it would stand in front of it.
void ViewScene::placeModel(vtkMatrix4x4* model)
{
  pointsMatrix_->DeepCopy(model);
  pointsMatrix_->Modified();
  distance_.setModel(model);
  clipMark_.setModel(model);
  if (!shown_)
  {
    return;
  }
  const double scale = scaleOf(model);
  this->applyNoise();
  const bool isWhole = scale <= kShownWhole * scaleOf(modelMatrix_);
  if (isWhole != (pointsMapper_->GetNumberOfClippingPlanes() == 0))
  {
    pointsMapper_->RemoveAllClippingPlanes();
    for (int side = 0; side < 6 && !isWhole; ++side)
    {
      vtkNew<vtkPlane> plane;
      double normal[3] = { 0.0, 0.0, 0.0 };
      normal[side / 2] = side % 2 == 0 ? 1.0 : -1.0;
      const Vec3& corner = side % 2 == 0 ? loaded_.workspace.minimum : loaded_.workspace.maximum;
      plane->SetOrigin(corner.x, corner.y, corner.z);
      plane->SetNormal(normal);
      pointsMapper_->AddClippingPlane(plane);
    }
    detail_.setWorkspace(isWhole ? Bounds() : loaded_.workspace);
  }
}

void ViewScene::placeCamera(const ProxyState* contact)
{
  if (!shown_)
  {
    return;
  }
  const bool turns = contact && contact->contact && shown_->look.kind != CloudKind::Frame;
  // The contact must be on the visible side: take the smallest turn that shows it, or else the one that faces
  // it most.
  CameraFit best = this->fitFrom(shown_->look);
  double facing = -2.0;
  for (double turn : { 0.0, -60.0, 60.0, 120.0, -120.0, 180.0 })
  {
    if (!turns || facing > kFacingEnough)
    {
      break;
    }
    const CameraFit fit = this->fitFrom(shown_->look, turn);
    const double cosine = dot(contact->normal, normalized(fit.position - fit.focalPoint));
    best = cosine > facing ? fit : best;
    facing = std::max(facing, cosine);
  }
  this->placeCamera(best);
  placedCamera_ = pictureCamera(renderer_->GetActiveCamera());
  placedDistance_ = this->viewDistance();
}

} // namespace pointhaptics
