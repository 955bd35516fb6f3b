// Mouse and keys of vtkInteractorStyleHaptic; what they do is in vtkInteractorStyleHaptic.cxx and, for the
// hand, in vtkInteractorStyleHapticHand.cxx.
#include "vtkInteractorStyleHapticInternals.h"

#include "vtkCamera.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <cmath>

using pointhaptics::HapticAction;
using pointhaptics::HapticBindings;
using pointhaptics::Vec3;
using pointhaptics::style::dragged;
using pointhaptics::style::ScreenAxes;

namespace
{

constexpr double kDegreesPerPixel = 0.4;
constexpr double kDegreesPerKey = 5.0;
constexpr double kZoomPerStep = 1.1;
/// Parts of the workspace's longest edge.
constexpr double kShiftPerKey = 0.02;
constexpr double kDepthPerWheelStep = 0.01;

} // namespace

const char* vtkInteractorStyleHaptic::GetHelpText()
{
  static const std::string text = pointhaptics::HapticBindings().describe();
  return text.c_str();
}

void vtkInteractorStyleHaptic::Press(const char* button)
{
  Internals& parts = *this->Parts;
  if (parts.drag != HapticAction::None || this->State != VTKIS_NONE)
  {
    return; // another button is down already
  }
  const int* position = this->Interactor->GetEventPosition();
  this->FindPokedRenderer(position[0], position[1]);
  const HapticAction action = parts.bindings.find(HapticBindings::gestureOf(
    button, this->Interactor->GetControlKey() != 0, this->Interactor->GetShiftKey() != 0));
  switch (action)
  {
    case HapticAction::TurnViewDrag:
      this->StartRotate();
      break;
    case HapticAction::PanViewDrag:
      this->StartPan();
      break;
    case HapticAction::DollyViewDrag:
      this->StartDolly();
      break;
    case HapticAction::TurnModelDrag:
    case HapticAction::ShiftModelDrag:
    case HapticAction::MoveHandDrag:
      parts.beginGesture();
      parts.drag = action;
      break;
    default:
      this->Do(action);
  }
}

void vtkInteractorStyleHaptic::Release()
{
  this->Parts->drag = HapticAction::None;
  if (this->State == VTKIS_ROTATE)
  {
    this->EndRotate();
  }
  else if (this->State == VTKIS_PAN)
  {
    this->EndPan();
  }
  else if (this->State == VTKIS_DOLLY)
  {
    this->EndDolly();
  }
}

void vtkInteractorStyleHaptic::OnLeftButtonDown()
{
  this->Press("left");
}

void vtkInteractorStyleHaptic::OnLeftButtonUp()
{
  this->Release();
}

void vtkInteractorStyleHaptic::OnMiddleButtonDown()
{
  this->Press("middle");
}

void vtkInteractorStyleHaptic::OnMiddleButtonUp()
{
  this->Release();
}

void vtkInteractorStyleHaptic::OnRightButtonDown()
{
  this->Press("right");
}

void vtkInteractorStyleHaptic::OnRightButtonUp()
{
  this->Release();
}

void vtkInteractorStyleHaptic::OnMouseMove()
{
  this->Parts->pointerInside = true;
  const HapticAction drag = this->Parts->drag;
  const bool follows = this->Parts->handMode && this->State == VTKIS_NONE && drag == HapticAction::None;
  if (drag == HapticAction::MoveHandDrag || follows)
  {
    this->DragHand();
  }
  else if (drag != HapticAction::None)
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
  if (this->Parts->drag == HapticAction::ShiftModelDrag)
  {
    this->ShiftModel(dragged(renderer, this->Interactor, this->Parts->center()));
    return;
  }
  const int* to = this->Interactor->GetEventPosition();
  const int* from = this->Interactor->GetLastEventPosition();
  const ScreenAxes screen(renderer);
  // The mouse rolls a ball: the axis lies in the view plane, across the motion.
  const double dx = to[0] - from[0];
  const double dy = to[1] - from[1];
  const Vec3 axis = dx * screen.up - dy * screen.right;
  this->TurnModel(kDegreesPerPixel * std::hypot(dx, dy), axis);
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
  HapticAction action = this->Parts->bindings.find(HapticBindings::gestureOf(
    "wheel", this->Interactor->GetControlKey() != 0, this->Interactor->GetShiftKey() != 0));
  if (action == HapticAction::DollyViewWheel && this->Parts->handMode)
  {
    action = HapticAction::HandDepthWheel;
  }
  if (action == HapticAction::ZoomModelWheel)
  {
    this->ZoomModel(std::pow(kZoomPerStep, direction));
  }
  else if (action == HapticAction::HandDepthWheel)
  {
    this->MoveHandInDepth(direction * kDepthPerWheelStep * this->Parts->edge());
  }
  else if (action == HapticAction::DollyViewWheel && direction > 0)
  {
    this->Superclass::OnMouseWheelForward();
  }
  else if (action == HapticAction::DollyViewWheel)
  {
    this->Superclass::OnMouseWheelBackward();
  }
}

void vtkInteractorStyleHaptic::OnKeyPress()
{
  const char* symbol = this->Interactor->GetKeySym();
  const HapticAction action = this->Parts->bindings.find(
    HapticBindings::gestureOf(symbol ? symbol : "", this->Interactor->GetControlKey() != 0,
      this->Interactor->GetShiftKey() != 0, this->Interactor->GetAltKey() != 0));
  if (!this->PressHandButton(action) && !this->Do(action))
  {
    this->Superclass::OnKeyPress();
  }
}

void vtkInteractorStyleHaptic::OnKeyRelease()
{
  const char* symbol = this->Interactor->GetKeySym();
  const HapticAction action = this->Parts->bindings.find(symbol ? symbol : "");
  if (!this->ReleaseHandButton(action))
  {
    this->Superclass::OnKeyRelease();
  }
}

/// What is done at once. False: @p action is none of that kind.
bool vtkInteractorStyleHaptic::Do(HapticAction action)
{
  return this->ModelKey(action) || this->HandKey(action) || this->ShowKey(action) || this->ProgramKey(action);
}

// All keys are handled in OnKeyPress; the base class would read some of them as wire frame, stereo or exit.
void vtkInteractorStyleHaptic::OnChar() {}

bool vtkInteractorStyleHaptic::ModelKey(HapticAction action)
{
  switch (action)
  {
    case HapticAction::TurnX:
    case HapticAction::TurnBackX:
      this->TurnModel(action == HapticAction::TurnX ? kDegreesPerKey : -kDegreesPerKey, { 1.0, 0.0, 0.0 });
      return true;
    case HapticAction::TurnY:
    case HapticAction::TurnBackY:
      this->TurnModel(action == HapticAction::TurnY ? kDegreesPerKey : -kDegreesPerKey, { 0.0, 1.0, 0.0 });
      return true;
    case HapticAction::TurnZ:
    case HapticAction::TurnBackZ:
      this->TurnModel(action == HapticAction::TurnZ ? kDegreesPerKey : -kDegreesPerKey, { 0.0, 0.0, 1.0 });
      return true;
    case HapticAction::ZoomIn:
    case HapticAction::ZoomOut:
      this->ZoomModel(action == HapticAction::ZoomIn ? kZoomPerStep : 1.0 / kZoomPerStep);
      return true;
    case HapticAction::ResetModel:
      this->ResetModel();
      return true;
    case HapticAction::UndoModel:
      this->UndoModel();
      return true;
    default:
      break;
  }
  const int right = int(action == HapticAction::ShiftRight) - int(action == HapticAction::ShiftLeft);
  const int upward = int(action == HapticAction::ShiftUp) - int(action == HapticAction::ShiftDown);
  vtkRenderer* renderer = this->MainRenderer();
  if ((right == 0 && upward == 0) || !renderer)
  {
    return false;
  }
  const ScreenAxes screen(renderer);
  const double step = kShiftPerKey * this->Parts->edge();
  this->ShiftModel(step * (double(right) * screen.right + double(upward) * screen.up));
  return true;
}

bool vtkInteractorStyleHaptic::ShowKey(HapticAction action)
{
  Internals& parts = *this->Parts;
  switch (action)
  {
    case HapticAction::Help:
      if (parts.overlay)
      {
        parts.overlay->SetHelpVisibility(!parts.overlay->GetHelpVisibility());
      }
      break;
    case HapticAction::Pick:
      this->PickAt(this->Interactor->GetEventPosition()[0], this->Interactor->GetEventPosition()[1]);
      break;
    case HapticAction::Sliders:
      if (parts.sliders)
      {
        parts.sliders->SetVisibility(!parts.sliders->GetVisibility());
      }
      break;
    case HapticAction::ServoPanel:
      this->SetServoPanelVisibility(!parts.servoPanel);
      break;
    case HapticAction::Chart:
      this->ToggleChart();
      break;
    case HapticAction::PauseChart:
      if (parts.chart)
      {
        parts.chart->SetPaused(!parts.chart->GetPaused());
      }
      break;
    case HapticAction::Axes:
      this->InvokeEvent(AxesEvent);
      break;
    case HapticAction::Figure:
      this->ForgetPicked();
      this->InvokeEvent(FigureEvent);
      break;
    case HapticAction::Colors:
      this->InvokeEvent(ColorsEvent);
      break;
    case HapticAction::Ambient:
      this->InvokeEvent(AmbientEvent);
      break;
    case HapticAction::ResetView:
      if (vtkRenderer* renderer = this->MainRenderer())
      {
        renderer->ResetCamera(parts.workspace.data());
      }
      break;
    default:
      return false;
  }
  parts.rendersWanted = true;
  return true;
}

bool vtkInteractorStyleHaptic::ProgramKey(HapticAction action)
{
  switch (action)
  {
    case HapticAction::NextFile:
      this->InvokeEvent(NextFileEvent);
      return true;
    case HapticAction::PreviousFile:
      this->InvokeEvent(PreviousFileEvent);
      return true;
    case HapticAction::Screenshot:
      this->InvokeEvent(ScreenshotEvent);
      return true;
    case HapticAction::WriteSettings:
      this->InvokeEvent(WriteSettingsEvent);
      return true;
    case HapticAction::Quit:
      this->Interactor->ExitCallback();
      return true;
    default:
      return false;
  }
}
