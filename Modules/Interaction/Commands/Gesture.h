/// @file
/// The names of keys and mouse gestures.
#pragma once

#include "PointHapticsInteractionModule.h" // For export macro

#include <string>
#include <vector>

namespace pointhaptics
{

/// A gesture is a button of the mouse (left, middle, right), wheel, a button of the haptic device (hand1 to
/// hand4), doubleclick of the left button, or a key by its X11 name (h, H, Prior, Left, plus), after the
/// modifiers it takes in this order: Ctrl+, Shift+. Letters carry Shift themselves: X, not Shift+x. In front
/// of all, Walk+ makes it a gesture of the walk through a cloud alone: see CommandRegistry::setModifier().
inline constexpr const char* kDoubleClick = "doubleclick";

/// "Ctrl+Shift+left" and the like of an event; @p name is a button, wheel or a key. With @p alt it begins
/// with Alt+, which no binding has. A capital letter with Ctrl and without Shift is one of Caps Lock, and
/// becomes small.
POINTHAPTICSINTERACTION_EXPORT std::string gestureOf(
  const std::string& name, bool control, bool shift, bool alt = false);
/// True if @p gesture has the form of a gesture: modifiers in their order, then a button, the wheel or one
/// word. Only the keyboard knows its keys, so every other word counts as one.
POINTHAPTICSINTERACTION_EXPORT bool isGesture(const std::string& gesture);

/// Gestures that @p gesture falls back to where it has no command itself, best first. A key falls back to the
/// key without modifiers and in lower case. A letter with Ctrl+ or Alt+ has no fallback, as it is another
/// command in most programs; nor has the mouse.
std::vector<std::string> fallbacksOf(const std::string& gesture);
/// Name of a gesture on the keyboard: "Page Up", "Shift+left", "device's button 1". A small letter stays
/// small.
std::string gestureLabel(const std::string& gesture);
/// Upper case of the letter, where @p gesture is a small letter with or without Ctrl+; else empty.
std::string capitalOf(const std::string& gesture);
/// True for a button of the mouse: left, middle, right, with or without modifiers.
bool isMouseButton(const std::string& gesture);

} // namespace pointhaptics
