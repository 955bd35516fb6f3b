// Mouse and keys of vtkInteractorStyleHaptic; what they do is in vtkInteractorStyleHaptic.cxx.
#include "vtkInteractorStyleHapticInternals.h"

#include "vtkCamera.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <cmath>

using pointhaptics::Vec3;
using pointhaptics::style::Drag;

namespace
{

constexpr double kDegreesPerPixel = 0.4;
constexpr double kDegreesPerKey = 5.0;
constexpr double kZoomPerStep = 1.1;
/// Parts of the workspace's longest edge.
constexpr double kShiftPerKey = 0.02;
constexpr double kDepthPerKey = 0.02;
constexpr double kDepthPerWheelStep = 0.01;
/// The cap of a SpaceMouse at its end: a second of it.
constexpr double kCapEdgesPerSecond = 0.5;
constexpr double kCapDegreesPerSecond = 90.0;
constexpr double kCapZoomPerSecond = 2.0;
/// Longest time between two looks that counts: after a pause the model does not jump.
constexpr double kLongestCapStep = 0.2;
constexpr std::uint32_t kZoomButton = 1;
constexpr std::uint32_t kResetButton = 2;

Vec3 displayToWorld(vtkRenderer* renderer, double x, double y, double depth)
{
  double world[4];
  vtkInteractorObserver::ComputeDisplayToWorld(renderer, x, y, depth, world);
  return { world[0], world[1], world[2] };
}

double depthOf(vtkRenderer* renderer, const Vec3& point)
{
  double display[3];
  vtkInteractorObserver::ComputeWorldToDisplay(renderer, point.x, point.y, point.z, display);
  return display[2];
}

/// How far @p anchor moves in the view plane when the mouse goes from its last position to this one.
Vec3 dragged(vtkRenderer* renderer, vtkRenderWindowInteractor* interactor, const Vec3& anchor)
{
  const double depth = depthOf(renderer, anchor);
  const int* to = interactor->GetEventPosition();
  const int* from = interactor->GetLastEventPosition();
  return displayToWorld(renderer, to[0], to[1], depth) - displayToWorld(renderer, from[0], from[1], depth);
}

} // namespace

const char* vtkInteractorStyleHaptic::GetHelpText()
{
  return "Look     left drag      turn the view\n"
         "         middle drag    pan\n"
         "         right, wheel   nearer, farther\n"
         "         R              whole workspace\n"
         "Model    Shift+left     turn    (x X y Y z Z)\n"
         "         Shift+middle   shift   (arrow keys)\n"
         "         Shift+wheel    zoom    (+ -)\n"
         "         0 or Home      back to the start\n"
         "Hand     Ctrl+left      move in the view plane\n"
         "         Ctrl+wheel     depth   (Page Up, Down)\n"
         "         F or Space     hand follows the mouse\n"
         "Program  H  this help       C  chart\n"
         "         S  screenshot      Q  quit\n"
         "         drop a file on the window to open it";
}

void vtkInteractorStyleHaptic::OnLeftButtonDown()
{
  const bool shift = this->Interactor->GetShiftKey() != 0;
  const bool control = this->Interactor->GetControlKey() != 0;
  if (!shift && !control)
  {
    this->Superclass::OnLeftButtonDown();
    return;
  }
  const int* position = this->Interactor->GetEventPosition();
  this->FindPokedRenderer(position[0], position[1]);
  this->Parts->drag = !shift ? Drag::Hand : control ? Drag::ShiftModel : Drag::TurnModel;
}

void vtkInteractorStyleHaptic::OnLeftButtonUp()
{
  if (this->Parts->drag != Drag::None)
  {
    this->Parts->drag = Drag::None;
    return;
  }
  this->Superclass::OnLeftButtonUp();
}

void vtkInteractorStyleHaptic::OnMiddleButtonDown()
{
  if (!this->Interactor->GetShiftKey())
  {
    this->Superclass::OnMiddleButtonDown();
    return;
  }
  const int* position = this->Interactor->GetEventPosition();
  this->FindPokedRenderer(position[0], position[1]);
  this->Parts->drag = Drag::ShiftModel;
}

void vtkInteractorStyleHaptic::OnMiddleButtonUp()
{
  if (this->Parts->drag != Drag::None)
  {
    this->Parts->drag = Drag::None;
    return;
  }
  this->Superclass::OnMiddleButtonUp();
}

void vtkInteractorStyleHaptic::OnMouseMove()
{
  if (this->Parts->drag == Drag::Hand ||
    (this->Parts->handMode && this->State == VTKIS_NONE && this->Parts->drag == Drag::None))
  {
    this->DragHand();
  }
  else if (this->Parts->drag != Drag::None)
  {
    this->DragModel();
  }
  else
  {
    this->Superclass::OnMouseMove();
  }
}

void vtkInteractorStyleHaptic::DragModel()
{
  vtkRenderer* renderer = this->MainRenderer();
  if (!renderer)
  {
    return;
  }
  if (this->Parts->drag == Drag::ShiftModel)
  {
    this->ShiftModel(dragged(renderer, this->Interactor, this->Parts->center()));
    return;
  }
  const int* to = this->Interactor->GetEventPosition();
  const int* from = this->Interactor->GetLastEventPosition();
  Vec3 up;
  Vec3 forward;
  renderer->GetActiveCamera()->OrthogonalizeViewUp();
  renderer->GetActiveCamera()->GetViewUp(&up.x);
  renderer->GetActiveCamera()->GetDirectionOfProjection(&forward.x);
  // The mouse rolls a ball: the axis lies in the view plane, across the motion.
  const double dx = to[0] - from[0];
  const double dy = to[1] - from[1];
  const Vec3 axis = dx * up - dy * cross(forward, up);
  this->TurnModel(kDegreesPerPixel * std::hypot(dx, dy), axis);
}

void vtkInteractorStyleHaptic::DragHand()
{
  vtkRenderer* renderer = this->MainRenderer();
  if (!this->Parts->device || !renderer)
  {
    return;
  }
  const Vec3 target = this->Parts->device->target();
  if (this->Parts->drag == Drag::Hand)
  {
    this->MoveHand(dragged(renderer, this->Interactor, target));
    return;
  }
  const int* position = this->Interactor->GetEventPosition();
  this->MoveHand(displayToWorld(renderer, position[0], position[1], depthOf(renderer, target)) - target);
}

void vtkInteractorStyleHaptic::OnMouseWheelForward()
{
  this->Wheel(+1);
}

void vtkInteractorStyleHaptic::OnMouseWheelBackward()
{
  this->Wheel(-1);
}

void vtkInteractorStyleHaptic::Wheel(int direction)
{
  if (this->Interactor->GetShiftKey())
  {
    this->ZoomModel(std::pow(kZoomPerStep, direction));
  }
  else if (this->Interactor->GetControlKey() || this->Parts->handMode)
  {
    this->MoveHandInDepth(direction * kDepthPerWheelStep * this->Parts->edge());
  }
  else if (direction > 0)
  {
    this->Superclass::OnMouseWheelForward();
  }
  else
  {
    this->Superclass::OnMouseWheelBackward();
  }
}

void vtkInteractorStyleHaptic::OnKeyPress()
{
  const char* symbol = this->Interactor->GetKeySym();
  const std::string key = symbol ? symbol : "";
  if (!this->ModelKey(key) && !this->HandKey(key) && !this->ProgramKey(key))
  {
    this->Superclass::OnKeyPress();
  }
}

// All keys are handled in OnKeyPress; the base class would read some of them as wire frame, stereo or exit.
void vtkInteractorStyleHaptic::OnChar() {}

bool vtkInteractorStyleHaptic::ModelKey(const std::string& key)
{
  if (key.size() == 1 && std::string("xyzXYZ").find(key) != std::string::npos)
  {
    const bool backwards = key[0] < 'a' || this->Interactor->GetShiftKey();
    const char axis = static_cast<char>(key[0] | 0x20);
    this->TurnModel(backwards ? -kDegreesPerKey : kDegreesPerKey,
      { axis == 'x' ? 1.0 : 0.0, axis == 'y' ? 1.0 : 0.0, axis == 'z' ? 1.0 : 0.0 });
    return true;
  }
  if (key == "plus" || key == "equal" || key == "KP_Add")
  {
    this->ZoomModel(kZoomPerStep);
    return true;
  }
  if (key == "minus" || key == "underscore" || key == "KP_Subtract")
  {
    this->ZoomModel(1.0 / kZoomPerStep);
    return true;
  }
  if (key == "0" || key == "KP_0" || key == "Home" || key == "KP_Home")
  {
    this->ResetModel();
    return true;
  }
  const int right = key == "Right" ? 1 : key == "Left" ? -1 : 0;
  const int upward = key == "Up" ? 1 : key == "Down" ? -1 : 0;
  vtkRenderer* renderer = this->MainRenderer();
  if ((right == 0 && upward == 0) || !renderer)
  {
    return false;
  }
  Vec3 up;
  Vec3 forward;
  renderer->GetActiveCamera()->OrthogonalizeViewUp();
  renderer->GetActiveCamera()->GetViewUp(&up.x);
  renderer->GetActiveCamera()->GetDirectionOfProjection(&forward.x);
  const double step = kShiftPerKey * this->Parts->edge();
  this->ShiftModel(step * (double(right) * cross(forward, up) + double(upward) * up));
  return true;
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
    return;
  }
  Vec3 up;
  Vec3 forward;
  renderer->GetActiveCamera()->OrthogonalizeViewUp();
  renderer->GetActiveCamera()->GetViewUp(&up.x);
  renderer->GetActiveCamera()->GetDirectionOfProjection(&forward.x);
  const Vec3 right = cross(forward, up);
  // The cap's axes are those of the screen.
  const auto onScreen = [&](const Vec3& v) { return v.x * right + v.y * up - v.z * forward; };
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

bool vtkInteractorStyleHaptic::HandKey(const std::string& key)
{
  if (key == "f" || key == "F" || key == "space")
  {
    this->SetHandMode(!this->GetHandMode());
    return true;
  }
  const bool away = key == "Prior" || key == "KP_Prior" || key == "Page_Up";
  const bool back = key == "Next" || key == "KP_Next" || key == "Page_Down";
  if (away || back)
  {
    this->MoveHandInDepth((away ? 1.0 : -1.0) * kDepthPerKey * this->Parts->edge());
    return true;
  }
  return false;
}

bool vtkInteractorStyleHaptic::ProgramKey(const std::string& key)
{
  if (key == "h" || key == "H" || key == "question")
  {
    if (vtkHapticOverlay* overlay = this->Parts->overlay)
    {
      overlay->SetHelpVisibility(!overlay->GetHelpVisibility());
      this->Parts->rendersWanted = true;
    }
  }
  else if (key == "c" || key == "C")
  {
    this->ToggleChart();
  }
  else if (key == "r" || key == "R")
  {
    if (vtkRenderer* renderer = this->MainRenderer())
    {
      renderer->ResetCamera(this->Parts->workspace.data());
      this->Parts->rendersWanted = true;
    }
  }
  else if (key == "s" || key == "S")
  {
    this->InvokeEvent(ScreenshotEvent);
  }
  else if (key == "q" || key == "Q" || key == "Escape")
  {
    this->Interactor->ExitCallback();
  }
  else
  {
    return false;
  }
  return true;
}
