#include "vtkHapticGauge.h"

#include "EventLink.h"
#include "PixelBox.h"
#include "ScreenMarks.h"

#include "vtkCoordinate.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace
{

/// Points, from the anchor's display position.
constexpr double kAside = 22.0;
constexpr double kWidth = 9.0;
constexpr double kHeight = 60.0;
constexpr double kTextAside = kAside + kWidth + 6.0;
/// Free on all sides of a line that is kept off.
constexpr double kBesideLine = 5.0;
/// Opacity.
constexpr double kBarGround = 0.75;
constexpr double kNumberGround = 0.6;
/// Step of the search for a free place, points.
constexpr double kStep = 12.0;
/// After ScreenLayout, which says what is taken.
constexpr float kLast = -2.0F;

bool meet(const std::array<double, 4>& a, const std::array<double, 4>& b)
{
  return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
}

/// True if the line from @p a to @p b goes through @p box.
bool meets(const pointhaptics::Pixel& a, const pointhaptics::Pixel& b, const std::array<double, 4>& box)
{
  const double from[2] = { a.x, a.y };
  const double way[2] = { b.x - a.x, b.y - a.y };
  double enters = 0.0; // parts of the way
  double leaves = 1.0;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double low = box[std::size_t(axis)] - from[axis];
    const double high = box[std::size_t(axis + 2)] - from[axis];
    if (way[axis] == 0.0)
    {
      enters = low <= 0.0 && high >= 0.0 ? enters : 2.0;
      continue;
    }
    enters = std::max(enters, std::min(low / way[axis], high / way[axis]));
    leaves = std::min(leaves, std::max(low / way[axis], high / way[axis]));
  }
  return enters <= leaves;
}

} // namespace

struct vtkHapticGauge::Internals
{
  explicit Internals(vtkHapticGauge* self)
    : onStart([self] { self->Arrange(); })
  {
  }
  pointhaptics::PixelBox ground{ true, 1.0, 1.0, 1.0, kBarGround };
  pointhaptics::PixelBox fill{ true, 0.95, 0.42, 0.02 };
  pointhaptics::PixelBox frame{ false, 0.15, 0.15, 0.18 };
  std::array<vtkActor2D*, 4> all() { return { ground.actor(), fill.actor(), frame.actor(), number }; }
  /// The text's own position is pixels from a corner that follows the anchor.
  vtkNew<vtkTextActor> number;
  vtkNew<vtkCoordinate> anchor;
  double part = 0.0;       // of the full bar
  double wantedSide = 1.0; // -1: left
  double side = 1.0;
  double higher = 0.0; // pixels
  double pixels = 1.0; // of a point
  std::function<std::vector<std::array<double, 4>>()> taken;
  pointhaptics::Vec3 lineBegin; // kept off; equal: there is none
  pointhaptics::Vec3 lineEnd;
  pointhaptics::EventLink onStart;
  vtkWeakPointer<vtkRenderer> renderer;
  std::array<double, 4> box{};

  void place();
  std::array<double, 4> boxAt(const pointhaptics::Pixel& at, const double text[2]) const;
};

void vtkHapticGauge::Internals::place()
{
  const double near = this->side * this->pixels * kAside;
  const double far = this->side * this->pixels * (kAside + kWidth);
  const double height = this->pixels * kHeight;
  const double bottom = this->higher - 0.5 * height;
  this->ground.place(near, far, bottom, bottom + height);
  this->frame.place(near, far, bottom, bottom + height);
  this->fill.place(near, far, bottom, bottom + this->part * height);
  this->number->SetPosition(this->side * this->pixels * kTextAside, this->higher);
  vtkTextProperty* text = this->number->GetTextProperty();
  this->side > 0.0 ? text->SetJustificationToLeft() : text->SetJustificationToRight();
}

/// Box of the gauge at place @p at; @p text is the size of the number.
std::array<double, 4> vtkHapticGauge::Internals::boxAt(
  const pointhaptics::Pixel& at, const double text[2]) const
{
  const double near = at.x + this->side * this->pixels * kAside;
  const double far = at.x + this->side * (this->pixels * kTextAside + text[0]);
  const double half = 0.5 * std::max(this->pixels * kHeight, text[1]);
  const double middle = at.y + this->higher;
  return { std::min(near, far), middle - half, std::max(near, far), middle + half };
}

vtkStandardNewMacro(vtkHapticGauge);

vtkHapticGauge::vtkHapticGauge()
  : Parts(new Internals(this))
{
  Internals& parts = *this->Parts;
  for (pointhaptics::PixelBox* bar : { &parts.ground, &parts.fill, &parts.frame })
  {
    bar->actor()->GetPositionCoordinate()->SetCoordinateSystemToWorld();
  }
  parts.anchor->SetCoordinateSystemToWorld();
  vtkTextProperty* text = parts.number->GetTextProperty();
  text->SetFontSize(15);
  text->SetBold(true);
  text->SetColor(0.08, 0.08, 0.10);
  text->SetBackgroundColor(1.0, 1.0, 1.0);
  text->SetBackgroundOpacity(kNumberGround);
  text->SetVerticalJustificationToCentered();
  parts.number->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  parts.number->GetPositionCoordinate()->SetReferenceCoordinate(parts.anchor);
  parts.number->VisibilityOff();
  parts.place();
}

vtkHapticGauge::~vtkHapticGauge() = default;

void vtkHapticGauge::SetOpaque(bool opaque)
{
  this->Parts->ground.actor()->GetProperty()->SetOpacity(opaque ? 1.0 : kBarGround);
  this->Parts->number->GetTextProperty()->SetBackgroundOpacity(opaque ? 1.0 : kNumberGround);
}

void vtkHapticGauge::SetTaken(std::function<std::vector<std::array<double, 4>>()> taken)
{
  this->Parts->taken = std::move(taken);
}

void vtkHapticGauge::KeepOffLine(const double begin[3], const double end[3])
{
  this->Parts->lineBegin = { begin[0], begin[1], begin[2] };
  this->Parts->lineEnd = { end[0], end[1], end[2] };
}

std::array<double, 4> vtkHapticGauge::GetPlace() const
{
  return this->Parts->box;
}

/// Beside the anchor, or at the nearest place on either side that is in the picture and free.
void vtkHapticGauge::Arrange()
{
  Internals& parts = *this->Parts;
  vtkRenderer* renderer = parts.renderer;
  if (!renderer || !renderer->GetRenderWindow() || !this->GetVisibility())
  {
    return;
  }
  parts.pixels = pointhaptics::pixelsPerPoint(renderer);
  const double* point = parts.anchor->GetValue();
  const pointhaptics::ScreenProjection project(renderer);
  const pointhaptics::Pixel anchor = project({ point[0], point[1], point[2] });
  pointhaptics::Vec3 begin = parts.lineBegin;
  pointhaptics::Vec3 end = parts.lineEnd;
  const bool hasLine = begin != end && project.leaveSeenPart(begin, end);
  const double beside = parts.pixels * kBesideLine;
  double text[2];
  parts.number->GetSize(renderer, text);
  const double height = renderer->GetSize()[1];
  const std::vector<std::array<double, 4>> taken =
    parts.taken ? parts.taken() : std::vector<std::array<double, 4>>();
  const auto isFree = [&](const std::array<double, 4>& box)
  {
    const std::array<double, 4> wide = { box[0] - beside, box[1] - beside, box[2] + beside, box[3] + beside };
    return !(hasLine && meets(project(begin), project(end), wide)) && box[0] >= 0.0 && box[1] >= 0.0 &&
      box[2] <= renderer->GetSize()[0] && box[3] <= height &&
      std::none_of(taken.begin(), taken.end(), [&](const auto& other) { return meet(box, other); });
  };
  for (double away = 0.0; away < height; away += parts.pixels * kStep)
  {
    for (const double higher : { away, -away })
    {
      for (const double side : { parts.wantedSide, -parts.wantedSide })
      {
        parts.side = side;
        parts.higher = higher;
        parts.box = parts.boxAt(anchor, text);
        if (isFree(parts.box))
        {
          parts.place();
          return;
        }
      }
    }
  }
  parts.side = parts.wantedSide;
  parts.higher = 0.0;
  parts.box = parts.boxAt(anchor, text);
  parts.place();
}

void vtkHapticGauge::Show(const double anchor[3], double newtons)
{
  if (!std::isfinite(anchor[0] + anchor[1] + anchor[2]) || !std::isfinite(newtons))
  {
    return;
  }
  Internals& parts = *this->Parts;
  parts.part = std::min(1.0, std::abs(newtons) / this->MaximumForce);
  parts.place();
  for (pointhaptics::PixelBox* bar : { &parts.ground, &parts.fill, &parts.frame })
  {
    bar->actor()->GetPositionCoordinate()->SetValue(anchor[0], anchor[1], anchor[2]);
  }
  parts.anchor->SetValue(anchor[0], anchor[1], anchor[2]);
  char words[40];
  std::snprintf(words, sizeof(words), " %.2f N ", newtons);
  parts.number->SetInput(words);
  this->SetVisibility(true);
}

void vtkHapticGauge::SetLeft(bool left)
{
  this->Parts->wantedSide = left ? -1.0 : 1.0;
  this->Parts->side = this->Parts->wantedSide;
  this->Parts->place();
}

bool vtkHapticGauge::GetLeft() const
{
  return this->Parts->wantedSide < 0.0;
}

void vtkHapticGauge::SetVisibility(bool visible)
{
  for (vtkActor2D* actor : this->Parts->all())
  {
    actor->SetVisibility(visible);
  }
}

bool vtkHapticGauge::GetVisibility() const
{
  return this->Parts->number->GetVisibility() != 0;
}

void vtkHapticGauge::AddTo(vtkRenderer* renderer)
{
  for (vtkActor2D* actor : this->Parts->all())
  {
    renderer->AddActor2D(actor);
  }
  this->Parts->renderer = renderer;
  this->Parts->onStart.follow(renderer, vtkCommand::StartEvent, kLast);
}

void vtkHapticGauge::RemoveFrom(vtkRenderer* renderer)
{
  for (vtkActor2D* actor : this->Parts->all())
  {
    renderer->RemoveActor2D(actor);
  }
  this->Parts->onStart.follow(nullptr);
  this->Parts->renderer = nullptr;
}
