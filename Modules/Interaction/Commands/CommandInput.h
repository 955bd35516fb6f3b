/// @file
/// From the gestures of mouse and keyboard to the functions of commands.
#pragma once

#include "CommandRegistry.h"

#include <optional>
#include <string>

namespace pointhaptics
{

/// Knows which drag is under way. A gesture whose command is of another kind (a drag on a key) does nothing.
/// GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT CommandInput
{
public:
  /// @p commands must outlive this.
  explicit CommandInput(const CommandRegistry& commands)
    : commands_(commands)
  {
  }

  /// A mouse button goes down: a drag begins, or a command is run. Nothing while another drag is under way.
  void pressButton(const std::string& gesture);
  /// Ends the drag.
  void releaseButton();
  bool isDragging() const { return drag_.has_value(); }
  /// The mouse has moved. True: the drag took it.
  bool moveMouse();
  void turnWheel(const std::string& gesture, int direction);
  /// False: the key has no command that a key can run.
  bool pressKey(const std::string& gesture);
  bool releaseKey(const std::string& name);

private:
  const CommandRegistry& commands_;
  std::optional<DragAction> drag_;
};

} // namespace pointhaptics
