#include "HapticTouch.h"

#include "CloudAppearance.h"
#include "CloudColors.h"
#include "vtkSplatMapper.h"

#include "Core/Base/Boxes.h"

#include "vtkActor.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <fmt/format.h>

#include <array>

namespace pointhaptics
{

HapticTouch::HapticTouch(
  vtkInteractorStyleHaptic* style, HapticDevice* device, const SimulatedHandSettings& hand)
  : style_(style)
  , hand_(hand)
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

/// Says where the means are, and how to bring them to the hand, if none is in its box.
std::string HapticTouch::problemOfReach() const
{
  vtkPolyData* means = style_->GetScenes().cloud();
  const std::array<double, 6>& box = style_->GetModel().workspaceBounds();
  const Bounds reach = style_->GetModel().workspace();
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

void HapticTouch::showMeans()
{
  vtkRenderer* renderer = style_->GetScreen().renderer();
  if (renderer->VisibleActorCount() > 0)
  {
    return;
  }
  vtkNew<vtkSplatMapper> mapper;
  mapper->SetInputData(style_->GetScenes().cloud());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  applyCloudAppearance(style_->GetScenes().cloud(), mapper, actor);
  actor->GetProperty()->SetColor(kClayColor[0], kClayColor[1], kClayColor[2]);
  if (!renderer->GetPass())
  {
    applyDepthShading(renderer); // means have no normals: depths show their shape
  }
  renderer->AddActor(actor);
  style_->SetCloudActor(actor);
}

bool HapticTouch::start(const HapticParameters& parameters, const ServoSettings& settings)
{
  if (servo_.running())
  {
    message_ = "touch: it is on already";
    return false;
  }
  message_.clear();
  vtkRenderWindowInteractor* interactor = style_->GetInteractor();
  if (!interactor || !style_->GetScreen().renderer())
  {
    return this->fail(
      "touch: the style has no window; call vtkRenderWindowInteractor::SetInteractorStyle() and "
      "SetRenderWindow() of a window with a renderer");
  }
  if (!style_->UpdateModel())
  {
    const std::string& problem = style_->GetScenes().problem();
    return this->fail(problem.empty()
        ? "touch: no point lies in the workspace; check the resampler's input and the model matrix"
        : "touch: " + problem);
  }
  const std::string reach = this->problemOfReach();
  if (!reach.empty())
  {
    return this->fail(reach);
  }
  this->showMeans();
  props_->SetWorkspaceBounds(style_->GetModel().workspaceBounds().data());
  props_->AddTo(style_->GetScreen().renderer());
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
