#include "ColorBarDrag.h"

#include "PictureControls.h"
#include "ViewScene.h"

#include <vtkCommand.h>
#include <vtkRenderWindowInteractor.h>

#include <utility>

namespace pointhaptics
{
namespace
{

constexpr float kBarBeforeTheStyle = 1.0f;

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
    interactor->AddObserver(event, command_, kBarBeforeTheStyle);
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
    const auto place = isPlain ? scene_.placeOnColorBar(position[0], position[1]) : std::nullopt;
    drags_ = place.has_value();
    if (drags_)
    {
      from_ = place->along;
      pixels_ = place->pixels;
      fromY_ = position[1];
      range_ = scene_.shownColorRange();
    }
    return drags_;
  }
  if (event == vtkCommand::LeftButtonReleaseEvent)
  {
    return std::exchange(drags_, false);
  }
  if (drags_)
  {
    controls_.dragColorRange(range_, from_, from_ + (position[1] - fromY_) / pixels_);
  }
  return drags_;
}

} // namespace pointhaptics
