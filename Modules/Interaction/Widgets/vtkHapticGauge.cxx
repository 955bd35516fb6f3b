#include "vtkHapticGauge.h"

#include "ScreenMarks.h"

#include "vtkObjectFactory.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextProperty.h"

#include <fmt/format.h>

#include <algorithm>

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
constexpr double kFullForce = 8.0; // newtons of the full bar
/// Step of the search for a free place, points.
constexpr double kStep = 12.0;
/// After ScreenLayout, which says what is taken.
constexpr float kBehindOthers = -2.0F;

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

vtkStandardNewMacro(vtkHapticGauge);

vtkHapticGauge::vtkHapticGauge()
  : Ground(true, 1.0, 1.0, 1.0, kBarGround)
{
  for (vtkActor2D* bar : { this->Ground.actor(), this->Fill.actor(), this->Frame.actor() })
  {
    bar->GetPositionCoordinate()->SetCoordinateSystemToWorld();
  }
  this->Anchor->SetCoordinateSystemToWorld();
  vtkTextProperty* text = this->Number->GetTextProperty();
  text->SetFontSize(15);
  text->SetBold(true);
  text->SetColor(0.08, 0.08, 0.10);
  text->SetBackgroundColor(1.0, 1.0, 1.0);
  text->SetBackgroundOpacity(kNumberGround);
  text->SetVerticalJustificationToCentered();
  this->Number->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  this->Number->GetPositionCoordinate()->SetReferenceCoordinate(this->Anchor);
  this->Number->VisibilityOff();
  this->Place();
}

vtkHapticGauge::~vtkHapticGauge() = default;

void vtkHapticGauge::Place()
{
  const double near = this->Side * this->Pixels * kAside;
  const double far = this->Side * this->Pixels * (kAside + kWidth);
  const double height = this->Pixels * kHeight;
  const double bottom = this->Higher - 0.5 * height;
  this->Ground.place(near, far, bottom, bottom + height);
  this->Frame.place(near, far, bottom, bottom + height);
  this->Fill.place(near, far, bottom, bottom + this->Part * height);
  this->Number->SetPosition(this->Side * this->Pixels * kTextAside, this->Higher);
  vtkTextProperty* text = this->Number->GetTextProperty();
  this->Side > 0.0 ? text->SetJustificationToLeft() : text->SetJustificationToRight();
}

void vtkHapticGauge::SetOpaque(bool opaque)
{
  this->Ground.actor()->GetProperty()->SetOpacity(opaque ? 1.0 : kBarGround);
  this->Number->GetTextProperty()->SetBackgroundOpacity(opaque ? 1.0 : kNumberGround);
}

void vtkHapticGauge::KeepOffLine(const double begin[3], const double end[3])
{
  this->LineBegin = { begin[0], begin[1], begin[2] };
  this->LineEnd = { end[0], end[1], end[2] };
}

/// Takes a side, and finds the box there; @p at is the anchor.
void vtkHapticGauge::Try(double side, double higher, const pointhaptics::Pixel& at)
{
  double text[2];
  this->Number->GetSize(this->Renderer, text);
  const double near = at.x + side * this->Pixels * kAside;
  const double far = at.x + side * (this->Pixels * kTextAside + text[0]);
  const double half = 0.5 * std::max(this->Pixels * kHeight, text[1]);
  const double middle = at.y + higher;
  this->Side = side;
  this->Higher = higher;
  this->Box = { std::min(near, far), middle - half, std::max(near, far), middle + half };
}

/// Beside the anchor, or at the nearest place on either side that is in the picture and free.
void vtkHapticGauge::Arrange()
{
  vtkRenderer* renderer = this->Renderer;
  if (!renderer || !renderer->GetRenderWindow() || !this->GetVisibility())
  {
    return;
  }
  this->Pixels = pointhaptics::pixelsPerPoint(renderer);
  const double* point = this->Anchor->GetValue();
  const pointhaptics::ScreenProjection project(renderer);
  const pointhaptics::Pixel anchor = project({ point[0], point[1], point[2] });
  pointhaptics::Vec3 begin = this->LineBegin;
  pointhaptics::Vec3 end = this->LineEnd;
  const bool hasLine = begin != end && project.leaveSeenPart(begin, end);
  const double beside = this->Pixels * kBesideLine;
  const int* size = renderer->GetSize();
  const std::vector<std::array<double, 4>> taken =
    this->Taken ? this->Taken() : std::vector<std::array<double, 4>>();
  const auto isFree = [&](const std::array<double, 4>& box)
  {
    const std::array<double, 4> wide = { box[0] - beside, box[1] - beside, box[2] + beside, box[3] + beside };
    return !(hasLine && meets(project(begin), project(end), wide)) && box[0] >= 0.0 && box[1] >= 0.0 &&
      box[2] <= size[0] && box[3] <= size[1] &&
      std::none_of(taken.begin(), taken.end(), [&](const auto& other) { return meet(box, other); });
  };
  bool found = false;
  for (double away = 0.0; away < size[1] && !found; away += this->Pixels * kStep)
  {
    for (int i = 0; i < 4 && !found; ++i)
    {
      this->Try(i % 2 == 0 ? this->WantedSide : -this->WantedSide, i < 2 ? away : -away, anchor);
      found = isFree(this->Box);
    }
  }
  if (!found)
  {
    this->Try(this->WantedSide, 0.0, anchor);
  }
  this->Place();
}

void vtkHapticGauge::Show(const double anchor[3], double newtons)
{
  this->Part = std::min(1.0, newtons / kFullForce);
  this->Place();
  for (vtkActor2D* bar : { this->Ground.actor(), this->Fill.actor(), this->Frame.actor() })
  {
    bar->GetPositionCoordinate()->SetValue(anchor[0], anchor[1], anchor[2]);
  }
  this->Anchor->SetValue(anchor[0], anchor[1], anchor[2]);
  this->Number->SetInput(fmt::format(" {:.2f} N ", newtons).c_str());
  this->SetVisibility(true);
}

void vtkHapticGauge::SetLeft(bool left)
{
  this->WantedSide = left ? -1.0 : 1.0;
  this->Side = this->WantedSide;
  this->Place();
}

void vtkHapticGauge::SetVisibility(bool visible)
{
  for (vtkActor2D* actor : this->All())
  {
    actor->SetVisibility(visible);
  }
}

void vtkHapticGauge::AddTo(vtkRenderer* renderer)
{
  for (vtkActor2D* actor : this->All())
  {
    renderer->AddActor2D(actor);
  }
  this->Renderer = renderer;
  this->OnStart.follow(renderer, vtkCommand::StartEvent, kBehindOthers);
}

void vtkHapticGauge::RemoveFrom(vtkRenderer* renderer)
{
  for (vtkActor2D* actor : this->All())
  {
    renderer->RemoveActor2D(actor);
  }
  this->OnStart.follow(nullptr);
  this->Renderer = nullptr;
}
