#include "vtkHapticTouch.h"

#include "CloudAppearance.h"
#include "CloudColors.h"
#include "vtkSplatMapper.h"

#include "Core/Base/Boxes.h"
#include "Devices/Falcon/FalconDevice.h"

#include "vtkActor.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

using namespace pointhaptics;

vtkStandardNewMacro(vtkHapticTouch);

vtkHapticTouch::vtkHapticTouch()
  : Hand(std::make_unique<SimulatedDevice>())
{
}

vtkHapticTouch::~vtkHapticTouch()
{
  this->Stop();
}

void vtkHapticTouch::SetDeviceName(const std::string& name)
{
  this->Stop();
  this->DeviceName = name;
  this->Modified();
}

void vtkHapticTouch::SetStartPosition(double x, double y, double z)
{
  SimulatedHandSettings settings;
  settings.start = { x, y, z };
  if (!isFinite(settings.start))
  {
    vtkErrorMacro("SetStartPosition: a coordinate is not a finite number");
    return;
  }
  this->SetDevice(this->Given);
  this->Hand = std::make_unique<SimulatedDevice>(settings);
  std::copy_n(&settings.start.x, 3, this->StartPosition);
  this->Modified();
}

void vtkHapticTouch::SetDevice(HapticDevice* device)
{
  this->Stop();
  if (this->Style)
  {
    this->Style->SetDevice(nullptr); // not the one that may end now
  }
  this->Given = device;
  this->Device = nullptr;
  this->Modified();
}

bool vtkHapticTouch::Fail(const std::string& message)
{
  this->Stop();
  this->Message = message;
  return false;
}

/// Gives the style what it lacks.
bool vtkHapticTouch::Take(vtkInteractorStyleHaptic* style)
{
  const bool isKnown = this->DeviceName == "simulated" || this->DeviceName == "falcon";
  this->Message = !style ? "touch: there is no style; give a vtkInteractorStyleHaptic"
    : !isKnown ? "touch: no device is called \"" + this->DeviceName + "\"; there are simulated and falcon"
    : this->IsOn() && this->Style == style ? "touch: it is on already"
                                           : "";
  if (!this->Message.empty())
  {
    return false;
  }
  this->Stop();
  if (this->DeviceName == "falcon" && !this->Falcon)
  {
    this->Falcon = std::make_unique<FalconDevice>();
  }
  if (this->Style && this->Style != style)
  {
    this->Style->SetServoLoop(nullptr);
    this->Style->SetDevice(nullptr);
  }
  this->Style = style;
  this->Device = this->Given       ? this->Given
    : this->DeviceName == "falcon" ? this->Falcon.get()
                                   : this->Hand.get();
  style->SetServoLoop(&this->Servo);
  style->SetDevice(this->Device);
  style->SetProps(this->Props);
  return true;
}

/// Says where the means are, and how to bring them to the hand, if none is in its box.
std::string vtkHapticTouch::ProblemOfReach() const
{
  vtkPolyData* means = this->Style->GetScenes().cloud();
  const std::array<double, 6>& box = this->Style->GetModel().workspaceBounds();
  const Bounds reach = this->Style->GetModel().workspace();
  Vec3 at;
  for (vtkIdType i = 0; i < means->GetNumberOfPoints(); ++i)
  {
    means->GetPoint(i, &at.x);
    if (contains(reach, at))
    {
      return {};
    }
  }
  const double* is = means->GetBounds();
  const auto span = [](const double* side) { return fmt::format("{:.4g} to {:.4g}", side[0], side[1]); };
  return fmt::format(
    "touch: the hand cannot reach the model, which lies at x {}, y {}, z {} m, while the hand "
    "has x {}, y {}, z {} m; move and scale the model there by SetModelMatrix() of the style",
    span(is), span(is + 2), span(is + 4), span(&box[0]), span(&box[2]), span(&box[4]));
}

void vtkHapticTouch::ShowMeans()
{
  vtkRenderer* renderer = this->Style->GetScreen().renderer();
  vtkPolyData* means = this->Style->GetScenes().cloud();
  if (renderer->VisibleActorCount() > 0)
  {
    return;
  }
  vtkNew<vtkSplatMapper> mapper;
  mapper->SetInputData(means);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  applyCloudAppearance(means, mapper, actor);
  actor->GetProperty()->SetColor(kClayColor[0], kClayColor[1], kClayColor[2]);
  if (!renderer->GetPass())
  {
    applyDepthShading(renderer); // means have no normals: depths show their shape
  }
  renderer->AddActor(actor);
  this->Style->SetCloudActor(actor);
}

bool vtkHapticTouch::Start(vtkInteractorStyleHaptic* style)
{
  if (!this->Take(style))
  {
    return false;
  }
  vtkRenderWindowInteractor* interactor = style->GetInteractor();
  if (!interactor || !style->GetScreen().renderer())
  {
    return this->Fail(
      "touch: the style has no window; call vtkRenderWindowInteractor::SetInteractorStyle() and "
      "SetRenderWindow() of a window with a renderer");
  }
  if (!style->UpdateModel())
  {
    const std::string& problem = style->GetScenes().problem();
    return this->Fail(problem.empty()
        ? "touch: no point lies in the workspace; check the resampler's input and the model matrix"
        : "touch: " + problem);
  }
  if (const std::string reach = this->ProblemOfReach(); !reach.empty())
  {
    return this->Fail(reach);
  }
  this->ShowMeans();
  this->Props->SetWorkspaceBounds(style->GetModel().workspaceBounds().data());
  this->Props->AddTo(style->GetScreen().renderer());
  std::string more;
  Status status = this->Device->open();
  if (status != Status::Ok)
  {
    more = this->Device->message();
  }
  else
  {
    status = this->Servo.start(*this->Device, HapticParameters(), ServoSettings(), &more);
  }
  if (status != Status::Ok)
  {
    return this->Fail(
      std::string(this->Device->name()) + ": " + (more.empty() ? pointhaptics::message(status) : more));
  }
  interactor->Initialize();
  style->StartUpdates();
  return true;
}

void vtkHapticTouch::Stop()
{
  if (this->Device)
  {
    this->Style->StopUpdates();
    this->Servo.stop();
    this->Device->close();
  }
}

bool vtkHapticTouch::Run(vtkInteractorStyleHaptic* style)
{
  if (!this->Start(style))
  {
    vtkObject* const object = style ? static_cast<vtkObject*>(style) : this;
    vtkErrorWithObjectMacro(object, << this->Message);
    return false;
  }
  style->GetInteractor()->Start();
  this->Stop();
  return true;
}

ProxyState vtkHapticTouch::Latest() const
{
  return this->IsOn() ? this->Servo.latest().state : ProxyState();
}

void vtkHapticTouch::GetHand(double position[3]) const
{
  const Vec3 hip = this->Latest().hip;
  std::copy(&hip.x, &hip.x + 3, position);
}

void vtkHapticTouch::GetForce(double force[3]) const
{
  const Vec3 felt = this->Latest().force;
  std::copy(&felt.x, &felt.x + 3, force);
}
