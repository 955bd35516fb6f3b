#include "LeftButton.h"

#include <vtkCommand.h>
#include <vtkRenderWindowInteractor.h>

#include <utility>

namespace pointhaptics
{

LeftButton::LeftButton(
  vtkRenderWindowInteractor* interactor, float priority, std::function<bool(const Event&)> takes)
  : interactor_(interactor)
  , takes_(std::move(takes))
{
  command_->SetClientData(this);
  command_->SetCallback(
    [](vtkObject*, unsigned long event, void* self, void*)
    {
      auto& button = *static_cast<LeftButton*>(self);
      button.command_->SetAbortFlag(button.takes(event));
    });
  for (const auto event :
    { vtkCommand::LeftButtonPressEvent, vtkCommand::MouseMoveEvent, vtkCommand::LeftButtonReleaseEvent })
  {
    interactor->AddObserver(event, command_, priority);
  }
}

LeftButton::~LeftButton()
{
  if (interactor_)
  {
    interactor_->RemoveObserver(command_);
  }
}

bool LeftButton::takes(unsigned long event)
{
  Event seen;
  seen.kind = event == vtkCommand::LeftButtonPressEvent ? Kind::Press
    : event == vtkCommand::MouseMoveEvent               ? Kind::Move
                                                        : Kind::Release;
  seen.x = interactor_->GetEventPosition()[0];
  seen.y = interactor_->GetEventPosition()[1];
  seen.isPlain = !interactor_->GetShiftKey() && !interactor_->GetControlKey();
  return takes_(seen);
}

void LeftButton::render()
{
  if (interactor_)
  {
    interactor_->Render();
  }
}

} // namespace pointhaptics
