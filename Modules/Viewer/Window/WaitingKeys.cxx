#include "WaitingKeys.h"

#include <vtkCommand.h>
#include <vtkRenderWindowInteractor.h>

#include <utility>

namespace pointhaptics
{

void WaitingKeys::keep(vtkRenderWindowInteractor* interactor)
{
  const char* symbol = interactor->GetKeySym();
  keys_.push_back({ symbol ? symbol : "", interactor->GetKeyCode(), interactor->GetControlKey() != 0,
    interactor->GetShiftKey() != 0, interactor->GetAltKey() != 0 });
}

void WaitingKeys::press(vtkRenderWindowInteractor* interactor)
{
  for (const Key& key : std::exchange(keys_, {}))
  {
    interactor->SetKeyEventInformation(key.control, key.shift, key.code, 0, key.symbol.c_str());
    interactor->SetAltKey(key.alt);
    for (const auto event : { vtkCommand::KeyPressEvent, vtkCommand::CharEvent, vtkCommand::KeyReleaseEvent })
    {
      interactor->InvokeEvent(event, nullptr);
    }
  }
}

} // namespace pointhaptics
