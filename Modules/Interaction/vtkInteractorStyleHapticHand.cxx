// The hand of vtkInteractorStyleHaptic: driven by mouse and keys, holding the model by the device's buttons,
// and the SpaceMouse of the other hand.
#include "MousePointer.h"
#include "vtkInteractorStyleHapticInternals.h"

#include "vtkRenderWindow.h"

#include <cmath>

using pointhaptics::HapticAction;
using pointhaptics::ServoSample;
using pointhaptics::Vec3;
using pointhaptics::style::displayToWorld;
using pointhaptics::style::dragged;
using pointhaptics::style::ScreenAxes;
using pointhaptics::style::worldToDisplay;

namespace
{

/// Parts of the workspace's longest edge.
constexpr double kDepthPerKey = 0.02;
/// Radius of the ball that the hand rolls, and the way it has to go for a zoom by e.
constexpr double kBallRadius = 0.25;
constexpr double kWayPerZoom = 0.25;
constexpr int kHandButtons = 4;
/// A key that is pressed again so soon was held all the time.
constexpr double kKeyRepeatSeconds = 0.05;
/// Pixels: a pointer nearer to the hand is left where it is.
constexpr double kPointerSlack = 1.0;
/// The cap of a SpaceMouse at its end: a second of it.
constexpr double kCapEdgesPerSecond = 0.5;
constexpr double kCapDegreesPerSecond = 90.0;
constexpr double kCapZoomPerSecond = 2.0;
/// Longest time between two looks that counts: after a pause the model does not jump.
constexpr double kLongestCapStep = 0.2;
constexpr std::uint32_t kZoomButton = 1;
constexpr std::uint32_t kResetButton = 2;

bool isHold(HapticAction action)
{
  return action == HapticAction::ShiftModelByHand || action == HapticAction::TurnModelByHand ||
    action == HapticAction::IndexByHand || action == HapticAction::ZoomModelByHand;
}

/// Bit of the simulated hand's button that @p action presses; 0: none.
std::uint32_t buttonOf(HapticAction action)
{
  const int index = int(action) - int(HapticAction::HandButton1);
  return index >= 0 && index < kHandButtons ? std::uint32_t(1) << index : 0;
}

} // namespace

void vtkInteractorStyleHaptic::SetHandMode(bool on)
{
  this->Parts->handMode = on;
  this->Parts->lastStatus = -1e9;
}

bool vtkInteractorStyleHaptic::GetHandMode() const
{
  return this->Parts->handMode;
}

void vtkInteractorStyleHaptic::MoveHand(const Vec3& offset)
{
  Internals& parts = *this->Parts;
  if (!parts.device || !isFinite(offset))
  {
    return;
  }
  Vec3 target = parts.device->target() + offset;
  for (int axis = 0; axis < 3; ++axis)
  {
    target[axis] = std::min(std::max(target[axis], parts.workspace[2 * axis]), parts.workspace[2 * axis + 1]);
  }
  parts.device->setTarget(target);
}

void vtkInteractorStyleHaptic::MoveHandInDepth(double metres)
{
  vtkRenderer* renderer = this->MainRenderer();
  if (renderer)
  {
    Vec3 direction;
    renderer->GetActiveCamera()->GetDirectionOfProjection(&direction.x);
    this->MoveHand(metres * direction);
  }
}

void vtkInteractorStyleHaptic::DragHand()
{
  vtkRenderer* renderer = this->MainRenderer();
  if (!this->Parts->device || !renderer)
  {
    return;
  }
  const Vec3 target = this->Parts->device->target();
  // While the workspace moves over the model the camera moves too: the pointer is no place then.
  if (this->Parts->drag == HapticAction::MoveHandDrag || this->Parts->hold == HapticAction::IndexByHand)
  {
    this->MoveHand(dragged(renderer, this->Interactor, target));
    return;
  }
  const int* position = this->Interactor->GetEventPosition();
  this->MoveHand(
    displayToWorld(renderer, position[0], position[1], worldToDisplay(renderer, target).z) - target);
}

bool vtkInteractorStyleHaptic::HandKey(HapticAction action)
{
  if (action == HapticAction::HandMode)
  {
    this->SetHandMode(!this->GetHandMode());
    return true;
  }
  if (action == HapticAction::PushPointer)
  {
    this->SetPushPointer(!this->GetPushPointer());
    return true;
  }
  if (action == HapticAction::HandAway || action == HapticAction::HandBack)
  {
    this->MoveHandInDepth(
      (action == HapticAction::HandAway ? 1.0 : -1.0) * kDepthPerKey * this->Parts->edge());
    return true;
  }
  return false;
}

void vtkInteractorStyleHaptic::SetPushPointer(bool on)
{
  this->Parts->pushesPointer = on;
  this->Parts->lastStatus = -1e9;
}

bool vtkInteractorStyleHaptic::GetPushPointer() const
{
  return this->Parts->pushesPointer;
}

void vtkInteractorStyleHaptic::OnLeave()
{
  this->Parts->pointerInside = false;
  this->Superclass::OnLeave();
}

/// The surface has pushed the hand away from where the pointer wants it: the pointer goes where the hand is.
void vtkInteractorStyleHaptic::PushPointer()
{
  Internals& parts = *this->Parts;
  if (!parts.pushesPointer || !parts.handMode || !parts.pointerInside || !parts.device || !parts.servo ||
    parts.hold != HapticAction::None)
  {
    return;
  }
  const ServoSample latest = parts.servo->latest();
  if (latest.state.contact && isFinite(latest.state.hip))
  {
    parts.device->setTarget(latest.state.hip);
    this->PlacePointer(latest.state.hip);
  }
}

void vtkInteractorStyleHaptic::PlacePointer(const Vec3& point)
{
  vtkRenderer* renderer = this->MainRenderer();
  if (!renderer || !this->Interactor)
  {
    return;
  }
  const Vec3 place = worldToDisplay(renderer, point);
  const int* pointer = this->Interactor->GetEventPosition();
  if (std::hypot(place.x - pointer[0], place.y - pointer[1]) > kPointerSlack)
  {
    pointhaptics::movePointer(
      this->Interactor->GetRenderWindow(), int(std::lround(place.x)), int(std::lround(place.y)));
  }
}

bool vtkInteractorStyleHaptic::PressHandButton(HapticAction action)
{
  Internals& parts = *this->Parts;
  const std::uint32_t button = buttonOf(action);
  if (button == 0)
  {
    return false;
  }
  parts.heldKeys |= button;
  parts.releasedKeys &= ~button;
  if (parts.device)
  {
    parts.device->setButtons(parts.heldKeys);
  }
  return true;
}

/// A key that repeats is released and pressed again at once: whether it stays up is seen a little later.
bool vtkInteractorStyleHaptic::ReleaseHandButton(HapticAction action)
{
  const std::uint32_t button = buttonOf(action);
  this->Parts->releasedKeys |= button;
  this->Parts->keyReleased = pointhaptics::style::now();
  return button != 0;
}

void vtkInteractorStyleHaptic::ReleaseHandKeys()
{
  Internals& parts = *this->Parts;
  if (parts.releasedKeys != 0 && pointhaptics::style::now() - parts.keyReleased > kKeyRepeatSeconds)
  {
    parts.heldKeys &= ~parts.releasedKeys;
    parts.releasedKeys = 0;
    if (parts.device)
    {
      parts.device->setButtons(parts.heldKeys);
    }
  }
}

HapticAction vtkInteractorStyleHaptic::GetHold() const
{
  return this->Parts->hold;
}

/// All ticks since the last call: the model moves by what the hand did while a button was down, however late
/// this is seen.
void vtkInteractorStyleHaptic::MoveByHand()
{
  for (const ServoSample& sample : this->Parts->samples)
  {
    this->TakeHandSample(sample);
  }
  this->MoveModelByHand();
  this->LetGoOfModel();
  this->ReleaseHandKeys();
}

void vtkInteractorStyleHaptic::TakeHandSample(const ServoSample& sample)
{
  Internals& parts = *this->Parts;
  // A device that says nothing holds nothing: the hand may be anywhere when it speaks again.
  const bool readable = sample.device == pointhaptics::Status::Ok && isFinite(sample.state.hip);
  const std::uint32_t buttons = readable ? sample.buttons : 0;
  // But a button that is held through a moment without answers is not pressed again.
  const std::uint32_t pressed = buttons & ~parts.handButtons;
  parts.handButtons = readable ? buttons : parts.handButtons;
  HapticAction hold = HapticAction::None;
  for (int i = kHandButtons - 1; i >= 0; --i)
  {
    const std::uint32_t bit = std::uint32_t(1) << i;
    const HapticAction action =
      buttons & bit ? parts.bindings.find("hand" + std::to_string(i + 1)) : HapticAction::None;
    if (isHold(action))
    {
      hold = action;
    }
    else if (pressed & bit)
    {
      this->Do(action);
    }
  }
  if (hold != parts.hold)
  {
    this->EndHold();
    this->BeginHold(hold, sample.state.hip);
  }
  else if (hold != HapticAction::None)
  {
    parts.handTo = sample.state.hip;
  }
}

void vtkInteractorStyleHaptic::BeginHold(HapticAction action, const Vec3& hand)
{
  Internals& parts = *this->Parts;
  if (action == HapticAction::None)
  {
    return;
  }
  parts.beginGesture();
  parts.hold = action;
  parts.handFrom = hand;
  parts.handTo = hand;
  parts.clutched = true;
  parts.lastStatus = -1e9;
  parts.servo->setClutched(true);
}

void vtkInteractorStyleHaptic::EndHold()
{
  Internals& parts = *this->Parts;
  if (parts.hold == HapticAction::None)
  {
    return;
  }
  this->MoveModelByHand();
  // The pointer drives the hand, and the picture stayed while the hand went.
  if (parts.hold == HapticAction::IndexByHand && parts.handMode && parts.pointerInside && parts.device)
  {
    this->PlacePointer(parts.device->target());
  }
  parts.hold = HapticAction::None;
  parts.lastStatus = -1e9;
}

void vtkInteractorStyleHaptic::MoveModelByHand()
{
  Internals& parts = *this->Parts;
  vtkRenderer* renderer = this->MainRenderer();
  const Vec3 way = parts.handTo - parts.handFrom;
  if (parts.hold == HapticAction::None || !renderer || way == Vec3())
  {
    return;
  }
  parts.handFrom = parts.handTo;
  const ScreenAxes screen(renderer);
  vtkCamera* camera = renderer->GetActiveCamera();
  Vec3 eye;
  Vec3 focus;
  switch (parts.hold)
  {
    case HapticAction::TurnModelByHand:
    {
      const Vec3 inPlane = way - dot(way, screen.forward) * screen.forward;
      const double degrees = norm(inPlane) / (kBallRadius * parts.edge()) * 180.0 / std::acos(-1.0);
      this->TurnModel(degrees, -1.0 * cross(screen.forward, inPlane));
      break;
    }
    case HapticAction::ZoomModelByHand:
      this->ZoomModel(std::exp(-dot(way, screen.forward) / (kWayPerZoom * parts.edge())));
      break;
    case HapticAction::IndexByHand:
      camera->GetPosition(&eye.x);
      camera->GetFocalPoint(&focus.x);
      eye += way;
      focus += way;
      camera->SetPosition(&eye.x);
      camera->SetFocalPoint(&focus.x);
      this->ShiftModel(way);
      break;
    default:
      this->ShiftModel(way);
  }
}

/// Once the scene of the model's new place is published, the hand may feel it.
void vtkInteractorStyleHaptic::LetGoOfModel()
{
  Internals& parts = *this->Parts;
  if (parts.clutched && parts.hold == HapticAction::None && (!this->IsModelChanged() || !parts.resampler))
  {
    parts.clutched = false;
    parts.servo->setClutched(false);
  }
}

void vtkInteractorStyleHaptic::MoveBySpaceMouse()
{
  Internals& parts = *this->Parts;
  vtkRenderer* renderer = this->MainRenderer();
  if (!parts.mouse || !renderer)
  {
    return;
  }
  const pointhaptics::SpaceMouseMotion motion = parts.mouse->motion();
  const double time = pointhaptics::style::now();
  const double seconds = std::min(time - parts.mouseRead, kLongestCapStep);
  parts.mouseRead = time;
  const std::uint32_t pressed = motion.buttons & ~parts.mouseButtons;
  parts.mouseButtons = motion.buttons;
  if (pressed & kResetButton)
  {
    this->ResetModel();
  }
  if (motion.resting())
  {
    parts.capMoves = false;
    return;
  }
  parts.beginGesture();
  parts.capMoves = true;
  const ScreenAxes screen(renderer);
  // The cap's axes are those of the screen.
  const auto onScreen = [&](const Vec3& v)
  { return v.x * screen.right + v.y * screen.up - v.z * screen.forward; };
  if (motion.buttons & kZoomButton)
  {
    this->ZoomModel(std::pow(kCapZoomPerSecond, motion.shift.z * seconds));
    return;
  }
  if (motion.shift != Vec3())
  {
    this->ShiftModel(kCapEdgesPerSecond * parts.edge() * seconds * onScreen(motion.shift));
  }
  if (motion.turn != Vec3())
  {
    this->TurnModel(kCapDegreesPerSecond * seconds * norm(motion.turn), onScreen(motion.turn));
  }
}
