#include "ClipBoxMark.h"

#include "vtkRenderer.h"

#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr unsigned char kColor[3] = { 90, 200, 250 };
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

ClipBoxMark::~ClipBoxMark()
{
  for (ScreenLines* lines : this->all())
  {
    if (renderer_)
    {
      renderer_->RemoveActor2D(lines->actor());
    }
  }
}

/// A corner of the box in the picture.
Vec3 ClipBoxMark::corner(int index) const
{
  return transformed(model_,
    { index & 1 ? box_.maximum.x : box_.minimum.x, index & 2 ? box_.maximum.y : box_.minimum.y,
      index & 4 ? box_.maximum.z : box_.minimum.z });
}

/// The middle of a face, in the frame of the cloud.
Vec3 ClipBoxMark::middleOf(int face) const
{
  Vec3 middle = box_.center();
  middle[face / 2] = face % 2 == 0 ? box_.minimum[face / 2] : box_.maximum[face / 2];
  return middle;
}

void ClipBoxMark::drawHandle(const Pixel& at, const unsigned char color[3])
{
  const double half = pixelsPerPoint(renderer_) * kHandle;
  for (int side = 0; side < 4; ++side)
  {
    const double fromX = side == 0 || side == 3 ? -half : half;
    const double fromY = side < 2 ? -half : half;
    const double toX = side < 2 ? half : -half;
    const double toY = side == 1 || side == 2 ? half : -half;
    rims_.add(at.x + fromX, at.y + fromY, at.x + toX, at.y + toY, kMarkRim);
    handles_.add(at.x + fromX, at.y + fromY, at.x + toX, at.y + toY, color);
  }
}

void ClipBoxMark::draw()
{
  if (!isVisible_)
  {
    return;
  }
  for (ScreenLines* lines : this->all())
  {
    lines->clear();
  }
  const ScreenProjection project(renderer_);
  for (int i = 0; i < 8; ++i)
  {
    for (const int bit : { 1, 2, 4 })
    {
      Vec3 a = this->corner(i);
      Vec3 b = this->corner(i | bit);
      if ((i & bit) == 0 && project.leaveSeenPart(a, b))
      {
        const Pixel from = project(a);
        const Pixel to = project(b);
        edges_.add(from.x, from.y, to.x, to.y, kColor);
      }
    }
  }
  for (int face = 0; face < kFaces; ++face)
  {
    const Pixel at = project(transformed(model_, this->middleOf(face)));
    if (at.seen)
    {
      this->drawHandle(at, face == active_ ? kMarkColor : kColor);
    }
  }
  for (ScreenLines* lines : this->all())
  {
    lines->finish();
  }
}

void ClipBoxMark::addTo(vtkRenderer* renderer)
{
  renderer_ = renderer;
  for (ScreenLines* lines : this->all())
  {
    renderer->AddActor2D(lines->actor());
  }
  onStart_.follow(renderer);
}

void ClipBoxMark::setVisible(bool visible)
{
  isVisible_ = visible;
  for (ScreenLines* lines : this->all())
  {
    lines->actor()->SetVisibility(visible);
  }
}

std::optional<int> ClipBoxMark::faceAt(double x, double y) const
{
  if (!isVisible_ || !renderer_)
  {
    return std::nullopt;
  }
  const ScreenProjection project(renderer_, x);
  const std::array<double, 2> place = placeInPicture(renderer_, x, y);
  const int* corner = renderer_->GetOrigin(); // a chart may lie below
  std::optional<int> found;
  double nearest = pixelsPerPoint(renderer_) * kReach;
  for (int face = 0; face < kFaces; ++face)
  {
    const Pixel at = project(transformed(model_, this->middleOf(face)));
    const double distance = std::hypot(place[0] - corner[0] - at.x, place[1] - corner[1] - at.y);
    // Where two handles meet, the active one wins.
    if (at.seen && (distance < nearest || (distance == nearest && face == active_)))
    {
      nearest = distance;
      found = face;
    }
  }
  return found;
}

double ClipBoxMark::wayOf(int face, double pixelsRight, double pixelsUp) const
{
  const double extent = box_.extent()[face / 2];
  if (!renderer_ || !(extent > 0.0))
  {
    return 0.0;
  }
  const ScreenProjection project(renderer_);
  Vec3 probe = this->middleOf(face);
  const Pixel from = project(transformed(model_, probe));
  probe[face / 2] += (face % 2 == 0 ? -kProbe : kProbe) * extent;
  const Pixel to = project(transformed(model_, probe));
  const double right = to.x - from.x;
  const double up = to.y - from.y;
  const double length = std::hypot(right, up);
  const double parted = length < kLeastPixels || !from.seen || !to.seen
    ? pixelsUp / kPixelsOfBox
    : kProbe * (pixelsRight * right + pixelsUp * up) / (length * length);
  return parted * extent;
}

} // namespace pointhaptics
