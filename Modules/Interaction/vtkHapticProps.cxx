#include "vtkHapticProps.h"

#include "ScreenMarks.h"

#include "vtkActor.h"
#include "vtkAutoInit.h"
#include "vtkCamera.h"
#include "vtkLineSource.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRegularPolygonSource.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cmath>

// Programs that link this library need not call vtk_module_autoinit() themselves to get a window.
VTK_MODULE_INIT(vtkInteractionStyle);
VTK_MODULE_INIT(vtkRenderingContextOpenGL2);
VTK_MODULE_INIT(vtkRenderingFreeType);
VTK_MODULE_INIT(vtkRenderingOpenGL2);
VTK_MODULE_INIT(vtkRenderingUI);

using pointhaptics::ProxyState;
using pointhaptics::Vec3;

namespace
{

/// Colors of the marks, and the width of lines.
struct Colors
{
  double sphere[3];
  double freeSphere[3];
  double normal[3];
  double hip[3];
  double force[3];
  float lineWidth;
};
constexpr Colors kUsual = { { 1.0, 0.30, 0.62 }, { 1.0, 0.55, 0.78 }, { 0.05, 0.78, 0.15 },
  { 0.05, 0.25, 0.95 }, { 0.95, 0.42, 0.02 }, 4.0f };
/// Colors of Okabe and Ito's palette; they differ in lightness too.
constexpr Colors kHighContrast = { { 0.94, 0.89, 0.26 }, { 0.97, 0.94, 0.60 }, { 1.0, 1.0, 1.0 },
  { 0.34, 0.71, 0.91 }, { 0.84, 0.37, 0.0 }, 6.0f };
/// Widths of the light rim about a mark and of the dark one beyond it, points; and with high contrast.
constexpr double kRims[2] = { 1.75, 3.0 };
constexpr double kThicker = 1.6;
constexpr double kRimColors[2][3] = { { 1.0, 1.0, 1.0 }, { 0.05, 0.05, 0.06 } };
constexpr double kNearWidths[2] = { 2.0, 4.0 };
constexpr double kNearColors[2][3] = { { 1.0, 0.85, 0.10 }, { 0.05, 0.05, 0.06 } };
/// Priority after all observers that set the camera and the window's dots per inch.
constexpr float kAfterOthers = -2.0F;
constexpr double kSmallestForce = 0.01; // newtons: shorter arrows are not drawn

/// Sizes as parts of the workspace's edge.
constexpr double kHipRadius = 0.007;
constexpr double kNormalLength = 0.25;
constexpr double kLongestNormal = 150.0; // points, in a close view
constexpr double kNewtonLength = 0.06;
constexpr double kLongestArrow = 0.4;
constexpr double kArrowThickness = 0.06;
/// Opacity of the sphere where the cloud hides it: in contact, and in free space.
constexpr double kHiddenSphere = 0.75;
constexpr double kHiddenFreeSphere = 0.35;
constexpr double kVisibleMotion = 1e-4;
/// Radius of the largest sphere that is drawn. A few points far apart have larger ones.
constexpr double kLargestSphere = 0.5;
/// Radius of a sphere that is drawn larger than it is, points: in a close view it would hide what it touches.
constexpr double kLargestEnlarged = 24.0;
/// Parts of the arrow, over its length and thickness.
constexpr double kShaftRadius = 0.10;
constexpr double kTipRadius = 0.24;
constexpr double kTipLength = 0.3;
/// Cosines between arrow and sight: the lift of the arrow begins, and is whole.
constexpr double kNearlyEndOn = 0.9;
constexpr double kEndOn = 0.98;
/// Radius of the ring about the nearest point: of its distance, and at least, of the edge.
constexpr double kRingPart = 0.3;
constexpr double kSmallestRing = 0.012;

void setColor(vtkActor* actor, const double color[3])
{
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
}

const Colors& colorsOf(bool isHighContrast)
{
  return isHighContrast ? kHighContrast : kUsual;
}

Vec3 rightOf(vtkCamera* camera)
{
  const pointhaptics::CameraView view(camera);
  return cross(view.forward, view.up);
}

/// Direction from the eye to @p place.
Vec3 sightTo(const Vec3& place, vtkCamera* camera)
{
  const pointhaptics::CameraView view(camera);
  return camera->GetParallelProjection() ? view.forward : normalized(place - view.eye, view.forward);
}

} // namespace

void vtkHapticProps::Mark::setUp(vtkAlgorithmOutput* shape, const double color[3], bool lit, double hidden)
{
  this->actor->SetUserMatrix(this->matrix);
  this->actor->SetShape(shape);
  this->actor->SetHiddenOpacity(hidden);
  setColor(this->actor, color);
  vtkProperty* looks = this->actor->GetProperty();
  looks->SetLighting(lit);
  looks->SetBackfaceCulling(lit);
  looks->SetAmbient(0.5);
  looks->SetDiffuse(0.5);
}

/// Columns: @p along, two perpendiculars, each times its length; origin last.
void vtkHapticProps::Mark::place(const Vec3& origin, const Vec3& along, double length, double thickness)
{
  const Vec3 second = pointhaptics::anyPerpendicular(along);
  const Vec3 third = cross(along, second);
  for (int row = 0; row < 3; ++row)
  {
    this->matrix->SetElement(row, 0, length * along[row]);
    this->matrix->SetElement(row, 1, thickness * second[row]);
    this->matrix->SetElement(row, 2, thickness * third[row]);
    this->matrix->SetElement(row, 3, origin[row]);
  }
}

Vec3 vtkHapticProps::Mark::column(int column) const
{
  return { this->matrix->GetElement(0, column), this->matrix->GetElement(1, column),
    this->matrix->GetElement(2, column) };
}

template <typename Visit>
void vtkHapticProps::ForEach(Visit&& visit)
{
  for (std::size_t k = 0; k < this->Rims.size(); ++k)
  {
    visit(this->Rims[k][1].actor);
    visit(this->Rims[k][0].actor);
    for (std::size_t i = 0; i < 4 && k == 2; ++i)
    {
      visit(this->All()[i]); // over the lines and the rings, before what stands behind them
    }
  }
}

/// Length of a point of the screen at @p place, for the present camera; 0: not known.
double vtkHapticProps::PointAt(const Vec3& place) const
{
  if (!this->Renderer || !this->Renderer->GetRenderWindow() || !this->Renderer->IsActiveCameraCreated())
  {
    return 0.0;
  }
  const pointhaptics::ScreenProjection project(this->Renderer);
  const double way = 0.01 * this->Edge;
  const auto middle = project(place);
  const auto side = project(place + way * normalized(rightOf(this->Renderer->GetActiveCamera())));
  const double pixels = std::hypot(side.x - middle.x, side.y - middle.y);
  return middle.seen && side.seen && pixels > 0.0
    ? way / pixels * pointhaptics::pixelsPerPoint(this->Renderer)
    : 0.0;
}

/// Radius of the drawn sphere, for the present camera.
double vtkHapticProps::DrawnRadius() const
{
  const double most = kLargestEnlarged * this->PointAt(this->State.sphereCenter);
  const double least = this->SmallestSphereRadius;
  return std::max(this->State.radius, most > 0.0 ? std::min(least, most) : least);
}

/// Lifts the foot of an arrow that is seen end-on above the sphere on the screen, by @p way.
Vec3 vtkHapticProps::Lift(const Vec3& center, const Vec3& along, double way) const
{
  if (!this->Renderer || !this->Renderer->IsActiveCameraCreated())
  {
    return {};
  }
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  const Vec3 sight = sightTo(center, camera);
  const Vec3 up = pointhaptics::CameraView(camera).up;
  const double part =
    std::clamp((std::abs(dot(along, sight)) - kNearlyEndOn) / (kEndOn - kNearlyEndOn), 0.0, 1.0);
  return part * way * normalized(up - dot(up, sight) * sight);
}

/// The sphere, and what stands on it.
void vtkHapticProps::Place()
{
  if (!this->IsShown)
  {
    return;
  }
  const double radius = this->DrawnRadius();
  const Vec3 center = this->State.contact
    ? this->State.sphereCenter + (radius - this->State.radius) * normalized(this->State.normal)
    : this->State.sphereCenter;
  const Vec3 along = normalized(this->State.force);
  this->Proxy.place(center, { 1, 0, 0 }, radius, radius);
  const double thickness = std::max(1e-9, std::min(this->ArrowLength, kArrowThickness * this->Edge));
  const Vec3 foot = center + this->Lift(center, along, radius + kTipRadius * thickness);
  this->Force.place(foot, along, this->ArrowLength, thickness);
  const double longest = kLongestNormal * this->PointAt(this->State.proxy);
  const double length = kNormalLength * this->Edge;
  const double drawn = longest > 0.0 ? std::min(length, longest) : length;
  this->Normal.place(this->State.proxy, normalized(this->State.normal), drawn, 1.0);
  if (this->Gauge->GetVisibility())
  {
    const Vec3 end = this->State.proxy + drawn * normalized(this->State.normal);
    this->Gauge->KeepOffLine(&this->State.proxy.x, &end.x);
    const Vec3 tip = foot + this->ArrowLength * along;
    this->Gauge->Show(&tip.x, norm(this->State.force));
  }
}

void vtkHapticProps::SetUpRims(vtkAlgorithmOutput* line)
{
  vtkNew<vtkRegularPolygonSource> polygon;
  polygon->SetNumberOfSides(32);
  polygon->GeneratePolygonOff();
  polygon->SetRadius(1.0);
  polygon->SetNormal(1.0, 0.0, 0.0);
  vtkAlgorithmOutput* circle = polygon->GetOutputPort();
  for (std::size_t i = 0; i < 2; ++i)
  {
    this->RimArrows[i]->SetShaftResolution(20);
    this->RimArrows[i]->SetTipResolution(20);
    vtkAlgorithmOutput* shapes[6] = { line, circle, circle, this->RimArrows[i]->GetOutputPort(), line,
      circle };
    for (std::size_t k = 0; k < 6; ++k)
    {
      Mark& rim = this->Rims[k][i];
      rim.setUp(shapes[k], k < 4 ? kRimColors[i] : kNearColors[i], false, k % 3 == 0 ? 0.0 : 1.0);
      rim.actor->GetProperty()->SetFrontfaceCulling(k == 3);
      rim.actor->VisibilityOff();
    }
  }
}

/// Rims of the marks as they are shown, and the line to the nearest point.
void vtkHapticProps::PlaceRims()
{
  const bool isOutlined = this->OutlineVisibility && this->HandVisibility;
  const double thicker = this->HighContrast ? kThicker : 1.0;
  const double pixels = pointhaptics::pixelsPerPoint(this->Renderer);
  const double point = thicker * this->PointAt(this->State.sphereCenter);
  const Vec3 way = this->NearestTo - this->Nearest;
  const double ring = std::max(kSmallestRing * this->Edge, kRingPart * norm(way));
  const Vec3 ahead = this->Force.column(0);
  const double length = norm(ahead);
  const double thickness = std::max(1e-12, norm(this->Force.column(1)));
  for (std::size_t i = 0; i < 2; ++i)
  {
    const double width = kRims[i] * point;
    for (std::size_t k = 0; k < 6; ++k)
    {
      const bool isRim = k < 4 && isOutlined && point > 0.0 && this->All()[k]->GetVisibility();
      this->Rims[k][i].actor->SetVisibility(isRim || (k >= 4 && this->ShowsNearest));
      const double inside = k == 0 ? double(colorsOf(this->HighContrast).lineWidth) : 0.0;
      const double beside = k == 0 ? 2.0 * kRims[i] : k < 4 ? kRims[i] : kNearWidths[i];
      this->Rims[k][i].actor->GetProperty()->SetLineWidth(float(inside + beside * thicker * pixels));
      if (const Mark& ball = k == 1 ? this->Proxy : this->Hip; isRim && (k == 1 || k == 2))
      {
        const Vec3 middle = ball.column(3);
        this->Rims[k][i].place(middle, sightTo(middle, this->Renderer->GetActiveCamera()), 1.0,
          norm(ball.column(0)) + 0.5 * width);
      }
    }
    this->Rims[0][i].matrix->DeepCopy(this->Normal.matrix);
    const double longer = length + 2.0 * width;
    this->Rims[3][i].place(
      this->Force.column(3) - width * normalized(ahead), normalized(ahead), longer, thickness);
    this->RimArrows[i]->SetShaftRadius(kShaftRadius + width / thickness);
    this->RimArrows[i]->SetTipRadius(kTipRadius + width / thickness);
    this->RimArrows[i]->SetTipLength((kTipLength * length + 2.0 * width) / longer);
    this->Rims[4][i].place(this->Nearest, normalized(way), norm(way), 1.0);
    this->Rims[5][i].place(this->Nearest, normalized(way), 1.0, ring);
  }
}

vtkStandardNewMacro(vtkHapticProps);

vtkHapticProps::vtkHapticProps()
{
  vtkNew<vtkPolyDataMapper> frame;
  frame->SetInputConnection(this->Box->GetOutputPort());
  this->Frame->SetMapper(frame);
  this->Frame->GetProperty()->SetColor(0.0, 0.0, 0.0);
  this->Frame->GetProperty()->LightingOff();
  this->Frame->GetProperty()->SetLineWidth(1.5f);
  this->Frame->PickableOff();
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(32);
  sphere->SetPhiResolution(24);
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(1.0);
  ball->SetThetaResolution(20);
  ball->SetPhiResolution(14);
  vtkNew<vtkLineSource> line;
  line->SetPoint1(0.0, 0.0, 0.0);
  line->SetPoint2(1.0, 0.0, 0.0);
  vtkNew<vtkArrowSource> arrow;
  arrow->SetShaftResolution(20);
  arrow->SetTipResolution(20);
  arrow->SetShaftRadius(kShaftRadius);
  arrow->SetTipRadius(kTipRadius);
  arrow->SetTipLength(kTipLength);
  this->Proxy.setUp(sphere->GetOutputPort(), kUsual.sphere, true, kHiddenSphere);
  this->Normal.setUp(line->GetOutputPort(), kUsual.normal, false, 1.0);
  this->Hip.setUp(ball->GetOutputPort(), kUsual.hip, true, 0.55);
  this->Force.setUp(arrow->GetOutputPort(), kUsual.force, true, 0.55);
  this->Normal.actor->GetProperty()->SetLineWidth(kUsual.lineWidth);
  this->SetUpRims(line->GetOutputPort());
  const double cube[6] = { -0.05, 0.05, -0.05, 0.05, -0.05, 0.05 };
  this->SetWorkspaceBounds(cube);
  this->HideTouch();
}

vtkHapticProps::~vtkHapticProps() = default;

void vtkHapticProps::SetWorkspaceBounds(const double bounds[6])
{
  this->Box->SetBounds(bounds);
  this->Edge = std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  this->Modified();
}

void vtkHapticProps::HideTouch()
{
  this->IsShown = false;
  for (vtkOverlayActor* mark : this->All())
  {
    mark->VisibilityOff();
  }
  this->Gauge->SetVisibility(false);
  this->Modified();
}

void vtkHapticProps::SetHandVisibility(bool visible)
{
  this->HandVisibility = visible;
  if (!visible)
  {
    this->HideNearest();
  }
  this->UpdateAgain();
}

void vtkHapticProps::UpdateAgain()
{
  if (this->IsShown)
  {
    this->IsShown = false;
    this->Update(this->State);
  }
  this->Modified();
}

void vtkHapticProps::AddTo(vtkRenderer* renderer)
{
  this->Renderer = renderer;
  renderer->AddActor(this->Frame);
  this->ForEach([renderer](vtkOverlayActor* mark) { renderer->AddActor(mark); });
  this->OnStart.follow(renderer, vtkCommand::StartEvent, kAfterOthers);
  this->Gauge->AddTo(renderer);
}

void vtkHapticProps::RemoveFrom(vtkRenderer* renderer)
{
  renderer->RemoveActor(this->Frame);
  this->ForEach([renderer](vtkOverlayActor* mark) { renderer->RemoveActor(mark); });
  this->OnStart.follow(nullptr);
  this->Gauge->RemoveFrom(renderer);
}

void vtkHapticProps::SetHighContrast(bool high)
{
  if (high == this->HighContrast)
  {
    return;
  }
  this->HighContrast = high;
  const Colors& colors = colorsOf(high);
  setColor(this->Normal.actor, colors.normal);
  this->Normal.actor->GetProperty()->SetLineWidth(colors.lineWidth);
  setColor(this->Hip.actor, colors.hip);
  setColor(this->Force.actor, colors.force);
  this->Gauge->SetOpaque(high);
  this->UpdateAgain();
}

bool vtkHapticProps::ShowNearest(const double hip[3], const double point[3])
{
  const Vec3 from{ hip[0], hip[1], hip[2] };
  const Vec3 to{ point[0], point[1], point[2] };
  if (!this->HandVisibility || !isFinite(from - to) || from == to)
  {
    return this->HideNearest();
  }
  const double visible = kVisibleMotion * this->Edge;
  if (this->ShowsNearest && norm(from - this->NearestTo) < visible && norm(to - this->Nearest) < visible)
  {
    return false;
  }
  this->Nearest = to;
  this->NearestTo = from;
  this->ShowsNearest = true;
  return true;
}

bool vtkHapticProps::HideNearest()
{
  const bool wasShown = this->ShowsNearest;
  this->ShowsNearest = false;
  return wasShown;
}

bool vtkHapticProps::GetNearest(double point[3]) const
{
  std::copy(&this->Nearest.x, &this->Nearest.x + 3, point);
  return this->ShowsNearest;
}

bool vtkHapticProps::Update(const ProxyState& state)
{
  const double visible = kVisibleMotion * this->Edge;
  const ProxyState& old = this->State;
  const double newtonLength = kNewtonLength * this->Edge;
  const bool same = this->IsShown && old.contact == state.contact && norm(old.hip - state.hip) < visible &&
    norm(old.sphereCenter - state.sphereCenter) < visible && std::abs(old.radius - state.radius) < visible &&
    norm(old.normal - state.normal) < 1e-3 && norm(old.force - state.force) * newtonLength < visible;
  if (same || !isFinite(state.hip) || !isFinite(state.sphereCenter) || !isFinite(state.force))
  {
    return false;
  }
  this->State = state;
  this->IsShown = true;
  const double force = norm(state.force);
  this->ArrowLength = std::min(force * newtonLength, kLongestArrow * this->Edge);
  this->Hip.place(state.hip, { 1, 0, 0 }, kHipRadius * this->Edge, kHipRadius * this->Edge);
  this->Proxy.actor->SetVisibility(state.radius > 0.0 && state.radius <= kLargestSphere * this->Edge);
  this->Hip.actor->SetVisibility(this->HandVisibility);
  this->Normal.actor->SetVisibility(state.contact);
  const bool pushes = this->HandVisibility && state.contact && force > kSmallestForce;
  this->Force.actor->SetVisibility(pushes);
  this->Gauge->SetVisibility(pushes);
  if (pushes)
  {
    // The gauge stands where the arrow goes, not over what it comes from.
    this->Gauge->SetLeft(
      this->Renderer && dot(state.force, rightOf(this->Renderer->GetActiveCamera())) < 0.0);
  }
  this->Place();
  const Colors& colors = colorsOf(this->HighContrast);
  setColor(this->Proxy.actor, state.contact ? colors.sphere : colors.freeSphere);
  this->Proxy.actor->GetProperty()->SetOpacity(state.contact ? 1.0 : 0.45);
  this->Proxy.actor->SetHiddenOpacity(state.contact ? kHiddenSphere : kHiddenFreeSphere);
  this->Modified();
  return true;
}
