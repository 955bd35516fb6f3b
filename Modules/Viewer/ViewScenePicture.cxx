// Drawing and camera of the scene, as PictureSettings and the person say.
#include "ViewScene.h"

#include "CloudAppearance.h"
#include "PolyDataAccess.h"
#include "ScreenMarks.h"
#include "SplatLook.h"
#include "StereoPicture.h"
#include "vtkCloudAxes.h"
#include "vtkHapticGauge.h"
#include "vtkHapticProps.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkScalarsToColors.h>
#include <vtkTransform.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace
{

/// Factor on the size of texts in the theme high-contrast.
constexpr double kLargerText = 1.25;
constexpr double kDegree = 3.14159265358979323846 / 180.0;
/// Pixel sizes of vtkSplatMapper at a scale of 1.
constexpr double kSmallestPixels = 2.0;
constexpr double kPointPixels = 4.0;
/// Smallest size of a handful of points, pixels: smaller ones would not be seen.
constexpr double kLargestSmallest = 6.0;
/// Size of points at fewer than kFewPlaces places, pixels: they have no spacing.
constexpr double kLonePixels = 8.0;
constexpr std::size_t kFewPlaces = 8;
/// Clouds of more points have the smallest points.
constexpr double kManyPoints = 2000.0;
constexpr double kFeltScale = 3.6;
constexpr double kFeltLargest = 64.0;
/// From straight above, the camera's own up vector decides how the view is turned.
constexpr double kSteepest = 0.999;
constexpr double kHighestLook = 85.0; ///< Degrees above and below the horizon while walking.
/// Typographic points in an inch: at 72 dots per inch a point of a font is a pixel.
constexpr double kPointsPerInch = 72.0;

/// Least diameter of the points in a file of @p count points, pixels.
double smallestPixels(vtkIdType count)
{
  const double wanted = kSmallestPixels * std::sqrt(kManyPoints / std::max<double>(1.0, double(count)));
  return std::clamp(wanted, kSmallestPixels, kLargestSmallest);
}

/// True if all points are at @p most places.
bool hasFewPlaces(const PointView& points, std::size_t most)
{
  std::vector<Vec3> places;
  for (std::int64_t i = 0; i < points.size() && places.size() <= most; ++i)
  {
    if (std::find(places.begin(), places.end(), points[i]) == places.end())
    {
      places.push_back(points[i]);
    }
  }
  return places.size() <= most;
}

/// Corners of @p box after @p toWorld.
std::array<Vec3, 8> cornersBefore(const AffineTransform& toWorld, const Bounds& box)
{
  const AffineTransform toCloud = toWorld.inverse();
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    corners[i] = toCloud.apply({ i & 1 ? box.maximum.x : box.minimum.x, i & 2 ? box.maximum.y : box.minimum.y,
      i & 4 ? box.maximum.z : box.minimum.z });
  }
  return corners;
}

double halfTangent(vtkCamera* camera)
{
  return std::tan(0.5 * camera->GetViewAngle() * kDegree);
}

/// Radius that few discs of a cloud exceed, unit of the file; 0: of so many points that they are small.
double largeRadius(vtkPolyData* points)
{
  constexpr vtkIdType kFew = 10000;
  vtkDataArray* lengths = points->GetPointData()->GetArray(kSplatLengthName);
  const vtkIdType count = lengths && lengths->GetNumberOfTuples() < kFew ? lengths->GetNumberOfTuples() : 0;
  std::vector<double> sizes(static_cast<std::size_t>(count) + 1, 0.0);
  for (vtkIdType i = 0; i < count; ++i)
  {
    sizes[static_cast<std::size_t>(i)] = lengths->GetComponent(i, 0);
  }
  const auto large = sizes.begin() + count * 19 / 20;
  std::nth_element(sizes.begin(), large, sizes.end());
  return 0.5 * *large;
}

} // namespace

std::string groundOf(const PictureSettings& picture)
{
  return !picture.isHighContrast()      ? picture.background
    : isLightGround(picture.background) ? "white"
                                        : "black";
}

Vec3 inkOn(const std::string& ground)
{
  return isLightGround(ground) ? Vec3{ 0.10, 0.10, 0.12 } : Vec3{ 0.88, 0.89, 0.91 };
}

void ViewScene::setPicture(const PictureSettings& picture)
{
  const bool isProjected = picture.parallel == picture_.parallel;
  vtkCamera* camera = renderer_->GetActiveCamera();
  if (!isProjected && !picture.parallel)
  {
    // Objects at the focal point keep their size seen from this distance.
    const CameraView view(camera);
    const Vec3 eye = view.focus - this->viewDistance() * view.forward;
    camera->SetPosition(&eye.x);
  }
  const bool hasOtherColors =
    picture.colorMap != picture_.colorMap || picture.colorRange != picture_.colorRange;
  const bool hidesOthers = picture.hidden != picture_.hidden;
  picture_ = picture;
  if (shown_ && hidesOthers)
  {
    this->applyHidden();
  }
  if (vtkRenderWindow* window = renderer_->GetRenderWindow())
  {
    static_cast<void>(applyStereo(window, picture.stereo)); // isStereo() tells
  }
  if (shown_ && hasOtherColors)
  {
    this->applyColors();
  }
  if (!isProjected)
  {
    this->applyProjection();
  }
  if (shown_)
  {
    this->applyPicture();
    this->applyLook();
  }
}

bool ViewScene::isStereo() const
{
  return renderer_->GetRenderWindow() && renderer_->GetRenderWindow()->GetStereoRender();
}

double ViewScene::viewDistance() const
{
  vtkCamera* camera = renderer_->GetActiveCamera();
  return picture_.parallel ? camera->GetParallelScale() / halfTangent(camera) : camera->GetDistance();
}

/// Makes a parallel picture show what a perspective one shows at the focal point.
void ViewScene::applyProjection()
{
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->SetParallelProjection(picture_.parallel);
  camera->SetParallelScale(camera->GetDistance() * halfTangent(camera));
  renderer_->ResetCameraClippingRange();
}

bool ViewScene::isColoredByMap()
{
  vtkMapper* mapper = this->drawnMapper();
  return wantsScalarBar_ && mapper->GetArrayName() && !holdsLabels(mapper->GetArrayName());
}

std::array<double, 2> ViewScene::shownColorRange()
{
  const double* range = this->drawnMapper()->GetLookupTable()->GetRange();
  return { range[0], range[1] };
}

std::optional<ViewScene::ColorBarPlace> ViewScene::placeOnColorBar(double x, double y)
{
  return scalarBar_->GetVisibility() && this->isColoredByMap() ? this->placeOnBar(x, y, false) : std::nullopt;
}

std::optional<double> ViewScene::labelOnColorBar(double x, double y)
{
  vtkScalarsToColors* legend = scalarBar_->GetLookupTable();
  const bool isList = scalarBar_->GetVisibility() && legend->GetIndexedLookup();
  const std::optional<ColorBarPlace> place = isList ? this->placeOnBar(x, y, true) : std::nullopt;
  const vtkIdType rows = legend->GetNumberOfAnnotatedValues();
  const auto row = vtkIdType(place ? (1.0 - place->along) * double(rows) : 0.0); // the first is at the top
  return place ? std::optional(legend->GetAnnotatedValue(std::min(row, rows - 1)).ToDouble()) : std::nullopt;
}

/// As high as the strip of colours, and as wide or, @p besideStrip, with its words.
std::optional<ViewScene::ColorBarPlace> ViewScene::placeOnBar(double x, double y, bool besideStrip)
{
  std::array<int, 4> strip{}; // where it begins in the viewport, and its size
  scalarBar_->GetScalarBarRect(strip.data(), renderer_);
  const int* corner = renderer_->GetOrigin(); // a chart may lie below
  const double across = x - corner[0];
  const double along = y - corner[1] - strip[1];
  const double left = besideStrip && barBox_ && !barBox_->empty() ? barBox_->left : strip[0];
  const bool isInside = across >= left && across <= strip[0] + strip[2] && along >= 0.0 && along <= strip[3];
  return isInside ? std::optional(ColorBarPlace{ along / strip[3], double(strip[3]) }) : std::nullopt;
}

double ViewScene::textScale() const
{
  return picture_.fontScale * (picture_.isHighContrast() ? kLargerText : 1.0);
}

void ViewScene::applyPicture()
{
  props_->SetHighContrast(picture_.isHighContrast());
  setDepthStrength(renderer_, picture_.depthStrength);
  this->applyPointSizes();
  this->applyMarks();
}

void ViewScene::applyPointSizes()
{
  const double scale = picture_.pointScale;
  SplatSettings& points = pointsMapper_->Settings();
  points.sizeScale = scale;
  const double smallest = smallestPixels(shown_ ? shown_->points->GetNumberOfPoints() : 0);
  points.smallestPixels = smallest * std::min(1.0, scale);
  points.largestPixels = std::max(smallest, scale * (shown_ ? shown_->look.largestPixels : 1.0));
  SplatSettings& felt = mapper_->Settings();
  felt.sizeScale = kFeltScale * scale;
  felt.smallestPixels = kSmallestPixels * std::min(1.0, scale);
  felt.largestPixels = kFeltLargest * std::max(1.0, scale);
  const bool isLone = shown_ && hasFewPlaces(PointAccess(shown_->points->GetPoints()).view(), kFewPlaces);
  const double fixed = fixedPixels_ == 0.0 && isLone ? kLonePixels : fixedPixels_;
  points.pointPixels = felt.pointPixels = std::max(kPointPixels, smallest) * scale;
  points.fixedPixels = felt.fixedPixels = fixed * scale;
}

/// Callbacks by which a ScreenLayout measures and places the scalar bar; the scene outlives their use.
ScreenBlock ViewScene::scalarBarBlock()
{
  ScreenBlock block;
  block.measure = [this](double font, double& width, double& height)
  {
    double size[2];
    measureScalarBar(scalarBar_, font, renderer_->GetRenderWindow()->GetDPI() / kPointsPerInch, size);
    width = size[0];
    height = size[1];
    return wantsScalarBar_;
  };
  block.place = [this](const ScreenRectangle& box, double font)
  {
    barBox_ = box;
    scalarBar_->SetVisibility(wantsScalarBar_ && !box.empty());
    const double edges[4] = { box.left, box.bottom, box.right, box.top };
    if (!box.empty())
    {
      placeScalarBar(
        scalarBar_, renderer_, font, renderer_->GetRenderWindow()->GetDPI() / kPointsPerInch, edges);
    }
  };
  return block;
}

void ViewScene::join(ScreenLayout& layout)
{
  // Size of the corner with the axes' directions, pixels at 72 dots per inch.
  constexpr double kMarker = 112.0;
  barBox_ = ScreenRectangle();
  layout.setScalarBar(this->scalarBarBlock());
  layout.setCorner([this] { return axes_->GetVisibility() ? kMarker : 0.0; });
  layout.setOpaque([this] { return picture_.isHighContrast(); });
  vtkHapticGauge* gauge = props_->GetGauge();
  gauge->SetTaken([&layout] { return layout.boxes(); });
  distance_.setTaken([&layout] { return layout.boxes(); });
  // The gauge is placed first: it moves, and the numbers give way.
  axes_->SetTaken(
    [&layout, gauge]
    {
      std::vector<std::array<double, 4>> boxes = layout.boxes();
      if (gauge->GetVisibility())
      {
        boxes.push_back(gauge->GetPlace());
      }
      return boxes;
    });
}

void ViewScene::leaveLayout()
{
  barBox_.reset();
  scalarBar_->SetVisibility(wantsScalarBar_);
  axes_->SetTaken(nullptr);
  distance_.setTaken(nullptr);
  props_->GetGauge()->SetTaken(nullptr);
}

CameraFit ViewScene::fitFrom(const CloudLook& look, double turn) const
{
  // Points inside the clipping box, or all where it holds none.
  const vtkSmartPointer<vtkPolyData> clipped = clippedCloud(shown_->points, clipBox(clip_, loaded_.cloud));
  const bool isEmpty = clipped->GetNumberOfPoints() == 0;
  const PointAccess access((isEmpty ? shown_->points : clipped)->GetPoints());
  const AffineTransform model = transformOf(pointsMatrix_);
  const double aspect = renderer_->GetTiledAspectRatio();
  if (hasFewPlaces(access.view(), 1))
  {
    // Points at one place have no size that could fill the picture: the workspace does, seen from outside.
    const std::array<Vec3, 8> corners = cornersBefore(model, loaded_.workspace);
    CloudLook outside = look;
    outside.kind = CloudKind::Object;
    return fitCamera(PointView(corners.data(), std::int64_t(corners.size())), outside, model, aspect, turn,
      picture_.parallel);
  }
  CloudLook withDiscs = look;
  withDiscs.discRadius = largeRadius(shown_->points);
  return fitCamera(access.view(), withDiscs, model, aspect, turn, picture_.parallel);
}

void ViewScene::placeCamera(const CameraFit& fit)
{
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->SetViewAngle(fit.viewAngle);
  camera->SetPosition(&fit.position.x);
  camera->SetFocalPoint(&fit.focalPoint.x);
  camera->SetViewUp(&fit.up.x);
  this->applyProjection();
}

/// The look for views along the axes of the file: from outside, also where the first view is that of a
/// sensor.
CloudLook ViewScene::axisLook() const
{
  CloudLook look = shown_->look;
  look.kind = CloudKind::Object;
  look.up = loaded_.orientation.up;
  look.front = loaded_.orientation.front;
  look.azimuth = look.elevation = look.tilt = 0.0;
  return look;
}

void ViewScene::lookFrom(double azimuth, double elevation)
{
  if (shown_)
  {
    CloudLook look = this->axisLook();
    look.azimuth = azimuth;
    look.elevation = elevation;
    this->placeCamera(this->fitFrom(look));
  }
}

void ViewScene::turnView(double degrees)
{
  if (!shown_)
  {
    return;
  }
  Vec3 middle;
  shown_->points->GetCenter(&middle.x);
  if (const std::optional<Bounds> box = clipBox(clip_, loaded_.cloud))
  {
    middle = box->center();
  }
  this->turnCamera(transformOf(pointsMatrix_).apply(middle), degrees, this->upward());
}

/// The up axis of the cloud in the workspace.
Vec3 ViewScene::upward() const
{
  return normalized(transformOf(pointsMatrix_).applyToVector(loaded_.orientation.up));
}

void ViewScene::turnCamera(const Vec3& about, double degrees, const Vec3& axis)
{
  vtkNew<vtkTransform> turn;
  turn->PostMultiply();
  turn->Translate(-about.x, -about.y, -about.z);
  turn->RotateWXYZ(degrees, &axis.x);
  turn->Translate(&about.x);
  renderer_->GetActiveCamera()->ApplyTransform(turn);
  renderer_->ResetCameraClippingRange();
}

void ViewScene::moveCamera(const Vec3& way, const Vec3& wayOfFocus)
{
  vtkCamera* camera = renderer_->GetActiveCamera();
  const CameraView view(camera);
  const Vec3 eye = view.eye + way;
  const Vec3 focus = view.focus + wayOfFocus;
  camera->SetPosition(&eye.x);
  camera->SetFocalPoint(&focus.x);
  renderer_->ResetCameraClippingRange();
}

void ViewScene::centerView(const Vec3& place)
{
  const CameraView view(renderer_->GetActiveCamera());
  const Vec3 way = transformOf(pointsMatrix_).apply(place) - view.focus;
  this->moveCamera(way - dot(way, view.forward) * view.forward, way);
}

void ViewScene::walk(double right, double up, double forward)
{
  const CameraView view(renderer_->GetActiveCamera());
  const Vec3 upward = this->upward();
  const Vec3 aside = normalized(cross(view.forward, view.up));
  const Vec3 along = normalized(view.forward - dot(view.forward, upward) * upward, view.up);
  const Vec3 way = right * aside + up * upward + forward * along;
  this->moveCamera(way, way);
}

void ViewScene::lookAround(double right, double down)
{
  const CameraView view(renderer_->GetActiveCamera());
  const Vec3 upward = this->upward();
  const Vec3 aside = normalized(cross(view.forward, upward), { 1.0, 0.0, 0.0 });
  const double height = std::asin(std::clamp(dot(view.forward, upward), -1.0, 1.0)) / kDegree;
  const double lowered = height - std::clamp(height - down, -kHighestLook, kHighestLook);
  renderer_->GetActiveCamera()->SetViewUp(&upward.x);
  this->turnCamera(view.eye, -lowered, aside);
  this->turnCamera(view.eye, -right, upward);
}

void ViewScene::fitView()
{
  const AffineTransform model = transformOf(pointsMatrix_);
  const Vec3 up = this->upward();
  const Vec3 right = normalized(cross(up, model.applyToVector(loaded_.orientation.front)));
  const Vec3 front = cross(right, up);
  const CameraView view(renderer_->GetActiveCamera());
  const double height = std::clamp(-dot(view.forward, up), -1.0, 1.0);
  const Vec3 aside =
    std::abs(height) < kSteepest ? -1.0 * view.forward : (height > 0.0 ? -1.0 : 1.0) * view.up;
  this->lookFrom(std::atan2(dot(aside, right), dot(aside, front)) / kDegree, std::asin(height) / kDegree);
}

} // namespace pointhaptics
