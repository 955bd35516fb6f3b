#include "MouseHand.h"

#include "ModelTransform.h"
#include "MousePointer.h"
#include "ScreenView.h"
#include "SteadyTime.h"

#include "Haptics/Proxy.h"

#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// A key that is pressed again within this time was held all along.
constexpr double kKeyRepeatSeconds = 0.05;
/// A pointer nearer to the hand than this, pixels, stays where it is.
constexpr double kPointerSlack = 1.0;

} // namespace

Vec3 MouseHand::inWorkspace(Vec3 place) const
{
  const std::array<double, 6>& box = model_.workspaceBounds();
  for (int axis = 0; axis < 3; ++axis)
  {
    place[axis] = std::min(std::max(place[axis], box[2 * axis]), box[2 * axis + 1]);
  }
  return place;
}

void MouseHand::move(const Vec3& offset)
{
  if (device_ && isFinite(offset))
  {
    device_->setTarget(this->inWorkspace(device_->target() + offset));
  }
}

void MouseHand::moveInDepth(double metres)
{
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
  if (device_ && isFinite(place))
  {
    device_->placeAt(this->inWorkspace(place));
  }
}

void MouseHand::drag()
{
  if (device_ && screen_.renderer())
  {
    this->move(screen_.mouseMotion(device_->target()));
  }
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
