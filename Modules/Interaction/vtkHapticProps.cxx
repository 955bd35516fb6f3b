#include "vtkHapticProps.h"

#include "EventLink.h"
#include "ScreenMarks.h"
#include "vtkHapticGauge.h"

#include "vtkActor.h"
#include "vtkArrowSource.h"
#include "vtkAutoInit.h"
#include "vtkCamera.h"
#include "vtkLineSource.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutlineSource.h"
#include "vtkOverlayActor.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRegularPolygonSource.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <array>
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
constexpr float kLast = -2.0F;
constexpr double kSmallestForce = 0.01; // newtons: shorter arrows are not drawn

/// Sizes as parts of the workspace's edge.
constexpr double kHipRadius = 0.007;
constexpr double kNormalLength = 0.25;
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

void setColor(vtkProperty* looks, const double color[3])
{
  looks->SetColor(color[0], color[1], color[2]);
}

/// A shape of size 1, and the matrix that makes of it what is drawn.
struct Mark
{
  vtkNew<vtkOverlayActor> actor;
  vtkNew<vtkMatrix4x4> matrix;
};

void setUpMark(Mark& mark, vtkAlgorithmOutput* shape, const double color[3], bool lit, double hidden)
{
  mark.actor->SetUserMatrix(mark.matrix);
  mark.actor->SetShape(shape);
  mark.actor->SetHiddenOpacity(hidden);
  vtkProperty* looks = mark.actor->GetProperty();
  setColor(looks, color);
  looks->SetLighting(lit);
  looks->SetBackfaceCulling(lit);
  looks->SetAmbient(0.5);
  looks->SetDiffuse(0.5);
}

/// Columns: @p along, two perpendiculars, each times its length; origin last.
void setFrame(vtkMatrix4x4* matrix, const Vec3& origin, const Vec3& along, double length, double thickness)
{
  const Vec3 second = pointhaptics::anyPerpendicular(along);
  const Vec3 third = cross(along, second);
  for (int row = 0; row < 3; ++row)
  {
    matrix->SetElement(row, 0, length * along[row]);
    matrix->SetElement(row, 1, thickness * second[row]);
    matrix->SetElement(row, 2, thickness * third[row]);
    matrix->SetElement(row, 3, origin[row]);
  }
}

Vec3 columnOf(vtkMatrix4x4* matrix, int column)
{
  return { matrix->GetElement(0, column), matrix->GetElement(1, column), matrix->GetElement(2, column) };
}

Vec3 originOf(vtkMatrix4x4* matrix)
{
  return columnOf(matrix, 3);
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

struct vtkHapticProps::Internals
{
  explicit Internals(const vtkHapticProps* props)
    : self(props)
  {
  }
  const vtkHapticProps* self;
  vtkNew<vtkOutlineSource> outline;
  vtkNew<vtkPolyDataMapper> outlineMapper;
  vtkNew<vtkActor> outlineActor;
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkSphereSource> ball;
  vtkNew<vtkLineSource> line;
  vtkNew<vtkArrowSource> arrow;
  Mark proxy;
  Mark normal;
  Mark hip;
  Mark force;
  /// Drawn in this order: the sphere lets see what stands in it, and the force hides the normal.
  std::array<vtkOverlayActor*, 4> all() { return { normal.actor, proxy.actor, hip.actor, force.actor }; }
  /// Light and dark rims of these marks, in their order, of the way to the nearest point and of its ring: a
  /// ring about a ball, the back of a larger arrow, or a line.
  std::array<std::array<Mark, 2>, 6> rims;
  vtkNew<vtkArrowSource> rimArrows[2];
  vtkNew<vtkRegularPolygonSource> circle;
  pointhaptics::EventLink onStart{ [this]
    {
      this->place();
      this->placeRims();
    } };
  bool showsNearest = false;
  Vec3 nearest;
  Vec3 nearestTo;
  vtkNew<vtkHapticGauge> gauge;
  vtkWeakPointer<vtkRenderer> renderer;
  double edge = 0.1;
  bool shown = false;
  ProxyState state;
  double arrowLength = 0.0;

  template <typename Visit>
  void forEach(Visit&& visit)
  {
    for (std::size_t k = 0; k < this->rims.size(); ++k)
    {
      visit(this->rims[k][1].actor);
      visit(this->rims[k][0].actor);
      for (std::size_t i = 0; i < 4 && k == 2; ++i)
      {
        visit(this->all()[i]); // over the lines and the rings, before what stands behind them
      }
    }
  }
  void setUpRims();
  void placeRims();
  void place();
  double pointAt(const Vec3& place) const;
  Vec3 lift(const Vec3& center, const Vec3& along, double way) const;
  double drawnRadius() const;
  const Colors& colors() const { return self->HighContrast ? kHighContrast : kUsual; }
};

/// Length of a point of the screen at @p place, for the present camera; 0: not known.
double vtkHapticProps::Internals::pointAt(const Vec3& place) const
{
  if (!this->renderer || !this->renderer->GetRenderWindow() || !this->renderer->IsActiveCameraCreated())
  {
    return 0.0;
  }
  const pointhaptics::ScreenProjection project(this->renderer);
  const double way = 0.01 * this->edge;
  const auto middle = project(place);
  const auto side = project(place + way * normalized(rightOf(this->renderer->GetActiveCamera())));
  const double pixels = std::hypot(side.x - middle.x, side.y - middle.y);
  return middle.seen && side.seen && pixels > 0.0
    ? way / pixels * pointhaptics::pixelsPerPoint(this->renderer)
    : 0.0;
}

/// Radius of the drawn sphere, for the present camera.
double vtkHapticProps::Internals::drawnRadius() const
{
  const double most = kLargestEnlarged * this->pointAt(this->state.sphereCenter);
  const double least = self->SmallestSphereRadius;
  return std::max(this->state.radius, most > 0.0 ? std::min(least, most) : least);
}

/// Lifts the foot of an arrow that is seen end-on above the sphere on the screen, by @p way.
Vec3 vtkHapticProps::Internals::lift(const Vec3& center, const Vec3& along, double way) const
{
  if (!this->renderer || !this->renderer->IsActiveCameraCreated())
  {
    return {};
  }
  vtkCamera* camera = this->renderer->GetActiveCamera();
  const Vec3 sight = sightTo(center, camera);
  const Vec3 up = pointhaptics::CameraView(camera).up;
  const double part =
    std::clamp((std::abs(dot(along, sight)) - kNearlyEndOn) / (kEndOn - kNearlyEndOn), 0.0, 1.0);
  return part * way * normalized(up - dot(up, sight) * sight);
}

/// The sphere, and what stands on it.
void vtkHapticProps::Internals::place()
{
  if (!this->shown)
  {
    return;
  }
  const double radius = this->drawnRadius();
  const Vec3 center = this->state.contact
    ? this->state.sphereCenter + (radius - this->state.radius) * normalized(this->state.normal)
    : this->state.sphereCenter;
  const Vec3 along = normalized(this->state.force);
  setFrame(this->proxy.matrix, center, { 1, 0, 0 }, radius, radius);
  const double thickness = std::max(1e-9, std::min(this->arrowLength, kArrowThickness * this->edge));
  const Vec3 foot = center + this->lift(center, along, radius + kTipRadius * thickness);
  setFrame(this->force.matrix, foot, along, this->arrowLength, thickness);
  if (this->gauge->GetVisibility())
  {
    const Vec3 tip = foot + this->arrowLength * along;
    this->gauge->Show(&tip.x, norm(this->state.force));
  }
}

void vtkHapticProps::Internals::setUpRims()
{
  this->circle->SetNumberOfSides(32);
  this->circle->GeneratePolygonOff();
  this->circle->SetRadius(1.0);
  this->circle->SetNormal(1.0, 0.0, 0.0);
  for (std::size_t i = 0; i < 2; ++i)
  {
    this->rimArrows[i]->SetShaftResolution(20);
    this->rimArrows[i]->SetTipResolution(20);
    vtkAlgorithmOutput* shapes[6] = { this->line->GetOutputPort(), this->circle->GetOutputPort(),
      this->circle->GetOutputPort(), this->rimArrows[i]->GetOutputPort(), this->line->GetOutputPort(),
      this->circle->GetOutputPort() };
    for (std::size_t k = 0; k < 6; ++k)
    {
      Mark& rim = this->rims[k][i];
      setUpMark(rim, shapes[k], k < 4 ? kRimColors[i] : kNearColors[i], false, k % 3 == 0 ? 0.0 : 1.0);
      rim.actor->GetProperty()->SetFrontfaceCulling(k == 3);
      rim.actor->VisibilityOff();
    }
  }
}

/// Rims of the marks as they are shown, and the line to the nearest point.
void vtkHapticProps::Internals::placeRims()
{
  const bool isOutlined = self->OutlineVisibility && self->HandVisibility;
  const double thicker = self->HighContrast ? kThicker : 1.0;
  const double pixels = pointhaptics::pixelsPerPoint(this->renderer);
  const double point = thicker * this->pointAt(this->state.sphereCenter);
  const Vec3 way = this->nearestTo - this->nearest;
  const double ring = std::max(kSmallestRing * this->edge, kRingPart * norm(way));
  const Vec3 ahead = columnOf(this->force.matrix, 0);
  const double length = norm(ahead);
  const double thickness = std::max(1e-12, norm(columnOf(this->force.matrix, 1)));
  for (std::size_t i = 0; i < 2; ++i)
  {
    const double width = kRims[i] * point;
    for (std::size_t k = 0; k < 6; ++k)
    {
      const bool isRim = k < 4 && isOutlined && point > 0.0 && this->all()[k]->GetVisibility();
      this->rims[k][i].actor->SetVisibility(isRim || (k >= 4 && this->showsNearest));
      const double inside = k == 0 ? double(this->colors().lineWidth) : 0.0;
      const double beside = k == 0 ? 2.0 * kRims[i] : k < 4 ? kRims[i] : kNearWidths[i];
      this->rims[k][i].actor->GetProperty()->SetLineWidth(float(inside + beside * thicker * pixels));
      if (vtkMatrix4x4* mark = k == 1 ? this->proxy.matrix : this->hip.matrix; isRim && (k == 1 || k == 2))
      {
        setFrame(this->rims[k][i].matrix, originOf(mark),
          sightTo(originOf(mark), this->renderer->GetActiveCamera()), 1.0,
          norm(columnOf(mark, 0)) + 0.5 * width);
      }
    }
    this->rims[0][i].matrix->DeepCopy(this->normal.matrix);
    const double longer = length + 2.0 * width;
    setFrame(this->rims[3][i].matrix, originOf(this->force.matrix) - width * normalized(ahead),
      normalized(ahead), longer, thickness);
    this->rimArrows[i]->SetShaftRadius(kShaftRadius + width / thickness);
    this->rimArrows[i]->SetTipRadius(kTipRadius + width / thickness);
    this->rimArrows[i]->SetTipLength((kTipLength * length + 2.0 * width) / longer);
    setFrame(this->rims[4][i].matrix, this->nearest, normalized(way), norm(way), 1.0);
    setFrame(this->rims[5][i].matrix, this->nearest, normalized(way), 1.0, ring);
  }
}

vtkStandardNewMacro(vtkHapticProps);

vtkHapticProps::vtkHapticProps()
  : Parts(new Internals(this))
{
  Internals& parts = *this->Parts;
  parts.outlineMapper->SetInputConnection(parts.outline->GetOutputPort());
  parts.outlineActor->SetMapper(parts.outlineMapper);
  parts.outlineActor->GetProperty()->SetColor(0.0, 0.0, 0.0);
  parts.outlineActor->GetProperty()->LightingOff();
  parts.outlineActor->GetProperty()->SetLineWidth(1.5f);
  parts.outlineActor->PickableOff();
  parts.sphere->SetRadius(1.0);
  parts.sphere->SetThetaResolution(32);
  parts.sphere->SetPhiResolution(24);
  parts.ball->SetRadius(1.0);
  parts.ball->SetThetaResolution(20);
  parts.ball->SetPhiResolution(14);
  parts.line->SetPoint1(0.0, 0.0, 0.0);
  parts.line->SetPoint2(1.0, 0.0, 0.0);
  parts.arrow->SetShaftResolution(20);
  parts.arrow->SetTipResolution(20);
  parts.arrow->SetShaftRadius(kShaftRadius);
  parts.arrow->SetTipRadius(kTipRadius);
  parts.arrow->SetTipLength(kTipLength);
  setUpMark(parts.proxy, parts.sphere->GetOutputPort(), kUsual.sphere, true, kHiddenSphere);
  setUpMark(parts.normal, parts.line->GetOutputPort(), kUsual.normal, false, 1.0);
  setUpMark(parts.hip, parts.ball->GetOutputPort(), kUsual.hip, true, 0.55);
  setUpMark(parts.force, parts.arrow->GetOutputPort(), kUsual.force, true, 0.55);
  parts.normal.actor->GetProperty()->SetLineWidth(kUsual.lineWidth);
  parts.setUpRims();
  const double cube[6] = { -0.05, 0.05, -0.05, 0.05, -0.05, 0.05 };
  this->SetWorkspaceBounds(cube);
  this->HideTouch();
}

vtkHapticProps::~vtkHapticProps() = default;

void vtkHapticProps::SetWorkspaceBounds(const double bounds[6])
{
  std::copy(bounds, bounds + 6, this->WorkspaceBounds);
  this->Parts->outline->SetBounds(this->WorkspaceBounds);
  this->Parts->edge = std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  this->Modified();
}

void vtkHapticProps::HideTouch()
{
  this->Parts->shown = false;
  for (vtkOverlayActor* mark : this->Parts->all())
  {
    mark->VisibilityOff();
  }
  this->Parts->gauge->SetVisibility(false);
  this->Modified();
}

void vtkHapticProps::SetGaugeVisibility(bool visible)
{
  this->GaugeVisibility = visible;
  this->Parts->gauge->SetVisibility(visible && this->Parts->force.actor->GetVisibility());
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
  if (this->Parts->shown)
  {
    this->Parts->shown = false;
    this->Update(this->Parts->state);
  }
  this->Modified();
}

vtkHapticGauge* vtkHapticProps::GetGauge()
{
  return this->Parts->gauge;
}

void vtkHapticProps::AddTo(vtkRenderer* renderer)
{
  this->Parts->renderer = renderer;
  renderer->AddActor(this->Parts->outlineActor);
  this->Parts->forEach([renderer](vtkOverlayActor* mark) { renderer->AddActor(mark); });
  this->Parts->onStart.follow(renderer, vtkCommand::StartEvent, kLast);
  this->Parts->gauge->AddTo(renderer);
}

void vtkHapticProps::RemoveFrom(vtkRenderer* renderer)
{
  renderer->RemoveActor(this->Parts->outlineActor);
  this->Parts->forEach([renderer](vtkOverlayActor* mark) { renderer->RemoveActor(mark); });
  this->Parts->onStart.follow(nullptr);
  this->Parts->gauge->RemoveFrom(renderer);
}

void vtkHapticProps::SetOutlineVisibility(bool visible)
{
  this->OutlineVisibility = visible;
  this->Modified();
}

void vtkHapticProps::SetHighContrast(bool high)
{
  Internals& parts = *this->Parts;
  if (high == this->HighContrast)
  {
    return;
  }
  this->HighContrast = high;
  setColor(parts.normal.actor->GetProperty(), parts.colors().normal);
  parts.normal.actor->GetProperty()->SetLineWidth(parts.colors().lineWidth);
  setColor(parts.hip.actor->GetProperty(), parts.colors().hip);
  setColor(parts.force.actor->GetProperty(), parts.colors().force);
  parts.gauge->SetOpaque(high);
  this->UpdateAgain();
}

bool vtkHapticProps::ShowNearest(const double hip[3], const double point[3])
{
  Internals& parts = *this->Parts;
  const Vec3 from{ hip[0], hip[1], hip[2] };
  const Vec3 to{ point[0], point[1], point[2] };
  if (!this->HandVisibility || !isFinite(from - to) || from == to)
  {
    return this->HideNearest();
  }
  const double visible = kVisibleMotion * parts.edge;
  if (parts.showsNearest && norm(from - parts.nearestTo) < visible && norm(to - parts.nearest) < visible)
  {
    return false;
  }
  parts.nearest = to;
  parts.nearestTo = from;
  parts.showsNearest = true;
  return true;
}

bool vtkHapticProps::HideNearest()
{
  const bool wasShown = this->Parts->showsNearest;
  this->Parts->showsNearest = false;
  return wasShown;
}

bool vtkHapticProps::GetNearest(double point[3]) const
{
  std::copy(&this->Parts->nearest.x, &this->Parts->nearest.x + 3, point);
  return this->Parts->showsNearest;
}

bool vtkHapticProps::Update(const ProxyState& state)
{
  Internals& parts = *this->Parts;
  const double visible = kVisibleMotion * parts.edge;
  const ProxyState& old = parts.state;
  const bool same = parts.shown && old.contact == state.contact && norm(old.hip - state.hip) < visible &&
    norm(old.sphereCenter - state.sphereCenter) < visible && std::abs(old.radius - state.radius) < visible &&
    norm(old.normal - state.normal) < 1e-3 && norm(old.force - state.force) * this->ForceScale < visible;
  if (same || !isFinite(state.hip) || !isFinite(state.sphereCenter) || !isFinite(state.force))
  {
    return false;
  }
  parts.state = state;
  parts.shown = true;
  const double force = norm(state.force);
  parts.arrowLength = std::min(force * this->ForceScale, kLongestArrow * parts.edge);
  setFrame(parts.hip.matrix, state.hip, { 1, 0, 0 }, kHipRadius * parts.edge, kHipRadius * parts.edge);
  setFrame(parts.normal.matrix, state.proxy, normalized(state.normal), kNormalLength * parts.edge, 1.0);
  parts.proxy.actor->SetVisibility(state.radius > 0.0 && state.radius <= kLargestSphere * parts.edge);
  parts.hip.actor->SetVisibility(this->HandVisibility);
  parts.normal.actor->SetVisibility(state.contact);
  const bool pushes = this->HandVisibility && state.contact && force > kSmallestForce;
  parts.force.actor->SetVisibility(pushes);
  const bool isGauged = pushes && this->GaugeVisibility;
  parts.gauge->SetVisibility(isGauged);
  if (isGauged)
  {
    const Vec3 normalEnd = state.proxy + kNormalLength * parts.edge * normalized(state.normal);
    parts.gauge->KeepOffLine(&state.proxy.x, &normalEnd.x);
    // The gauge stands where the arrow goes, not over what it comes from.
    parts.gauge->SetLeft(
      parts.renderer && dot(state.force, rightOf(parts.renderer->GetActiveCamera())) < 0.0);
  }
  parts.place();
  vtkProperty* sphere = parts.proxy.actor->GetProperty();
  setColor(sphere, state.contact ? parts.colors().sphere : parts.colors().freeSphere);
  sphere->SetOpacity(state.contact ? 1.0 : 0.45);
  parts.proxy.actor->SetHiddenOpacity(state.contact ? kHiddenSphere : kHiddenFreeSphere);
  this->Modified();
  return true;
}

vtkActor* vtkHapticProps::GetProxyActor()
{
  return this->Parts->proxy.actor;
}

vtkActor* vtkHapticProps::GetNormalActor()
{
  return this->Parts->normal.actor;
}

vtkActor* vtkHapticProps::GetHipActor()
{
  return this->Parts->hip.actor;
}

vtkActor* vtkHapticProps::GetForceActor()
{
  return this->Parts->force.actor;
}

vtkActor* vtkHapticProps::GetWorkspaceActor()
{
  return this->Parts->outlineActor;
}
