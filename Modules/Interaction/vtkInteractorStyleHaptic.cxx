#include "vtkInteractorStyleHaptic.h"

#include "Gesture.h"
#include "SteadyTime.h"
#include "StyleCommands.h"

#include "Devices/HapticDevice.h"
#include "Devices/SimulatedDevice.h"

#include "vtkCamera.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <utility>

using pointhaptics::ServoSample;

/// Clicks of a double click lie within so many pixels.
static constexpr double kSamePlace = 4.0;

vtkStandardNewMacro(vtkInteractorStyleHaptic);

vtkInteractorStyleHaptic::vtkInteractorStyleHaptic()
  : Screen(*this)
  , Input(this->Commands)
  , Scenes(this->Model)
  , Hand(this->Screen, this->Model)
  , Clutch(this->Commands, this->Screen, this->Model)
  , Distance(this->Scenes)
  , Cap(this->Model, this->Screen)
  , Status(this->Commands, this->Scenes, this->Hand, this->Clutch)
  , Display(this->Screen)
  , Picker(this->Screen, this->Scenes, this->Status)
{
  pointhaptics::addStyleCommands(*this);
  this->Commands.setObserver(
    [this]
    {
      this->Status.updateHelp();
      this->Display.requestRender();
    });
  this->Model.setObserver([this] { this->ModelMoved(); });
  this->Scenes.setObserver([this](const pointhaptics::BuiltScene& built) { this->SceneShown(built); });
}

vtkInteractorStyleHaptic::~vtkInteractorStyleHaptic() = default;

void vtkInteractorStyleHaptic::SetServoLoop(pointhaptics::ServoLoop* servo)
{
  this->Servo = servo;
  this->Clutch.setServo(servo);
  this->Scenes.setServo(servo);
}

void vtkInteractorStyleHaptic::SetDevice(pointhaptics::HapticPort* device)
{
  const auto* named = dynamic_cast<pointhaptics::HapticDevice*>(device);
  this->Device = device;
  this->UnitsAreJudged = false;
  this->Status.setDeviceName(named ? named->name() : device ? "without a name" : "");
  auto* hand = dynamic_cast<pointhaptics::SimulatedDevice*>(device);
  this->Hand.setDevice(hand && hand->path().points.empty() ? hand : nullptr);
}

void vtkInteractorStyleHaptic::AdoptModel(
  vtkMatrix4x4* matrix, std::shared_ptr<const pointhaptics::HapticScene> scene)
{
  if (!this->Scenes.hasCloud())
  {
    this->SetModelMatrix(matrix);
    return;
  }
  this->Model.adoptMatrix(matrix);
  this->Picker.forget();
  this->Scenes.adopt(std::move(scene));
  this->InvokeEvent(ModelChangedEvent);
}

void vtkInteractorStyleHaptic::StartModel(vtkMatrix4x4* matrix, bool findsLattice)
{
  this->Model.adoptMatrix(matrix);
  this->Picker.forget();
  this->Scenes.startCloud(findsLattice);
  this->InvokeEvent(ModelChangedEvent);
}

void vtkInteractorStyleHaptic::InvalidateModel()
{
  this->Scenes.invalidate();
  if (this->Picker.forget())
  {
    this->Display.requestRender();
  }
}

void vtkInteractorStyleHaptic::ModelMoved()
{
  this->Picker.forget();
  // With a timer at once: the next one, and what it has to draw, would come later.
  this->Scenes.moveModel(this->Timer >= 0);
  this->Display.requestRender();
  this->InvokeEvent(ModelChangedEvent);
}

void vtkInteractorStyleHaptic::SceneShown(const pointhaptics::BuiltScene& built)
{
  if (!built.problem.empty())
  {
    vtkErrorMacro(<< built.problem);
  }
  else if (built.empty && built.status != pointhaptics::Status::Empty)
  {
    vtkErrorMacro("The model cannot be felt as it stands: " << pointhaptics::message(built.status)
                                                            << this->Status.resetHint());
  }
  this->Display.requestRender();
  this->InvokeEvent(SceneChangedEvent);
}

std::string vtkInteractorStyleHaptic::JudgeUnits(const pointhaptics::UnitNames& names)
{
  this->UnitsAreJudged = true;
  const auto* hand = dynamic_cast<pointhaptics::SimulatedDevice*>(this->Device.get());
  vtkPolyData* cloud = this->Scenes.cloud();
  pointhaptics::Bounds box;
  if (cloud && cloud->GetNumberOfPoints() > 0)
  {
    const double* b = cloud->GetBounds();
    box = { { b[0], b[2], b[4] }, { b[1], b[3], b[5] } };
  }
  return hand && !hand->path().points.empty() ? pointhaptics::unlikelyUnits(hand->path(), box, names)
                                              : std::string();
}

void vtkInteractorStyleHaptic::StartUpdates(unsigned long milliseconds)
{
  this->StopUpdates();
  const std::string odd = this->UnitsAreJudged ? std::string() : this->JudgeUnits();
  if (!odd.empty())
  {
    vtkWarningMacro(<< odd);
  }
  if (this->Interactor)
  {
    this->Timer = this->Interactor->CreateRepeatingTimer(std::max(1ul, milliseconds));
  }
}

void vtkInteractorStyleHaptic::StopUpdates()
{
  if (this->Interactor && this->Timer >= 0)
  {
    this->Interactor->DestroyTimer(this->Timer);
  }
  this->Timer = -1;
}

void vtkInteractorStyleHaptic::Refresh()
{
  this->Cap.update(pointhaptics::steadySeconds());
  this->Scenes.poll();
  this->CollectSamples();
  const std::vector<ServoSample> samples = std::exchange(this->Samples, {});
  const ServoSample latest = this->Servo ? this->Servo->latest() : ServoSample();
  bool touchMoved = this->Servo && this->Display.update(samples, latest);
  if (this->Display.showChartIfFelt(samples, this->Hand.isDragged()))
  {
    this->Hand.putPointerOnHand(); // the picture is smaller now
  }
  this->MeasureDistance(latest);
  touchMoved = this->Display.showDistance(this->Distance) || touchMoved;
  const bool commandRun = this->Clutch.take(samples);
  if (this->Scenes.isSettled())
  {
    this->Clutch.letGo();
  }
  this->Hand.update();
  this->HoverIfDue();
  if (!this->Clutch.isHolding())
  {
    this->Hand.followTouch(latest.state, [this](int x, int y) { return this->Picker.surfaceAt(x, y); });
    this->Hand.pushPointer(latest.state);
  }
  if (this->Status.update(this->Servo.get(), touchMoved) || touchMoved || commandRun)
  {
    this->Display.requestRender();
  }
  this->Display.renderIfDue();
}

void vtkInteractorStyleHaptic::HoverHand()
{
  this->Hand.requestHover();
  this->HoverIfDue();
}

void vtkInteractorStyleHaptic::HoverIfDue()
{
  if (!this->Scenes.isChanged())
  {
    this->Hand.hoverIfDue([this](int x, int y) { return this->Picker.surfaceAt(x, y); });
  }
}

/// Measures while a person moves the hand; the mouse counts in hand mode only.
void vtkInteractorStyleHaptic::MeasureDistance(const ServoSample& latest)
{
  const bool isHeld = this->Servo && latest.tick > 0 && !this->Clutch.isHolding() &&
    (this->Hand.followsMouse() || !this->Hand.hasDevice());
  this->Distance.update(isHeld ? &latest.state : nullptr);
  this->Status.setDistance(this->Screen.renderer() && this->Distance.nearest()
      ? this->Distance.text(this->Screen.axes())
      : std::string());
}

void vtkInteractorStyleHaptic::CollectSamples()
{
  if (!this->Servo)
  {
    this->Clutch.setServo(nullptr); // the loop may be gone while the hand held the model
    return;
  }
  std::vector<ServoSample> samples;
  this->Servo->takeTrace(samples);
  if (!samples.empty())
  {
    this->InvokeEvent(SamplesEvent, &samples);
    this->Samples.insert(this->Samples.end(), samples.begin(), samples.end());
  }
}

std::string vtkInteractorStyleHaptic::GestureOf(const char* name) const
{
  return pointhaptics::gestureOf(
    name, this->Interactor->GetControlKey() != 0, this->Interactor->GetShiftKey() != 0);
}

void vtkInteractorStyleHaptic::Press(const char* button)
{
  if (this->Input.isDragging() || this->State != VTKIS_NONE)
  {
    return; // another button is down already
  }
  const int* position = this->Interactor->GetEventPosition();
  this->FindPokedRenderer(position[0], position[1]);
  const double away = std::hypot(position[0] - this->PressedAt[0], position[1] - this->PressedAt[1]);
  const bool isDouble =
    button == std::string("left") && this->Interactor->GetRepeatCount() > 0 && away < kSamePlace;
  std::copy_n(position, 2, this->PressedAt);
  if (!isDouble || !runOnce(this->Commands.find(this->GestureOf(pointhaptics::kDoubleClick))))
  {
    this->Input.pressButton(this->GestureOf(button));
  }
  this->Display.requestRender();
}

void vtkInteractorStyleHaptic::OnMouseMove()
{
  this->Hand.setPointerInside(true);
  if (this->Input.moveMouse())
  {
    return;
  }
  if (!this->Hand.followsMouse() || this->State != VTKIS_NONE || this->Input.isDragging())
  {
    this->Superclass::OnMouseMove();
  }
  // While the workspace moves over the model the camera moves too: the pointer is no place then.
  else if (this->Clutch.hold() == pointhaptics::kIndexByHand)
  {
    this->Hand.drag();
  }
  else
  {
    this->Hand.follow();
  }
}

void vtkInteractorStyleHaptic::Dolly(double factor)
{
  if (vtkRenderer* renderer = this->CurrentRenderer)
  {
    const int* size = renderer->GetSize();
    const int* origin = renderer->GetOrigin();
    this->Steps.look(renderer, origin[0] + 0.5 * size[0], origin[1] + 0.5 * size[1]);
    // Not by what is seen far behind the pivot: the step would pass what lies about it.
    this->Steps.run(renderer, renderer->GetActiveCamera()->GetDistance(),
      [this, factor] { this->Superclass::Dolly(factor); });
  }
}

void vtkInteractorStyleHaptic::StartPan()
{
  if (this->CurrentRenderer)
  {
    const int* at = this->Interactor->GetEventPosition();
    this->Steps.look(this->CurrentRenderer, at[0], at[1]);
  }
  this->Superclass::StartPan();
}

void vtkInteractorStyleHaptic::Pan()
{
  if (this->CurrentRenderer)
  {
    this->Steps.run(this->CurrentRenderer, INFINITY, [this] { this->Superclass::Pan(); });
  }
}

void vtkInteractorStyleHaptic::OnKeyPress()
{
  const char* symbol = this->Interactor->GetKeySym();
  const std::string gesture =
    pointhaptics::gestureOf(symbol ? symbol : "", this->Interactor->GetControlKey() != 0,
      this->Interactor->GetShiftKey() != 0, this->Interactor->GetAltKey() != 0);
  if (this->Input.pressKey(gesture))
  {
    this->Display.requestRender();
  }
  else
  {
    this->Superclass::OnKeyPress();
  }
}

void vtkInteractorStyleHaptic::OnKeyRelease()
{
  const char* symbol = this->Interactor->GetKeySym();
  if (!this->Input.releaseKey(symbol ? symbol : ""))
  {
    this->Superclass::OnKeyRelease();
  }
}

void vtkInteractorStyleHaptic::OnLeave()
{
  this->Hand.setPointerInside(false);
  this->Superclass::OnLeave();
}

void vtkInteractorStyleHaptic::OnDropFiles(vtkStringArray* filePaths)
{
  this->InvokeEvent(FilesDroppedEvent, filePaths);
}

void vtkInteractorStyleHaptic::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HandMode: " << this->Hand.followsMouse() << "\n";
  os << indent << "ModelChanged: " << this->IsModelChanged() << "\n";
  os << indent << "ModelTransform:\n";
  this->Model.transform()->PrintSelf(os, indent.GetNextIndent());
}
