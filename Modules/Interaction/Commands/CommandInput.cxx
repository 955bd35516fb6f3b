#include "CommandInput.h"

namespace pointhaptics
{
namespace
{

/// Calls a copy of the function, as a command may change the registry.
template <typename Action>
std::optional<Action> actionOf(const Command* command)
{
  const Action* action = command ? std::get_if<Action>(&command->action) : nullptr;
  return action ? std::optional<Action>(*action) : std::nullopt;
}

void call(const std::function<void()>& function)
{
  if (function)
  {
    function();
  }
}

} // namespace

void CommandInput::pressButton(const std::string& gesture)
{
  if (drag_)
  {
    return;
  }
  const Command* command = commands_.find(gesture);
  drag_ = actionOf<DragAction>(command);
  if (drag_)
  {
    call(drag_->begin);
  }
  else
  {
    runOnce(command);
  }
}

void CommandInput::releaseButton()
{
  const std::optional<DragAction> ended = std::move(drag_);
  drag_.reset();
  if (ended)
  {
    call(ended->end);
  }
}

bool CommandInput::moveMouse()
{
  const bool isTaken = drag_ && drag_->move;
  if (isTaken)
  {
    drag_->move();
  }
  return isTaken;
}

void CommandInput::turnWheel(const std::string& gesture, int direction)
{
  const auto action = actionOf<WheelAction>(commands_.find(gesture));
  if (action && action->turn)
  {
    action->turn(direction);
  }
}

bool CommandInput::pressKey(const std::string& gesture)
{
  const Command* command = commands_.find(gesture);
  const auto action = actionOf<HoldAction>(command);
  if (action && action->hold)
  {
    action->hold(true);
  }
  return action || runOnce(command);
}

bool CommandInput::releaseKey(const std::string& name)
{
  const auto action = actionOf<HoldAction>(commands_.find(name));
  if (action && action->hold)
  {
    action->hold(false);
  }
  return action.has_value();
}

} // namespace pointhaptics
