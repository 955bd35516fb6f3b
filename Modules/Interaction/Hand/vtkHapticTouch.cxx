#include "vtkHapticTouch.h"

#include "HapticTouch.h"

#include "Devices/Falcon/FalconDevice.h"

#include "vtkObjectFactory.h"

#include <algorithm>

using namespace pointhaptics;

vtkStandardNewMacro(vtkHapticTouch);

struct vtkHapticTouch::Internals
{
  vtkSmartPointer<vtkInteractorStyleHaptic> style;
  std::unique_ptr<HapticDevice> device; ///< Null: the touch's own hand.
  std::unique_ptr<HapticTouch> touch;   ///< Declared after the device, which must outlive it.

  ProxyState latest() const
  {
    return this->touch && this->touch->servo().running() ? this->touch->servo().latest().state : ProxyState();
  }
};

vtkHapticTouch::vtkHapticTouch()
  : Impl(std::make_unique<Internals>())
{
}

vtkHapticTouch::~vtkHapticTouch() = default;

void vtkHapticTouch::SetDeviceName(const std::string& name)
{
  this->Impl->touch.reset();
  this->DeviceName = name;
  this->Modified();
}

void vtkHapticTouch::SetStartPosition(double x, double y, double z)
{
  this->Impl->touch.reset();
  this->StartPosition[0] = x;
  this->StartPosition[1] = y;
  this->StartPosition[2] = z;
  this->Modified();
}

bool vtkHapticTouch::Make(vtkInteractorStyleHaptic* style)
{
  this->Message.clear();
  if (this->Impl->touch && this->Impl->style == style)
  {
    return true;
  }
  if (!style)
  {
    this->Message = "touch: there is no style; give a vtkInteractorStyleHaptic";
  }
  else if (this->DeviceName != "simulated" && this->DeviceName != "falcon")
  {
    this->Message = "touch: no device is called \"" + this->DeviceName + "\"; there are simulated and falcon";
  }
  if (!this->Message.empty())
  {
    return false;
  }
  this->Impl->touch.reset();
  this->Impl->style = style;
  this->Impl->device = this->DeviceName == "falcon" ? std::make_unique<FalconDevice>() : nullptr;
  SimulatedHandSettings hand;
  hand.start = { this->StartPosition[0], this->StartPosition[1], this->StartPosition[2] };
  this->Impl->touch = std::make_unique<HapticTouch>(style, this->Impl->device.get(), hand);
  return true;
}

bool vtkHapticTouch::Start(vtkInteractorStyleHaptic* style)
{
  if (!this->Make(style))
  {
    return false;
  }
  const bool isOn = this->Impl->touch->start();
  this->Message = this->Impl->touch->message();
  return isOn;
}

void vtkHapticTouch::Stop()
{
  if (this->Impl->touch)
  {
    this->Impl->touch->stop();
  }
}

bool vtkHapticTouch::Run(vtkInteractorStyleHaptic* style)
{
  if (!this->Make(style))
  {
    vtkErrorMacro(<< this->Message);
    return false;
  }
  const bool ran = this->Impl->touch->run();
  this->Message = this->Impl->touch->message();
  return ran;
}

bool vtkHapticTouch::IsOn() const
{
  return this->Impl->touch && this->Impl->touch->servo().running();
}

void vtkHapticTouch::MoveHand(double x, double y, double z)
{
  if (this->Impl->touch)
  {
    this->Impl->touch->hand().setTarget({ x, y, z });
  }
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
