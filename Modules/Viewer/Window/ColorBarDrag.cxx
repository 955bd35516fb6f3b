#include "ColorBarDrag.h"

#include "PictureControls.h"
#include "ViewScene.h"

#include <vtkCommand.h>
#include <vtkRenderWindowInteractor.h>

#include <optional>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr float kBeforeTheStyle = 1.0f;

} // namespace

ColorBarDrag::ColorBarDrag(ViewScene& scene, PictureControls& controls, vtkRenderWindowInteractor* interactor)
  : scene_(scene)
  , controls_(controls)
  , interactor_(interactor)
{
  command_->SetClientData(this);
  command_->SetCallback(
    [](vtkObject*, unsigned long event, void* self, void*)
    {
      auto& drag = *static_cast<ColorBarDrag*>(self);
      drag.command_->SetAbortFlag(drag.takes(event));
    });
  for (const auto event :
    { vtkCommand::LeftButtonPressEvent, vtkCommand::MouseMoveEvent, vtkCommand::LeftButtonReleaseEvent })
  {
    interactor->AddObserver(event, command_, kBeforeTheStyle);
  }
}

ColorBarDrag::~ColorBarDrag()
{
  command_->SetClientData(nullptr);
  if (interactor_)
  {
    interactor_->RemoveObserver(command_);
  }
}

bool ColorBarDrag::takes(unsigned long event)
{
  const int* position = interactor_->GetEventPosition();
  if (event == vtkCommand::LeftButtonPressEvent)
  {
    // With a key held the drag is the model's or the hand's.
    const bool isPlain = !interactor_->GetShiftKey() && !interactor_->GetControlKey();
    const std::optional<double> place =
      isPlain ? scene_.placeOnColorBar(position[0], position[1]) : std::nullopt;
    drags_ = place.has_value();
    place_ = place.value_or(0.0);
    return drags_;
  }
  if (event == vtkCommand::LeftButtonReleaseEvent)
  {
    return std::exchange(drags_, false);
  }
  if (drags_)
  {
    if (const std::optional<double> place = scene_.placeOnColorBar(position[0], position[1]))
    {
      controls_.dragColorRange(place_, *place);
      place_ = *place;
    }
  }
  return drags_;
}

} // namespace pointhaptics
