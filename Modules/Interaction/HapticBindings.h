/// @file
/// What each key and mouse gesture of vtkInteractorStyleHaptic does, and the words for it in the help.
#pragma once

#include "PointHapticsInteractionModule.h" // For export macro

#include <map>
#include <string>
#include <vector>

namespace pointhaptics
{

/// Drags last from a button's press to its release, and so do the *ByHand actions, for the buttons of the
/// haptic device; HandButtons press those of the simulated one as long as their keys are held; *Wheel actions
/// take both directions of the wheel; the others happen once per key or click.
enum class HapticAction
{
  TurnViewDrag,
  PanViewDrag,
  DollyViewDrag,
  DollyViewWheel,
  ResetView,
  TurnModelDrag,
  TurnX,
  TurnBackX,
  TurnY,
  TurnBackY,
  TurnZ,
  TurnBackZ,
  ShiftModelDrag,
  ShiftLeft,
  ShiftRight,
  ShiftUp,
  ShiftDown,
  ZoomModelWheel,
  ZoomIn,
  ZoomOut,
  ResetModel,
  UndoModel,
  MoveHandDrag,
  HandDepthWheel,
  HandAway,
  HandBack,
  HandMode,
  PushPointer,
  ShiftModelByHand,
  TurnModelByHand,
  IndexByHand,
  ZoomModelByHand,
  HandButton1,
  HandButton2,
  HandButton3,
  HandButton4,
  Pick,
  Help,
  Sliders,
  ServoPanel,
  Chart,
  PauseChart,
  Axes,
  Figure,
  Colors,
  Ambient,
  NextFile,
  PreviousFile,
  Screenshot,
  WriteSettings,
  Quit,
  None
};

/// The name of an action on the command line: "turn-x", "shift-model-by-hand"; "none" for None. Static
/// storage.
POINTHAPTICSINTERACTION_EXPORT const char* hapticActionName(HapticAction action) noexcept;
/// None for a name that is none of them.
POINTHAPTICSINTERACTION_EXPORT HapticAction hapticActionFromName(const std::string& name) noexcept;
/// All but None, in the order of the enumeration.
POINTHAPTICSINTERACTION_EXPORT std::vector<HapticAction> hapticActions();

/// A table from gestures to actions. A gesture is a button of the mouse (left, middle, right), wheel, a
/// button of the haptic device (hand1 to hand4), or a key by its X11 name (h, H, Prior, Left, plus), after
/// the modifiers it takes in this order: Ctrl+, Shift+. Letters carry Shift themselves: X, not Shift+x. A
/// gesture has one action at most. Not thread safe.
class POINTHAPTICSINTERACTION_EXPORT HapticBindings
{
public:
  /// The default table.
  HapticBindings();

  /// Gives @p action these gestures, separated by spaces, in place of those it has; they are taken from the
  /// actions that had them. Empty: the action cannot be reached. False, and nothing changes: @p action is
  /// None.
  bool set(HapticAction action, const std::string& gestures);
  /// The gestures of @p action, separated by spaces, in the order they were given.
  std::string get(HapticAction action) const;
  /// The first gesture of @p action as it stands on the keyboard: "A", "Page Up", "Shift+left drag". Empty
  /// where it has none.
  std::string firstLabel(HapticAction action) const;

  /// What @p gesture does, or None. Keys that have no action of their own do what they do without modifiers
  /// and in lower case; but a letter with Ctrl+ or Alt+ is another command in most programs, and does only
  /// what it is bound to.
  HapticAction find(const std::string& gesture) const;
  /// Whether @p gesture can be made at all: modifiers in their order, then a button, the wheel or one word. A
  /// key is known by its keyboard only, so that every other word counts as one.
  static bool isGesture(const std::string& gesture);
  /// "Ctrl+Shift+left" and the like of an event; @p name is a button, wheel or a key. With @p alt it begins
  /// with Alt+, which no binding has. A capital letter with Ctrl and without Shift is one of Caps Lock, and
  /// becomes small.
  static std::string gestureOf(const std::string& name, bool control, bool shift, bool alt = false);

  /// What can be done, one thing a line, in columns: group, gestures, words. Actions without a gesture are
  /// left out.
  std::string describe() const;

private:
  std::map<HapticAction, std::vector<std::string>> gestures_;
};

} // namespace pointhaptics
