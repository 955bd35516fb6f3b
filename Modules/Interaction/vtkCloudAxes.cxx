#include "vtkCloudAxes.h"

#include "Core/Vector3.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty.h"
#include "vtkProperty2D.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

using pointhaptics::Vec3;

namespace
{

constexpr int kTexts = 48;
/// Pixels.
constexpr double kTick = 6.0;
constexpr double kGap = 4.0;
constexpr double kLeastStep = 26.0;
constexpr double kShortestEdge = 40.0;
constexpr double kFarthest = 200.0;
constexpr double kArm = 34.0;
constexpr double kCorner = 58.0;
/// Estimates for the font, parts of its size.
constexpr double kLetterWidth = 0.62;
constexpr double kLetterHeight = 1.25;
/// Windows from this height on take the larger font.
constexpr int kTallWindow = 600;

constexpr unsigned char kAxisColors[3][3] = { { 190, 30, 30 }, { 15, 125, 30 }, { 30, 60, 190 } };

struct Pixel
{
  double x = 0.0;
  double y = 0.0;
  bool seen = false; // in front of the camera
};

struct Rectangle
{
  double left;
  double right;
  double bottom;
  double top;

  bool meets(const Rectangle& other) const
  {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
};

/// From coordinates of the picture to pixels of the viewport.
class Projection
{
public:
  explicit Projection(vtkRenderer* renderer)
  {
    matrix_->DeepCopy(renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
      renderer->GetTiledAspectRatio(), -1.0, 1.0));
    width_ = renderer->GetSize()[0];
    height_ = renderer->GetSize()[1];
  }
  Pixel operator()(const Vec3& p) const
  {
    const double in[4] = { p.x, p.y, p.z, 1.0 };
    double out[4];
    matrix_->MultiplyPoint(in, out);
    Pixel pixel;
    pixel.seen = out[3] > 0.0;
    const double w = pixel.seen ? out[3] : 1.0;
    pixel.x = 0.5 * (out[0] / w + 1.0) * width_;
    pixel.y = 0.5 * (out[1] / w + 1.0) * height_;
    return pixel;
  }

private:
  vtkNew<vtkMatrix4x4> matrix_;
  double width_ = 0.0;
  double height_ = 0.0;
};

/// 1, 2 or 5 times a power of ten, at least @p least.
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

/// Lines in pixels of the viewport, each of a colour.
struct Lines
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colors;
  vtkNew<vtkPolyData> shape;
  vtkNew<vtkPolyDataMapper2D> mapper;
  vtkNew<vtkActor2D> actor;

  explicit Lines(float width)
  {
    this->colors->SetNumberOfComponents(3);
    this->shape->SetPoints(this->points);
    this->shape->SetLines(this->cells);
    this->shape->GetCellData()->SetScalars(this->colors);
    this->mapper->SetInputData(this->shape);
    this->mapper->SetScalarModeToUseCellData();
    this->actor->SetMapper(this->mapper);
    this->actor->GetProperty()->SetLineWidth(width);
    this->actor->VisibilityOff();
  }
  void clear()
  {
    this->points->Reset();
    this->cells->Reset();
    this->colors->Reset();
  }
  void add(double x0, double y0, double x1, double y1, const unsigned char color[3])
  {
    const vtkIdType ends[2] = { this->points->InsertNextPoint(x0, y0, 0.0),
      this->points->InsertNextPoint(x1, y1, 0.0) };
    this->cells->InsertNextCell(2, ends);
    this->colors->InsertNextTypedTuple(color);
  }
  void finish()
  {
    this->points->Modified();
    this->cells->Modified();
    this->colors->Modified();
    this->shape->Modified();
  }
};

/// One edge of the box and how it lies in the picture.
struct Edge
{
  int axis = 0;
  Vec3 begin;
  Vec3 end;
  Pixel beginPixel;
  Pixel endPixel;
  double length = 0.0; // pixels
  double outX = 0.0;   // across the edge, away from the box
  double outY = 0.0;
};

} // namespace

struct vtkCloudAxes::Internals
{
  vtkNew<vtkMatrix4x4> model;
  vtkNew<vtkPoints> corners;
  vtkNew<vtkPolyData> box;
  vtkNew<vtkPolyDataMapper> boxMapper;
  vtkNew<vtkActor> boxActor;
  Lines ticks{ 1.0f };
  Lines marker{ 3.0f };
  std::array<vtkNew<vtkTextActor>, kTexts> texts;
  int used = 0;
  int fontSize = 13;
  std::vector<Rectangle> taken;
  vtkNew<vtkCallbackCommand> onStart;
  vtkWeakPointer<vtkRenderer> renderer;

  Vec3 corner(int index) const
  {
    Vec3 p;
    this->corners->GetPoint(index, &p.x);
    return p;
  }
  double widthOf(const std::string& words) const
  {
    return kLetterWidth * this->fontSize * double(words.size());
  }
  bool put(
    const std::string& words, double x, double y, double outX, double outY, const unsigned char color[3]);
  bool findEdge(const Projection& project, int axis, Edge& best) const;
  void label(const Projection& project, const Edge& edge, double low, double high);
  void drawMarker();
};

/// Text with its nearest corner or side at (@p x, @p y), on the side of the direction out. False: there is no
/// room.
bool vtkCloudAxes::Internals::put(
  const std::string& words, double x, double y, double outX, double outY, const unsigned char color[3])
{
  const double width = this->widthOf(words);
  const double height = kLetterHeight * this->fontSize;
  const int across = outX < -0.4 ? -1 : (outX > 0.4 ? 1 : 0);
  const int upward = outY < -0.4 ? -1 : (outY > 0.4 ? 1 : 0);
  const double left = x + 0.5 * (across - 1) * width;
  const double bottom = y + 0.5 * (upward - 1) * height;
  const Rectangle place{ left, left + width, bottom, bottom + height };
  const int* size = this->renderer->GetSize();
  const bool outside = place.left < 0.0 || place.right > size[0] || place.bottom < 0.0 || place.top > size[1];
  const auto meets = [&place](const Rectangle& other) { return place.meets(other); };
  if (this->used >= kTexts || outside || std::any_of(this->taken.begin(), this->taken.end(), meets))
  {
    return false;
  }
  this->taken.push_back(place);
  vtkTextActor* text = this->texts[std::size_t(this->used++)];
  vtkTextProperty* look = text->GetTextProperty();
  look->SetFontSize(this->fontSize);
  look->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
  look->SetJustification(across < 0 ? VTK_TEXT_RIGHT : (across > 0 ? VTK_TEXT_LEFT : VTK_TEXT_CENTERED));
  look->SetVerticalJustification(
    upward < 0 ? VTK_TEXT_TOP : (upward > 0 ? VTK_TEXT_BOTTOM : VTK_TEXT_CENTERED));
  text->SetInput(words.c_str());
  text->SetPosition(std::round(x), std::round(y));
  text->VisibilityOn();
  return true;
}

/// Of the edges along @p axis that lie at the outline of the picture, the one farthest down and to the left.
/// False: none is long enough to be read.
bool vtkCloudAxes::Internals::findEdge(const Projection& project, int axis, Edge& best) const
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
    if (edge.length < kShortestEdge)
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

/// Ticks with numbers from @p low to @p high, metres, along @p edge, and the bounds beside its middle.
void vtkCloudAxes::Internals::label(const Projection& project, const Edge& edge, double low, double high)
{
  static const unsigned char dark[3] = { 40, 40, 45 };
  const double range = high - low;
  double step = niceStep(range * kLeastStep / edge.length);
  // Numbers beside each other need their width.
  const double along = std::abs(edge.endPixel.x - edge.beginPixel.x) / edge.length;
  const auto longest = [&](double each)
  {
    const int decimals = decimalsFor(each);
    return std::max(this->widthOf(numberText(low, decimals)), this->widthOf(numberText(high, decimals)));
  };
  while (step < range && step / range * edge.length < kLeastStep + 1.2 * along * longest(step))
  {
    step = niceStep(1.01 * step);
  }
  const int decimals = decimalsFor(step);
  const double first = std::ceil(low / step - 1e-6);
  const double last = std::floor(high / step + 1e-6);
  for (double i = first; i <= last && i - first < kTexts; ++i)
  {
    const double part = std::clamp((i * step - low) / range, 0.0, 1.0);
    const Pixel p = project(edge.begin + part * (edge.end - edge.begin));
    this->ticks.add(p.x, p.y, p.x + kTick * edge.outX, p.y + kTick * edge.outY, dark);
    this->put(numberText(i * step, decimals), p.x + (kTick + kGap) * edge.outX,
      p.y + (kTick + kGap) * edge.outY, edge.outX, edge.outY, dark);
  }
  const std::string bounds = std::string(1, "xyz"[edge.axis]) + "  " + numberText(low, decimals + 1) +
    " to " + numberText(high, decimals + 1) + " m";
  const Pixel middle = project(0.5 * (edge.begin + edge.end));
  // Farther out until the numbers leave room; where the picture ends before that, the letter must do.
  for (const std::string& words : { bounds, bounds.substr(0, 1) })
  {
    for (double away = kTick + 2.0 * kGap; away < kFarthest; away += kGap)
    {
      if (this->put(words, middle.x + away * edge.outX, middle.y + away * edge.outY, edge.outX, edge.outY,
            kAxisColors[edge.axis]))
      {
        return;
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
  const double x = this->renderer->GetSize()[0] - kCorner;
  const double y = kCorner;
  for (int axis : order)
  {
    const double toX = dot(axes[std::size_t(axis)], right);
    const double toY = dot(axes[std::size_t(axis)], up);
    this->marker.add(x, y, x + kArm * toX, y + kArm * toY, kAxisColors[axis]);
    this->put(std::string(1, "xyz"[axis]), x + (kArm + 9.0) * toX, y + (kArm + 9.0) * toY, 0.0, 0.0,
      kAxisColors[axis]);
  }
}

vtkStandardNewMacro(vtkCloudAxes);

vtkCloudAxes::vtkCloudAxes()
  : Parts(new Internals)
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
  parts.boxMapper->SetInputData(parts.box);
  parts.boxActor->SetMapper(parts.boxMapper);
  parts.boxActor->GetProperty()->SetColor(0.35, 0.35, 0.40);
  parts.boxActor->GetProperty()->LightingOff();
  parts.boxActor->PickableOff();
  parts.boxActor->VisibilityOff();
  for (auto& text : parts.texts)
  {
    text->PickableOff();
    text->GetTextProperty()->SetBackgroundColor(0.93, 0.94, 0.95);
    text->GetTextProperty()->SetBackgroundOpacity(0.6);
    text->VisibilityOff();
  }
  parts.onStart->SetClientData(this);
  parts.onStart->SetCallback(
    [](vtkObject*, unsigned long, void* self, void*) { static_cast<vtkCloudAxes*>(self)->PlaceLabels(); });
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

void vtkCloudAxes::SetVisibility(bool visible)
{
  Internals& parts = *this->Parts;
  this->Visibility = visible;
  parts.boxActor->SetVisibility(visible);
  parts.ticks.actor->SetVisibility(visible);
  parts.marker.actor->SetVisibility(visible);
  for (auto& text : parts.texts)
  {
    text->VisibilityOff(); // until the next render places it
  }
  this->Modified();
}

/// Corner i has the larger bound of axis a where bit a of i is set. In doubles from the cloud to the picture:
/// coordinates of a map have no digits to lose.
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
  parts.taken.clear();
  parts.used = 0;
  parts.fontSize = parts.renderer->GetSize()[1] < kTallWindow ? 12 : 14;
  const Projection project(parts.renderer);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = this->MetresPerUnit * this->Bounds[2 * axis];
    const double high = this->MetresPerUnit * this->Bounds[2 * axis + 1];
    Edge edge;
    if (high > low && std::isfinite(high - low) && parts.findEdge(project, axis, edge))
    {
      parts.label(project, edge, low, high);
    }
  }
  parts.drawMarker();
  for (int i = parts.used; i < kTexts; ++i)
  {
    parts.texts[std::size_t(i)]->VisibilityOff();
  }
  parts.ticks.finish();
  parts.marker.finish();
}

void vtkCloudAxes::AddTo(vtkRenderer* renderer)
{
  Internals& parts = *this->Parts;
  parts.renderer = renderer;
  renderer->AddActor(parts.boxActor);
  renderer->AddActor2D(parts.ticks.actor);
  renderer->AddActor2D(parts.marker.actor);
  for (auto& text : parts.texts)
  {
    renderer->AddActor2D(text);
  }
  renderer->AddObserver(vtkCommand::StartEvent, parts.onStart);
}

void vtkCloudAxes::RemoveFrom(vtkRenderer* renderer)
{
  Internals& parts = *this->Parts;
  renderer->RemoveObserver(parts.onStart);
  renderer->RemoveActor(parts.boxActor);
  renderer->RemoveActor2D(parts.ticks.actor);
  renderer->RemoveActor2D(parts.marker.actor);
  for (auto& text : parts.texts)
  {
    renderer->RemoveActor2D(text);
  }
  parts.renderer = nullptr;
}

void vtkCloudAxes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Bounds: " << this->Bounds[0] << ", " << this->Bounds[1] << ", " << this->Bounds[2] << ", "
     << this->Bounds[3] << ", " << this->Bounds[4] << ", " << this->Bounds[5] << "\n";
  os << indent << "MetresPerUnit: " << this->MetresPerUnit << "\n";
  os << indent << "Visibility: " << this->Visibility << "\n";
}
