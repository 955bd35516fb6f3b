#include "vtkHapticTouch.h"

#include "CloudAppearance.h"
#include "CloudColors.h"
#include "vtkHapticProps.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkSplatMapper.h"

#include "Devices/Falcon/FalconDevice.h"
#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"

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

struct vtkHapticTouch::Internals
{
  vtkSmartPointer<vtkInteractorStyleHaptic> style;
  SimulatedDevice hand;
  std::unique_ptr<FalconDevice> falcon;
  HapticDevice* given = nullptr;
  vtkNew<vtkHapticProps> props;
  ServoLoop servo; ///< Last member: destroyed, and so stopped, first.

  HapticDevice& device() { return given ? *given : falcon ? *falcon : static_cast<HapticDevice&>(hand); }
  ProxyState latest() const { return servo.running() ? servo.latest().state : ProxyState(); }
};

vtkHapticTouch::vtkHapticTouch()
  : Impl(std::make_unique<Internals>())
{
}

vtkHapticTouch::~vtkHapticTouch()
{
  this->Stop();
}

void vtkHapticTouch::SetDeviceName(const std::string& name)
{
  this->Stop();
  this->Impl->style = nullptr;
  this->DeviceName = name;
  this->Modified();
}

void vtkHapticTouch::SetDevice(HapticDevice* device)
{
  this->SetDeviceName(this->DeviceName);
  this->Impl->given = device;
}

/// Gives @p style the parts of this.
bool vtkHapticTouch::Adopt(vtkInteractorStyleHaptic* style)
{
  if (!style)
  {
    return this->Fail("touch: there is no style; give a vtkInteractorStyleHaptic");
  }
  if (this->DeviceName != "simulated" && this->DeviceName != "falcon")
  {
    return this->Fail(
      "touch: no device is called \"" + this->DeviceName + "\"; there are simulated and falcon");
  }
  if (style != this->Impl->style)
  {
    this->Stop();
    this->Impl->style = style;
    this->Impl->falcon = this->DeviceName == "falcon" ? std::make_unique<FalconDevice>() : nullptr;
    style->SetServoLoop(&this->Impl->servo);
    style->SetDevice(&this->Impl->device());
    style->SetProps(this->Impl->props);
  }
  return true;
}

bool vtkHapticTouch::Fail(const std::string& message)
{
  this->Stop();
  this->Message = message;
  return false;
}

/// Says where the means are, and how to bring them to the hand, if none is in its box.
std::string vtkHapticTouch::ProblemOfReach() const
{
  vtkInteractorStyleHaptic* style = this->Impl->style;
  vtkPolyData* means = style->GetScenes().cloud();
  const std::array<double, 6>& box = style->GetModel().workspaceBounds();
  double at[3];
  for (vtkIdType i = 0; i < means->GetNumberOfPoints(); ++i)
  {
    means->GetPoint(i, at);
    if (at[0] >= box[0] && at[0] <= box[1] && at[1] >= box[2] && at[1] <= box[3] && at[2] >= box[4] &&
      at[2] <= box[5])
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
  vtkInteractorStyleHaptic* style = this->Impl->style;
  vtkRenderer* renderer = style->GetScreen().renderer();
  if (renderer->VisibleActorCount() > 0)
  {
    return;
  }
  vtkNew<vtkSplatMapper> mapper;
  mapper->SetInputData(style->GetScenes().cloud());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  applyCloudAppearance(style->GetScenes().cloud(), mapper, actor);
  actor->GetProperty()->SetColor(kClayColor[0], kClayColor[1], kClayColor[2]);
  applyDepthShading(renderer); // means have no normals: depths show their shape
  renderer->AddActor(actor);
  style->SetCloudActor(actor);
}

bool vtkHapticTouch::Start(vtkInteractorStyleHaptic* style)
{
  Internals& parts = *this->Impl;
  if (this->IsOn() && style == parts.style)
  {
    this->Message = "touch: it is on already";
    return false;
  }
  this->Message.clear();
  if (!this->Adopt(style))
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
  const std::string reach = this->ProblemOfReach();
  if (!reach.empty())
  {
    return this->Fail(reach);
  }
  this->ShowMeans();
  parts.props->SetWorkspaceBounds(style->GetModel().workspaceBounds().data());
  parts.props->AddTo(style->GetScreen().renderer());
  HapticDevice& device = parts.device();
  std::string problem;
  Status status = device.open();
  if (status != Status::Ok)
  {
    problem = device.message();
  }
  else
  {
    status = parts.servo.start(device, {}, {}, &problem);
  }
  if (status != Status::Ok)
  {
    return this->Fail(
      std::string(device.name()) + ": " + (problem.empty() ? pointhaptics::message(status) : problem));
  }
  interactor->Initialize();
  style->StartUpdates();
  return true;
}

void vtkHapticTouch::Stop()
{
  if (this->Impl->style)
  {
    this->Impl->style->StopUpdates();
    this->Impl->servo.stop();
    this->Impl->device().close();
  }
}

bool vtkHapticTouch::Run(vtkInteractorStyleHaptic* style)
{
  if (!this->Start(style))
  {
    vtkErrorWithObjectMacro(style ? static_cast<vtkObject*>(style) : this, << this->Message);
    return false;
  }
  style->GetInteractor()->Start();
  this->Stop();
  return true;
}

bool vtkHapticTouch::IsOn() const
{
  return this->Impl->servo.running();
}

ServoLoop& vtkHapticTouch::Servo()
{
  return this->Impl->servo;
}

void vtkHapticTouch::MoveHand(double x, double y, double z)
{
  this->Impl->hand.setTarget({ x, y, z });
}

void vtkHapticTouch::GetHand(double position[3]) const
{
  const Vec3 hip = this->Impl->latest().hip;
  std::copy(&hip.x, &hip.x + 3, position);
}

void vtkHapticTouch::GetForce(double force[3]) const
{
  const Vec3 felt = this->Impl->latest().force;
  std::copy(&felt.x, &felt.x + 3, force);
}

void vtkHapticTouch::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DeviceName: " << this->DeviceName << "\n";
  os << indent << "IsOn: " << this->IsOn() << "\n";
  os << indent << "Message: " << this->Message << "\n";
}
