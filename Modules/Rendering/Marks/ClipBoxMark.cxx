#include "ClipBoxMark.h"

#include "EventLink.h"
#include "ScreenMarks.h"

#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <array>
#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr unsigned char kColor[3] = { 90, 200, 250 };
constexpr float kWidth = 1.5F;
constexpr float kHandleWidth = 3.0F;
constexpr float kRimWidth = 6.0F;
constexpr int kFaces = 6;
/// Size of a handle, and reach of its middle, in points: pixels at 72 dots per inch.
constexpr double kHandle = 6.0;
constexpr double kReach = 11.0;
/// Length of the probe along a handle, over the box: short enough to be in front of the camera.
constexpr double kProbe = 0.01;
/// Pixels that the whole box counts for where a face is seen from straight above.
constexpr double kPixelsOfBox = 300.0;
constexpr double kLeastPixels = 0.15; // of the probe

} // namespace

struct ClipBoxMark::Parts
{
  Bounds box;
  vtkNew<vtkMatrix4x4> model;
  int active = 1;
  bool isVisible = false;
  ScreenLines edges{ kWidth };
  ScreenLines rims{ kRimWidth };
  ScreenLines handles{ kHandleWidth };
  EventLink onStart{ [this]
    {
      if (this->isVisible)
      {
        this->draw();
      }
    } };
  vtkWeakPointer<vtkRenderer> renderer;

  double pixels() const { return pixelsPerPoint(this->renderer); }
  Vec3 inPicture(const Vec3& place) { return transformed(this->model, place); }
  Vec3 corner(int index) const
  {
    return { index & 1 ? this->box.maximum.x : this->box.minimum.x,
      index & 2 ? this->box.maximum.y : this->box.minimum.y,
      index & 4 ? this->box.maximum.z : this->box.minimum.z };
  }
  Vec3 middleOf(int face) const
  {
    Vec3 middle = this->box.center();
    middle[face / 2] = face % 2 == 0 ? this->box.minimum[face / 2] : this->box.maximum[face / 2];
    return middle;
  }
  void draw();
  void drawHandle(const Pixel& at, const unsigned char color[3]);
};

void ClipBoxMark::Parts::drawHandle(const Pixel& at, const unsigned char color[3])
{
  const double half = this->pixels() * kHandle;
  for (int side = 0; side < 4; ++side)
  {
    const double fromX = side == 0 || side == 3 ? -half : half;
    const double fromY = side < 2 ? -half : half;
    const double toX = side < 2 ? half : -half;
    const double toY = side == 1 || side == 2 ? half : -half;
    this->rims.add(at.x + fromX, at.y + fromY, at.x + toX, at.y + toY, kMarkRim);
    this->handles.add(at.x + fromX, at.y + fromY, at.x + toX, at.y + toY, color);
  }
}

void ClipBoxMark::Parts::draw()
{
  for (ScreenLines* lines : { &this->edges, &this->rims, &this->handles })
  {
    lines->clear();
  }
  const ScreenProjection project(this->renderer);
  for (int i = 0; i < 8; ++i)
  {
    for (const int bit : { 1, 2, 4 })
    {
      Vec3 a = this->inPicture(this->corner(i));
      Vec3 b = this->inPicture(this->corner(i | bit));
      if ((i & bit) == 0 && project.leaveSeenPart(a, b))
      {
        const Pixel from = project(a);
        const Pixel to = project(b);
        this->edges.add(from.x, from.y, to.x, to.y, kColor);
      }
    }
  }
  for (int face = 0; face < kFaces; ++face)
  {
    const Pixel at = project(this->inPicture(this->middleOf(face)));
    if (at.seen)
    {
      this->drawHandle(at, face == this->active ? kMarkColor : kColor);
    }
  }
  for (ScreenLines* lines : { &this->edges, &this->rims, &this->handles })
  {
    lines->finish();
  }
}

ClipBoxMark::ClipBoxMark()
  : parts_(std::make_unique<Parts>())
{
}

ClipBoxMark::~ClipBoxMark()
{
  if (vtkRenderer* renderer = parts_->renderer)
  {
    for (ScreenLines* lines : { &parts_->edges, &parts_->rims, &parts_->handles })
    {
      renderer->RemoveActor2D(lines->actor());
    }
  }
}

void ClipBoxMark::addTo(vtkRenderer* renderer)
{
  parts_->renderer = renderer;
  for (ScreenLines* lines : { &parts_->edges, &parts_->rims, &parts_->handles })
  {
    renderer->AddActor2D(lines->actor());
  }
  parts_->onStart.follow(renderer);
}

void ClipBoxMark::setBox(const Bounds& box)
{
  parts_->box = box;
}

void ClipBoxMark::setModel(vtkMatrix4x4* model)
{
  parts_->model->DeepCopy(model);
}

void ClipBoxMark::setActiveFace(int face)
{
  parts_->active = face;
}

int ClipBoxMark::activeFace() const
{
  return parts_->active;
}

void ClipBoxMark::setVisible(bool visible)
{
  parts_->isVisible = visible;
  for (ScreenLines* lines : { &parts_->edges, &parts_->rims, &parts_->handles })
  {
    lines->actor()->SetVisibility(visible);
  }
}

bool ClipBoxMark::isVisible() const
{
  return parts_->isVisible;
}

std::optional<int> ClipBoxMark::faceAt(double x, double y) const
{
  Parts& parts = *parts_;
  if (!parts.isVisible || !parts.renderer)
  {
    return std::nullopt;
  }
  const ScreenProjection project(parts.renderer, x);
  const std::array<double, 2> place = placeInPicture(parts.renderer, x, y);
  const int* corner = parts.renderer->GetOrigin(); // a chart may lie below
  std::optional<int> found;
  double nearest = parts.pixels() * kReach;
  for (int face = 0; face < kFaces; ++face)
  {
    const Pixel at = project(parts.inPicture(parts.middleOf(face)));
    const double distance = std::hypot(place[0] - corner[0] - at.x, place[1] - corner[1] - at.y);
    // Where two handles meet, the active one wins.
    if (at.seen && (distance < nearest || (distance == nearest && face == parts.active)))
    {
      nearest = distance;
      found = face;
    }
  }
  return found;
}

double ClipBoxMark::wayOf(int face, double pixelsRight, double pixelsUp) const
{
  Parts& parts = *parts_;
  const double extent = parts.box.extent()[face / 2];
  if (!parts.renderer || !(extent > 0.0))
  {
    return 0.0;
  }
  const ScreenProjection project(parts.renderer);
  Vec3 probe = parts.middleOf(face);
  const Pixel from = project(parts.inPicture(probe));
  probe[face / 2] += (face % 2 == 0 ? -kProbe : kProbe) * extent;
  const Pixel to = project(parts.inPicture(probe));
  const double right = to.x - from.x;
  const double up = to.y - from.y;
  const double length = std::hypot(right, up);
  const double parted = length < kLeastPixels || !from.seen || !to.seen
    ? pixelsUp / kPixelsOfBox
    : kProbe * (pixelsRight * right + pixelsUp * up) / (length * length);
  return parted * extent;
}

} // namespace pointhaptics
