#include "vtkCloudAxes.h"

#include "EventLink.h"
#include "ScreenMarks.h"
#include "vtkOverlayActor.h"

#include "Core/Base/Vector3.h"

#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkProperty2D.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

using pointhaptics::EventLink;
using pointhaptics::Pixel;
using pointhaptics::ScreenLines;
using pointhaptics::ScreenProjection;
using pointhaptics::ScreenTexts;
using pointhaptics::Vec3;

namespace
{

/// Lengths in points.
constexpr double kTick = 6.0;
constexpr double kGap = 4.0;
constexpr double kLeastStep = 26.0;
constexpr double kShortestEdge = 40.0;
constexpr double kFarthest = 200.0;
constexpr double kArm = 34.0;
constexpr double kCorner = 58.0;
/// Priority after ScreenLayout, which knows the taken places.
constexpr float kLast = -2.0F;
/// Widths in points.
constexpr float kTickWidth = 1.0F;
constexpr float kArmWidth = 3.0F;
/// Windows from this height on take the larger font.
constexpr int kTallWindow = 600;

constexpr unsigned char kAxisColors[3][3] = { { 190, 30, 30 }, { 15, 125, 30 }, { 30, 60, 190 } };

/// Returns 1, 2 or 5 times a power of ten, at least @p least.
double niceStep(double least)
{
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (double factor : { 1.0, 2.0, 5.0 })
  {
    if (factor * power >= least)
    {
      return factor * power;
    }
  }
  return 10.0 * power;
}

int decimalsFor(double step)
{
  return std::clamp(int(std::ceil(-std::log10(step) - 1e-9)), 0, 12);
}

std::string numberText(double value, int decimals)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  const bool isZero = std::strspn(text, "-0.") == std::strlen(text);
  return isZero && text[0] == '-' ? text + 1 : text;
}

/// One edge of the box and its line in the picture.
struct Edge
{
  int axis = 0;
  Vec3 begin;
  Vec3 end;
  Pixel beginPixel;
  Pixel endPixel;
  Pixel seenBegin; // ends of what lies in the picture
  Pixel seenEnd;
  double length = 0.0; // pixels
  double outX = 0.0;   // across the edge, away from the box
  double outY = 0.0;
};

Pixel between(const Pixel& a, const Pixel& b, double part)
{
  return { a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), true };
}

/// Finds the part of @p edge in a picture of @p size. False: it is too short to be read.
bool findSeenPart(Edge& edge, const int* size)
{
  const Pixel& a = edge.beginPixel;
  const Pixel& b = edge.endPixel;
  double from = 0.0;
  double to = 1.0;
  const auto cut = [&](double begin, double end, double most)
  {
    const double way = end - begin;
    const double first = way != 0.0 ? -begin / way : (begin >= 0.0 ? -INFINITY : INFINITY);
    const double last = way != 0.0 ? (most - begin) / way : (begin <= most ? INFINITY : -INFINITY);
    from = std::max(from, std::min(first, last));
    to = std::min(to, std::max(first, last));
  };
  cut(a.x, b.x, size[0]);
  cut(a.y, b.y, size[1]);
  edge.seenBegin = between(a, b, from);
  edge.seenEnd = between(a, b, to);
  return (to - from) * edge.length >= kShortestEdge;
}

} // namespace

struct vtkCloudAxes::Internals
{
  explicit Internals(vtkCloudAxes* self)
    : onStart([self] { self->PlaceLabels(); })
  {
  }
  vtkNew<vtkMatrix4x4> model;
  vtkNew<vtkPoints> corners;
  vtkNew<vtkPolyData> box;
  vtkNew<vtkOverlayActor> boxLines;
  ScreenLines ticks{ kTickWidth };
  ScreenLines marker{ kArmWidth };
  ScreenTexts texts;
  EventLink onStart;
  vtkWeakPointer<vtkRenderer> renderer;
  std::function<std::vector<std::array<double, 4>>()> taken;

  Vec3 corner(int index) const
  {
    Vec3 p;
    this->corners->GetPoint(index, &p.x);
    return p;
  }
  bool findEdge(const ScreenProjection& project, int axis, Edge& best) const;
  void label(
    const ScreenProjection& project, const Edge& edge, double low, double high, const std::string& unit);
  void drawMarker();
};

/// Finds, among the edges along @p axis at the outline of the picture, the one farthest down and to the left.
/// False: none is long enough to be read.
bool vtkCloudAxes::Internals::findEdge(const ScreenProjection& project, int axis, Edge& best) const
{
  std::array<Pixel, 8> pixels;
  Pixel middle;
  for (int i = 0; i < 8; ++i)
  {
    pixels[std::size_t(i)] = project(this->corner(i));
    if (!pixels[std::size_t(i)].seen)
    {
      return false;
    }
    middle.x += pixels[std::size_t(i)].x / 8.0;
    middle.y += pixels[std::size_t(i)].y / 8.0;
  }
  double lowest = INFINITY;
  for (int i = 0; i < 8; ++i)
  {
    if ((i >> axis) & 1)
    {
      continue;
    }
    const Pixel& a = pixels[std::size_t(i)];
    const Pixel& b = pixels[std::size_t(i | (1 << axis))];
    Edge edge;
    edge.axis = axis;
    edge.begin = this->corner(i);
    edge.end = this->corner(i | (1 << axis));
    edge.beginPixel = a;
    edge.endPixel = b;
    edge.length = std::hypot(b.x - a.x, b.y - a.y);
    if (!findSeenPart(edge, this->renderer->GetSize()))
    {
      continue;
    }
    edge.outX = -(b.y - a.y) / edge.length;
    edge.outY = (b.x - a.x) / edge.length;
    if (edge.outX * (a.x - middle.x) + edge.outY * (a.y - middle.y) < 0.0)
    {
      edge.outX = -edge.outX;
      edge.outY = -edge.outY;
    }
    const auto inside = [&](const Pixel& p)
    { return edge.outX * (p.x - a.x) + edge.outY * (p.y - a.y) < 0.5; };
    const double down = 0.5 * (a.x + b.x) + 2.0 * (a.y + b.y);
    if (std::all_of(pixels.begin(), pixels.end(), inside) && down < lowest)
    {
      lowest = down;
      best = edge;
    }
  }
  return std::isfinite(lowest);
}

/// Draws ticks with numbers from @p low to @p high along @p edge, and the bounds beside its middle.
void vtkCloudAxes::Internals::label(
  const ScreenProjection& project, const Edge& edge, double low, double high, const std::string& unit)
{
  static const unsigned char dark[3] = { 40, 40, 45 };
  static const unsigned char grey[3] = { 135, 138, 145 }; // seen on dark and light grounds
  const double range = high - low;
  const double pixels = this->texts.pixelsPerPoint();
  const double least = pixels * kLeastStep;
  double step = niceStep(range * least / edge.length);
  // Numbers beside each other need their width.
  const double along = std::abs(edge.endPixel.x - edge.beginPixel.x) / edge.length;
  const auto longest = [&](double each)
  {
    const int decimals = decimalsFor(each);
    return std::max(
      this->texts.widthOf(numberText(low, decimals)), this->texts.widthOf(numberText(high, decimals)));
  };
  while (step < range && step / range * edge.length < least + 1.2 * along * longest(step))
  {
    step = niceStep(1.01 * step);
  }
  const int decimals = decimalsFor(step);
  const double first = std::ceil(low / step - 1e-6);
  const double last = std::floor(high / step + 1e-6);
  for (double i = first; i <= last && i - first < ScreenTexts::kMost; ++i)
  {
    const double part = std::clamp((i * step - low) / range, 0.0, 1.0);
    const Pixel p = project(edge.begin + part * (edge.end - edge.begin));
    this->ticks.add(p.x, p.y, p.x + pixels * kTick * edge.outX, p.y + pixels * kTick * edge.outY, grey);
    this->texts.put(numberText(i * step, decimals), p.x + pixels * (kTick + kGap) * edge.outX,
      p.y + pixels * (kTick + kGap) * edge.outY, edge.outX, edge.outY, dark);
  }
  const int finer = decimalsFor(0.1 * step);
  const std::string bounds = std::string(1, "xyz"[edge.axis]) + "  " + numberText(low, finer) + " to " +
    numberText(high, finer) + " " + unit;
  // The bounds go farther out until the numbers leave room, along the edge where the picture ends before
  // that, and over the box where there is none beside it.
  for (const double side : { 1.0, -1.0 })
  {
    for (const double part : { 0.5, 0.3, 0.7, 0.1, 0.9 })
    {
      const Pixel place = between(edge.seenBegin, edge.seenEnd, part);
      for (double away = pixels * (kTick + 2.0 * kGap); away < pixels * kFarthest; away += pixels * kGap)
      {
        if (this->texts.put(bounds, place.x + side * away * edge.outX, place.y + side * away * edge.outY,
              side * edge.outX, side * edge.outY, kAxisColors[edge.axis]))
        {
          return;
        }
      }
    }
  }
}

void vtkCloudAxes::Internals::drawMarker()
{
  vtkCamera* camera = this->renderer->GetActiveCamera();
  Vec3 forward;
  Vec3 up;
  camera->GetDirectionOfProjection(&forward.x);
  camera->GetViewUp(&up.x);
  const Vec3 right = normalized(cross(forward, up));
  up = cross(right, forward);
  std::array<int, 3> order = { 0, 1, 2 };
  std::array<Vec3, 3> axes;
  for (int axis = 0; axis < 3; ++axis)
  {
    axes[std::size_t(axis)] = normalized(Vec3{
      this->model->GetElement(0, axis), this->model->GetElement(1, axis), this->model->GetElement(2, axis) });
  }
  std::sort(order.begin(), order.end(),
    [&](int a, int b) { return dot(axes[std::size_t(a)], forward) > dot(axes[std::size_t(b)], forward); });
  const double pixels = this->texts.pixelsPerPoint();
  const double x = this->renderer->GetSize()[0] - pixels * kCorner;
  const double y = pixels * kCorner;
  for (int axis : order)
  {
    const double toX = dot(axes[std::size_t(axis)], right);
    const double toY = dot(axes[std::size_t(axis)], up);
    const double arm = pixels * kArm;
    const double letter = pixels * (kArm + 9.0);
    this->marker.add(x, y, x + arm * toX, y + arm * toY, kAxisColors[axis]);
    this->texts.put(
      std::string(1, "xyz"[axis]), x + letter * toX, y + letter * toY, 0.0, 0.0, kAxisColors[axis]);
  }
}

vtkStandardNewMacro(vtkCloudAxes);

vtkCloudAxes::vtkCloudAxes()
  : Parts(new Internals(this))
{
  Internals& parts = *this->Parts;
  parts.corners->SetDataTypeToDouble();
  parts.corners->SetNumberOfPoints(8);
  vtkNew<vtkCellArray> edges;
  for (vtkIdType i = 0; i < 8; ++i)
  {
    for (vtkIdType bit : { 1, 2, 4 })
    {
      if (!(i & bit))
      {
        const vtkIdType ends[2] = { i, i | bit };
        edges->InsertNextCell(2, ends);
      }
    }
  }
  parts.box->SetPoints(parts.corners);
  parts.box->SetLines(edges);
  parts.boxLines->SetShape(parts.box);
  parts.boxLines->GetProperty()->SetColor(0.35, 0.35, 0.40);
  parts.boxLines->VisibilityOff();
  this->PlaceBox();
}

vtkCloudAxes::~vtkCloudAxes()
{
  if (this->Parts->renderer)
  {
    this->RemoveFrom(this->Parts->renderer);
  }
}

void vtkCloudAxes::SetBounds(const double bounds[6])
{
  if (!std::equal(bounds, bounds + 6, this->Bounds))
  {
    std::copy(bounds, bounds + 6, this->Bounds);
    this->PlaceBox();
    this->Modified();
  }
}

void vtkCloudAxes::SetUnitName(const std::string& name)
{
  if (name != this->UnitName)
  {
    this->UnitName = name;
    this->Modified();
  }
}

void vtkCloudAxes::SetModelMatrix(vtkMatrix4x4* matrix)
{
  vtkMatrix4x4* model = this->Parts->model;
  if (!std::equal(matrix->GetData(), matrix->GetData() + 16, model->GetData()))
  {
    model->DeepCopy(matrix);
    this->PlaceBox();
    this->Modified();
  }
}

void vtkCloudAxes::SetTaken(std::function<std::vector<std::array<double, 4>>()> taken)
{
  this->Parts->taken = std::move(taken);
}

void vtkCloudAxes::SetVisibility(bool visible)
{
  Internals& parts = *this->Parts;
  this->Visibility = visible;
  parts.boxLines->SetVisibility(visible);
  parts.ticks.actor()->SetVisibility(visible);
  parts.marker.actor()->SetVisibility(visible);
  parts.texts.hide(); // until the next render places them
  this->Modified();
}

/// Places the box. Corner i has the larger bound of axis a where bit a of i is set. All is in doubles from
/// the cloud to the picture, as coordinates of a map have no digits to lose.
void vtkCloudAxes::PlaceBox()
{
  Internals& parts = *this->Parts;
  for (int i = 0; i < 8; ++i)
  {
    const double in[4] = { this->Bounds[i & 1], this->Bounds[2 + ((i >> 1) & 1)],
      this->Bounds[4 + ((i >> 2) & 1)], 1.0 };
    double out[4];
    parts.model->MultiplyPoint(in, out);
    parts.corners->SetPoint(i, out);
  }
  parts.corners->Modified();
  parts.box->Modified();
}

void vtkCloudAxes::PlaceLabels()
{
  Internals& parts = *this->Parts;
  if (!this->Visibility || !parts.renderer)
  {
    return;
  }
  parts.ticks.clear();
  parts.marker.clear();
  parts.texts.clear(parts.renderer, parts.renderer->GetSize()[1] < kTallWindow ? 12 : 14);
  for (const std::array<double, 4>& place :
    parts.taken ? parts.taken() : std::vector<std::array<double, 4>>())
  {
    parts.texts.take(place);
  }
  const double pixels = parts.texts.pixelsPerPoint();
  parts.ticks.actor()->GetProperty()->SetLineWidth(float(kTickWidth * pixels));
  parts.marker.actor()->GetProperty()->SetLineWidth(float(kArmWidth * pixels));
  const ScreenProjection project(parts.renderer);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = this->Bounds[2 * axis];
    const double high = this->Bounds[2 * axis + 1];
    Edge edge;
    if (high > low && std::isfinite(high - low) && parts.findEdge(project, axis, edge))
    {
      parts.label(project, edge, low, high, this->UnitName);
    }
  }
  parts.drawMarker();
  parts.texts.finish();
  parts.ticks.finish();
  parts.marker.finish();
}

void vtkCloudAxes::AddTo(vtkRenderer* renderer)
{
  Internals& parts = *this->Parts;
  parts.renderer = renderer;
  renderer->AddActor(parts.boxLines);
  renderer->AddActor2D(parts.ticks.actor());
  renderer->AddActor2D(parts.marker.actor());
  parts.texts.addTo(renderer);
  parts.onStart.follow(renderer, vtkCommand::StartEvent, kLast);
}

void vtkCloudAxes::RemoveFrom(vtkRenderer* renderer)
{
  Internals& parts = *this->Parts;
  parts.onStart.follow(nullptr);
  renderer->RemoveActor(parts.boxLines);
  renderer->RemoveActor2D(parts.ticks.actor());
  renderer->RemoveActor2D(parts.marker.actor());
  parts.texts.removeFrom(renderer);
  parts.renderer = nullptr;
}

void vtkCloudAxes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Bounds: " << this->Bounds[0] << ", " << this->Bounds[1] << ", " << this->Bounds[2] << ", "
     << this->Bounds[3] << ", " << this->Bounds[4] << ", " << this->Bounds[5] << "\n";
  os << indent << "UnitName: " << this->UnitName << "\n";
  os << indent << "Visibility: " << this->Visibility << "\n";
}
