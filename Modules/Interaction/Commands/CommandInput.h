/// @file
/// From the gestures of mouse and keyboard to the functions of commands.
#pragma once

#include "CommandRegistry.h"

#include <optional>
#include <string>

namespace pointhaptics
{

/// Passes gestures to the functions of commands and keeps the drag under way. A gesture whose command is of
/// another kind (a drag on a key) does nothing. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT CommandInput
{
public:
  /// @p commands must outlive this.
  explicit CommandInput(const CommandRegistry& commands)
    : commands_(commands)
  {
  }

  /// Begins a drag, or runs a command, when a mouse button goes down. Does nothing while another drag is
  /// under way.
  void pressButton(const std::string& gesture);
  /// Ends the drag.
  void releaseButton();
  bool isDragging() const { return drag_.has_value(); }
  /// Notes that the mouse has moved. True: the drag took it.
  bool moveMouse();
  void turnWheel(const std::string& gesture, int direction);
  /// Runs the command of a key. False: it has none that a key can run.
  bool pressKey(const std::string& gesture);
  bool releaseKey(const std::string& name);

private:
  const CommandRegistry& commands_;
  std::optional<DragAction> drag_;
};

} // namespace pointhaptics
