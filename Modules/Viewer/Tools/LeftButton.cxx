#include "LeftButton.h"

#include <vtkRenderWindowInteractor.h>

#include <utility>

namespace pointhaptics
{

LeftButton::LeftButton(
  vtkRenderWindowInteractor* interactor, float priority, std::function<bool(const Event&)> takes)
  : interactor_(interactor)
  , takes_(std::move(takes))
{
  events_.follow(interactor,
    { vtkCommand::LeftButtonPressEvent, vtkCommand::MouseMoveEvent, vtkCommand::LeftButtonReleaseEvent },
    priority);
}

void LeftButton::onEvent(unsigned long event)
{
  Event seen;
  seen.kind = event == vtkCommand::LeftButtonPressEvent ? Kind::Press
    : event == vtkCommand::MouseMoveEvent               ? Kind::Move
                                                        : Kind::Release;
  seen.x = interactor_->GetEventPosition()[0];
  seen.y = interactor_->GetEventPosition()[1];
  seen.isPlain = !interactor_->GetShiftKey() && !interactor_->GetControlKey();
  if (takes_(seen))
  {
    events_.keepEvent();
  }
}

void LeftButton::render()
{
  if (interactor_)
  {
    interactor_->Render();
  }
}

} // namespace pointhaptics
