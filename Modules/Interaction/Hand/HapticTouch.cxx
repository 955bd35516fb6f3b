#include "HapticTouch.h"

#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

namespace pointhaptics
{

HapticTouch::HapticTouch(vtkInteractorStyleHaptic* style, HapticDevice* device)
  : style_(style)
  , device_(device ? *device : hand_)
{
  style->SetServoLoop(&servo_);
  style->SetDevice(&device_);
  style->SetProps(props_);
}

HapticTouch::~HapticTouch()
{
  this->stop();
}

bool HapticTouch::fail(const std::string& message)
{
  this->stop();
  message_ = message;
  return false;
}

bool HapticTouch::start(const HapticParameters& parameters, const ServoSettings& settings)
{
  vtkRenderWindowInteractor* interactor = style_->GetInteractor();
  if (!interactor || !style_->GetScreen().renderer())
  {
    return this->fail(
      "touch: the style has no window; call vtkRenderWindowInteractor::SetInteractorStyle() and "
      "SetRenderWindow() of a window with a renderer");
  }
  props_->SetWorkspaceBounds(style_->GetModel().workspaceBounds().data());
  props_->AddTo(style_->GetScreen().renderer());
  if (!style_->UpdateModel())
  {
    return this->fail(
      "touch: no point lies in the workspace; check the resampler's input and the model matrix");
  }
  Status status = device_.open();
  if (status != Status::Ok)
  {
    const std::string more = device_.message();
    return this->fail(
      std::string(device_.name()) + ": " + (more.empty() ? pointhaptics::message(status) : more));
  }
  std::string limit;
  status = servo_.start(device_, parameters, settings, &limit);
  if (status != Status::Ok)
  {
    return this->fail(
      std::string(device_.name()) + ": " + (limit.empty() ? pointhaptics::message(status) : limit));
  }
  interactor->Initialize();
  style_->StartUpdates();
  return true;
}

void HapticTouch::stop()
{
  style_->StopUpdates();
  servo_.stop();
  device_.close();
}

bool HapticTouch::run()
{
  if (!this->start())
  {
    vtkErrorWithObjectMacro(style_, << message_);
    return false;
  }
  style_->GetInteractor()->Start();
  this->stop();
  return true;
}

} // namespace pointhaptics
