#include "HapticBindings.h"

#include <gtest/gtest.h>

using pointhaptics::HapticAction;
using pointhaptics::HapticBindings;

namespace
{

TEST(HapticBindings, FindsKeysWithWhateverModifiersAreHeld)
{
  const HapticBindings bindings;
  EXPECT_EQ(bindings.find("h"), HapticAction::Help);
  EXPECT_EQ(bindings.find("H"), HapticAction::Help);
  EXPECT_EQ(bindings.find(HapticBindings::gestureOf("plus", false, true)), HapticAction::ZoomIn);
  EXPECT_EQ(bindings.find(HapticBindings::gestureOf("Prior", true, false)), HapticAction::HandAway);
  EXPECT_EQ(bindings.find("F13"), HapticAction::None);
  EXPECT_EQ(bindings.find(""), HapticAction::None);
}

TEST(HapticBindings, TellsCasesAndModifiersApartWhereBothAreBound)
{
  const HapticBindings bindings;
  EXPECT_EQ(bindings.find("z"), HapticAction::TurnZ);
  EXPECT_EQ(bindings.find(HapticBindings::gestureOf("z", false, true)), HapticAction::TurnBackZ);
  EXPECT_EQ(bindings.find(HapticBindings::gestureOf("z", true, false)), HapticAction::UndoModel);
}

TEST(HapticBindings, DoesNotTakeALetterWithCtrlOrAltForThePlainOne)
{
  HapticBindings bindings;
  for (char letter = 'a'; letter <= 'z'; ++letter)
  {
    const std::string name(1, letter);
    const HapticAction ctrl = letter == 'z' ? HapticAction::UndoModel : HapticAction::None;
    EXPECT_EQ(bindings.find(HapticBindings::gestureOf(name, true, false)), ctrl) << name;
    EXPECT_EQ(bindings.find(HapticBindings::gestureOf(name, true, true)), HapticAction::None) << name;
    EXPECT_EQ(bindings.find(HapticBindings::gestureOf(name, false, false, true)), HapticAction::None) << name;
    EXPECT_EQ(bindings.find(HapticBindings::gestureOf(name, false, true, true)), HapticAction::None) << name;
    EXPECT_EQ(bindings.find(HapticBindings::gestureOf(name, true, false, true)), HapticAction::None) << name;
  }
  bindings.set(HapticAction::Screenshot, "Ctrl+s");
  EXPECT_EQ(bindings.find(HapticBindings::gestureOf("s", true, false)), HapticAction::Screenshot);
  EXPECT_EQ(bindings.find("s"), HapticAction::None);
}

TEST(HapticBindings, HearsCtrlWithALetterWhileCapsLockIsOn)
{
  const HapticBindings bindings;
  EXPECT_EQ(bindings.find(HapticBindings::gestureOf("Z", true, false)), HapticAction::UndoModel);
  EXPECT_EQ(bindings.find(HapticBindings::gestureOf("Z", true, true)), HapticAction::None);
}

TEST(HapticBindings, DoesNotTakeAnUnboundDragForThePlainOne)
{
  const HapticBindings bindings;
  EXPECT_EQ(bindings.find("Ctrl+Shift+left"), HapticAction::ShiftModelDrag);
  EXPECT_EQ(bindings.find("Ctrl+right"), HapticAction::None);
}

TEST(HapticBindings, TakesAGestureFromTheActionThatHadIt)
{
  HapticBindings bindings;
  EXPECT_TRUE(bindings.set(HapticAction::TurnModelDrag, "left Shift+right left"));
  EXPECT_EQ(bindings.get(HapticAction::TurnModelDrag), "Shift+right left");
  EXPECT_EQ(bindings.get(HapticAction::TurnViewDrag), "");
  EXPECT_EQ(bindings.find("left"), HapticAction::TurnModelDrag);
  EXPECT_EQ(bindings.find("Shift+left"), HapticAction::None);
  EXPECT_FALSE(bindings.set(HapticAction::None, "h"));
  EXPECT_EQ(bindings.find("h"), HapticAction::Help);
}

TEST(HapticBindings, LabelsTheFirstGestureAsOnTheKeyboard)
{
  HapticBindings bindings;
  EXPECT_EQ(bindings.firstLabel(HapticAction::Axes), "A");
  EXPECT_EQ(bindings.firstLabel(HapticAction::TurnX), "x") << "X turns back";
  EXPECT_EQ(bindings.firstLabel(HapticAction::HandAway), "Page Up");
  EXPECT_EQ(bindings.firstLabel(HapticAction::TurnModelDrag), "Shift+left drag");
  bindings.set(HapticAction::Axes, "F5 a");
  EXPECT_EQ(bindings.firstLabel(HapticAction::Axes), "F5");
  bindings.set(HapticAction::Axes, "");
  EXPECT_EQ(bindings.firstLabel(HapticAction::Axes), "");
  EXPECT_EQ(bindings.firstLabel(HapticAction::None), "");
}

TEST(HapticBindings, FindsTheButtonsOfTheDeviceWithWhateverModifiersAreHeld)
{
  const HapticBindings bindings;
  EXPECT_EQ(bindings.find("hand1"), HapticAction::ShiftModelByHand);
  EXPECT_EQ(bindings.find("Ctrl+hand3"), HapticAction::IndexByHand);
  EXPECT_EQ(bindings.find("hand5"), HapticAction::None);
  EXPECT_EQ(bindings.find("1"), HapticAction::HandButton1);
}

TEST(HapticBindings, HasANameForEachActionAndFindsItByThat)
{
  const auto actions = pointhaptics::hapticActions();
  EXPECT_EQ(int(actions.size()), int(HapticAction::None)) << "an action without a line in the table";
  for (HapticAction action : actions)
  {
    EXPECT_EQ(pointhaptics::hapticActionFromName(pointhaptics::hapticActionName(action)), action);
  }
  EXPECT_STREQ(pointhaptics::hapticActionName(HapticAction::TurnBackX), "turn-back-x");
  EXPECT_EQ(pointhaptics::hapticActionFromName("TurnBackX"), HapticAction::None);
}

TEST(HapticBindings, TellsGesturesFromWhatCannotBeMade)
{
  for (const char* gesture : { "x", "F1", "plus", "Ctrl+z", "Ctrl+Shift+left", "hand2", "KP_Add", "wheel" })
  {
    EXPECT_TRUE(HapticBindings::isGesture(gesture)) << gesture;
  }
  for (const char* gesture : { "", "Ctrl+", "Alt+x", "Shift+Ctrl+x", "x y", "+", "Strg-x" })
  {
    EXPECT_FALSE(HapticBindings::isGesture(gesture)) << gesture;
  }
}

TEST(HapticBindings, DescribesWhatIsBoundAndNothingElse)
{
  HapticBindings bindings;
  bindings.set(HapticAction::Screenshot, "F2");
  bindings.set(HapticAction::UndoModel, "");
  const std::string text = bindings.describe();
  EXPECT_NE(text.find("F2 "), std::string::npos);
  EXPECT_EQ(text.find("undo"), std::string::npos);
  EXPECT_NE(text.find("Shift+left drag, x, X, y, Y, z, Z"), std::string::npos);
}

} // namespace
