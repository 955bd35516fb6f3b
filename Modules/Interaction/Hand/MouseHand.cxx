#include "MouseHand.h"

#include "ModelTransform.h"
#include "ScreenView.h"
#include "SteadyTime.h"
#include "XLibrary.h"

#include "Haptics/Proxy.h"

#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointhaptics
{
namespace
{

/// A key that is pressed again within this time was held all along.
constexpr double kKeyRepeatSeconds = 0.05;
/// Height above the surface at which the hand hovers, edges of the workspace.
constexpr double kHoverHeight = 0.01;
/// A pointer nearer to the hand than this, pixels, takes hold of it.
constexpr double kReachOfHand = 20.0;
/// Cosine between view and normal below which a plane is seen too flatly to say how deep the pointer is.
constexpr double kFlattestView = 0.2;
/// Longest way, metres, from the last contact to where a lost surface goes on; beyond it the hand has left.
constexpr double kFarthestJump = 0.01;
/// A pointer nearer to the hand than this, pixels, stays where it is.
constexpr double kPointerSlack = 1.0;

} // namespace

Vec3 MouseHand::inWorkspace(Vec3 place) const
{
  const Bounds box = model_.workspace();
  for (int axis = 0; axis < 3; ++axis)
  {
    place[axis] = std::min(std::max(place[axis], box.minimum[axis]), box.maximum[axis]);
  }
  return place;
}

void MouseHand::move(const Vec3& offset)
{
  if (device_ && isFinite(offset))
  {
    device_->setTarget(this->inWorkspace(this->pressed(device_->target() + offset)));
  }
}

void MouseHand::moveInDepth(double metres)
{
  press_ = 0.0;
  if (screen_.renderer())
  {
    this->move(metres * screen_.forward());
  }
}

void MouseHand::moveOnScreen(double right, double up)
{
  if (screen_.renderer())
  {
    const ScreenAxes screen = screen_.axes();
    this->move(right * screen.right + up * screen.up);
  }
}

void MouseHand::placeAt(const Vec3& place)
{
  press_ = 0.0;
  if (device_ && isFinite(place))
  {
    device_->placeAt(this->inWorkspace(place));
  }
}

void MouseHand::hoverIfDue(const SurfaceAt& surfaceAt)
{
  if (!std::exchange(hoverIsDue_, false) || !device_ || !screen_.interactor())
  {
    return;
  }
  const int* pointer = screen_.interactor()->GetEventPosition();
  if (const std::optional<Vec3> surface = surfaceAt(pointer[0], pointer[1]))
  {
    this->placeAt(*surface - kHoverHeight * model_.edge() * screen_.forward());
  }
}

void MouseHand::drag()
{
  if (device_ && screen_.renderer())
  {
    this->move(screen_.mouseMotion(device_->target()));
  }
}

bool MouseHand::isUnderPointer() const
{
  if (!device_ || !screen_.renderer())
  {
    return false;
  }
  const Vec3 hand = screen_.toDisplay(device_->target());
  const int* pointer = screen_.interactor()->GetEventPosition();
  return std::hypot(hand.x - pointer[0], hand.y - pointer[1]) < kReachOfHand;
}

void MouseHand::follow()
{
  if (device_ && screen_.renderer())
  {
    const Vec3 target = device_->target();
    const int* pointer = screen_.interactor()->GetEventPosition();
    this->move(screen_.toWorkspace(pointer[0], pointer[1], screen_.toDisplay(target).z) - target);
  }
}

/// @p place, moved along the line of sight to where it presses as deep as the hand is to press.
Vec3 MouseHand::pressed(const Vec3& place) const
{
  if (!(press_ > 0.0) || !screen_.renderer())
  {
    return place;
  }
  const Vec3 deeper = place + model_.edge() * screen_.forward();
  const Vec3 seen = screen_.toDisplay(place);
  const Vec3 sight = normalized(screen_.toWorkspace(seen.x, seen.y, screen_.toDisplay(deeper).z) - place);
  const double steepness = dot(sight, normal_);
  const double missing = press_ - dot(contact_ - place, normal_);
  return std::abs(steepness) > kFlattestView ? place - missing / steepness * sight : place;
}

void MouseHand::followTouch(const ProxyState& latest, const SurfaceAt& surfaceAt)
{
  const bool isHeld = isDragged_ || (followsMouse_ && !pushesPointer_);
  if (!isHeld || !device_ || !screen_.renderer() || !isFinite(latest.proxy))
  {
    press_ = 0.0;
    return;
  }
  if (latest.contact)
  {
    contact_ = latest.proxy;
    normal_ = latest.normal;
    press_ = press_ > 0.0 ? press_ : std::max(dot(contact_ - device_->target(), normal_), 0.0);
  }
  else if (press_ > 0.0)
  {
    const Vec3 seen = screen_.toDisplay(device_->target());
    const std::optional<Vec3> surface = surfaceAt(int(std::lround(seen.x)), int(std::lround(seen.y)));
    const bool goesOn = surface && norm(*surface - contact_) < kFarthestJump;
    contact_ = goesOn ? *surface : contact_;
    normal_ = goesOn ? -screen_.forward() : normal_;
    press_ = goesOn ? press_ : 0.0;
  }
  if (press_ > 0.0)
  {
    this->move({});
  }
}

void MouseHand::pushPointer(const ProxyState& latest)
{
  if (pushesPointer_ && followsMouse_ && isPointerInside_ && device_ && latest.contact &&
    isFinite(latest.hip))
  {
    device_->setTarget(latest.hip);
    this->placePointer(latest.hip);
  }
}

void MouseHand::putPointerOnHand()
{
  if (followsMouse_ && isPointerInside_ && device_)
  {
    this->placePointer(device_->target());
  }
}

void MouseHand::placePointer(const Vec3& point)
{
  vtkRenderWindowInteractor* interactor = screen_.interactor();
  if (!screen_.renderer() || !interactor)
  {
    return;
  }
  const Vec3 place = screen_.toDisplay(point);
  const int* pointer = interactor->GetEventPosition();
  if (std::hypot(place.x - pointer[0], place.y - pointer[1]) > kPointerSlack)
  {
    movePointer(interactor->GetRenderWindow(), int(std::lround(place.x)), int(std::lround(place.y)));
  }
}

void MouseHand::holdButton(int index, bool isDown)
{
  const std::uint32_t button = std::uint32_t(1) << index;
  if (!isDown)
  {
    releasedButtons_ |= button;
    releaseTime_ = steadySeconds();
    return;
  }
  heldButtons_ |= button;
  releasedButtons_ &= ~button;
  if (device_)
  {
    device_->setButtons(heldButtons_);
  }
}

void MouseHand::update()
{
  if (releasedButtons_ != 0 && steadySeconds() - releaseTime_ > kKeyRepeatSeconds)
  {
    heldButtons_ &= ~releasedButtons_;
    releasedButtons_ = 0;
    if (device_)
    {
      device_->setButtons(heldButtons_);
    }
  }
}

} // namespace pointhaptics
