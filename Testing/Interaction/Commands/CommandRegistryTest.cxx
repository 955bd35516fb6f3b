#include "CommandRegistry.h"
#include "CommandInput.h"
#include "Gesture.h"
#include "vtkInteractorStyleHaptic.h"

#include <gtest/gtest.h>
#include <vtkNew.h>

#include <set>
#include <string>

using namespace pointhaptics;

namespace
{

/// Commands of every style.
class StyleCommands : public ::testing::Test
{
protected:
  /// Name of what @p gesture does; empty: nothing.
  std::string find(const std::string& gesture) const
  {
    const Command* command = commands.find(gesture);
    return command ? command->name : std::string();
  }

  vtkNew<vtkInteractorStyleHaptic> style;
  CommandRegistry& commands = style->GetCommands();
};

Command once(const std::string& name, const std::string& gestures, std::function<void()> function)
{
  return { name, gestures, "Show", "what " + name + " does", std::move(function) };
}

TEST(CommandRegistry, HasGesturesOfAModeBesideTheUsualOnes)
{
  CommandRegistry commands;
  int walked = 0;
  int written = 0;
  commands.add({ "write", "w", "Program", "write", [&written] { ++written; } });
  commands.add({ "go", "Walk+w", "Look", "walk", [&walked] { ++walked; } });
  EXPECT_TRUE(isGesture("Walk+w"));
  runOnce(commands.find("w"));
  commands.setModifier("Walk+");
  runOnce(commands.find("w"));
  runOnce(commands.find("W")); // Caps Lock
  EXPECT_EQ(commands.find("x"), nullptr);
  commands.setModifier("");
  runOnce(commands.find("w"));
  EXPECT_EQ(walked, 2);
  EXPECT_EQ(written, 2);
  EXPECT_EQ(commands.label("go"), "w");
}

} // namespace

TEST_F(StyleCommands, AreFoundByKeysWithWhateverModifiersAreHeld)
{
  EXPECT_EQ(this->find("h"), "help");
  EXPECT_EQ(this->find("H"), "help");
  EXPECT_EQ(this->find(gestureOf("plus", false, true)), "scale-up");
  EXPECT_EQ(this->find(gestureOf("Prior", true, false)), "hand-away");
  EXPECT_EQ(this->find("F13"), "");
  EXPECT_EQ(this->find(""), "");
}

TEST_F(StyleCommands, TellCasesAndModifiersApartWhereBothAreBound)
{
  EXPECT_EQ(this->find("z"), "rotate-z");
  EXPECT_EQ(this->find(gestureOf("z", false, true)), "rotate-back-z");
  EXPECT_EQ(this->find(gestureOf("z", true, false)), "undo-model");
}

TEST_F(StyleCommands, DoNotTakeALetterWithCtrlOrAltForThePlainOne)
{
  for (char letter = 'a'; letter <= 'z'; ++letter)
  {
    const std::string name(1, letter);
    EXPECT_EQ(this->find(gestureOf(name, true, false)), letter == 'z' ? "undo-model" : "") << name;
    EXPECT_EQ(this->find(gestureOf(name, true, true)), "") << name;
    EXPECT_EQ(this->find(gestureOf(name, false, false, true)), "") << name;
    EXPECT_EQ(this->find(gestureOf(name, false, true, true)), "") << name;
    EXPECT_EQ(this->find(gestureOf(name, true, false, true)), "") << name;
  }
  commands.bind("pick", "Ctrl+s");
  EXPECT_EQ(this->find(gestureOf("s", true, false)), "pick");
  EXPECT_EQ(this->find("s"), "");
}

TEST_F(StyleCommands, HearCtrlWithALetterWhileCapsLockIsOn)
{
  EXPECT_EQ(this->find(gestureOf("Z", true, false)), "undo-model");
  EXPECT_EQ(this->find(gestureOf("Z", true, true)), "");
}

TEST_F(StyleCommands, DoNotTakeAnUnboundDragForThePlainOne)
{
  EXPECT_EQ(this->find("Ctrl+Shift+left"), "translate-model-drag");
  EXPECT_EQ(this->find("Ctrl+right"), "");
}

TEST_F(StyleCommands, LoseAGestureToTheCommandThatIsGivenIt)
{
  EXPECT_TRUE(commands.bind("rotate-model-drag", "left Shift+right left"));
  EXPECT_EQ(commands.bindings("rotate-model-drag"), "Shift+right left");
  EXPECT_EQ(commands.bindings("rotate-view-drag"), "");
  EXPECT_EQ(this->find("left"), "rotate-model-drag");
  EXPECT_EQ(this->find("Shift+left"), "");
  EXPECT_FALSE(commands.bind("no-such-command", "h"));
  EXPECT_FALSE(commands.bind("", "h"));
  EXPECT_EQ(this->find("h"), "help");
}

TEST_F(StyleCommands, HaveLabelsAsOnTheKeyboard)
{
  EXPECT_EQ(commands.label("help"), "H");
  EXPECT_EQ(commands.label("rotate-x"), "x") << "X rotates back";
  EXPECT_EQ(commands.label("rotate-back-x"), "Shift+X");
  EXPECT_EQ(commands.label("hand-away"), "Page Up");
  EXPECT_EQ(commands.label("rotate-model-drag"), "Shift+left drag");
  commands.bind({ "help=F5 h", "no binding", "no-such-command=F5" });
  EXPECT_EQ(commands.label("help"), "F5");
  commands.bind("help", "");
  EXPECT_EQ(commands.label("help"), "");
  EXPECT_EQ(commands.label("no-such-command"), "");
  commands.bind("help", "left");
  EXPECT_EQ(commands.label("help"), "left click");
}

TEST_F(StyleCommands, AreFoundByTheButtonsOfTheDeviceWithWhateverModifiersAreHeld)
{
  EXPECT_EQ(this->find("hand1"), "translate-model-by-hand");
  EXPECT_EQ(this->find("Ctrl+hand3"), "index-by-hand");
  EXPECT_EQ(this->find("hand5"), "");
  EXPECT_EQ(this->find("F1"), "hand-button-1");
}

TEST_F(StyleCommands, HaveNamesGesturesAndHelpOfTheirOwn)
{
  const std::vector<std::string> names = commands.names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const std::string& name : names)
  {
    ASSERT_TRUE(commands.get(name)) << name;
    EXPECT_NE(commands.bindings(name), "") << name << " lost its key to a later one";
    EXPECT_NE(commands.get(name)->help, "") << name;
  }
}

TEST_F(StyleCommands, AreInTheHelpWhereTheyHaveAKey)
{
  commands.bind("pick", "F2");
  commands.bind("undo-model", "");
  const std::string text = commands.described().help();
  EXPECT_NE(text.find("F2 "), std::string::npos);
  EXPECT_EQ(text.find("undo"), std::string::npos);
  EXPECT_NE(text.find("Shift+left drag, x, X, y, Y, z, Z"), std::string::npos);
  EXPECT_NE(text.find("arrow keys"), std::string::npos);
}

TEST(Gesture, IsToldFromWhatCannotBeMade)
{
  for (const char* gesture : { "x", "F1", "plus", "Ctrl+z", "Ctrl+Shift+left", "hand2", "KP_Add", "wheel" })
  {
    EXPECT_TRUE(isGesture(gesture)) << gesture;
  }
  for (const char* gesture : { "", "Ctrl+", "Alt+x", "Shift+Ctrl+x", "x y", "+", "Strg-x" })
  {
    EXPECT_FALSE(isGesture(gesture)) << gesture;
  }
}

TEST(CommandRegistry, GivesAKeyAHelpLineAndABindingNameByOneCall)
{
  CommandRegistry commands;
  CommandInput input(commands);
  int grids = 0;
  commands.add({ "grid", "g F4", "Show", "a grid on the floor", [&grids] { ++grids; } });
  EXPECT_TRUE(input.pressKey("g"));
  EXPECT_TRUE(commands.run("grid"));
  EXPECT_EQ(grids, 2);
  EXPECT_EQ(commands.help(), "Show     G, F4                              a grid on the floor");
  commands.bind({ "grid=F9" });
  EXPECT_FALSE(input.pressKey("g"));
  EXPECT_TRUE(input.pressKey("F9"));
  EXPECT_EQ(grids, 3);
  EXPECT_EQ(commands.help(), "Show     F9                                 a grid on the floor");
  EXPECT_TRUE(commands.remove("grid"));
  EXPECT_FALSE(commands.remove("grid"));
  EXPECT_FALSE(input.pressKey("F9"));
  EXPECT_EQ(commands.help(), "");
}

TEST(CommandRegistry, LeavesOutOfTheHelpWhatTheProgramHasNot)
{
  CommandRegistry commands;
  bool hasChart = false;
  Command chart = once("chart", "c", [] {});
  chart.isAvailable = [&hasChart] { return hasChart; };
  commands.add(chart);
  commands.add(once("grid", "g", [] {}));
  EXPECT_EQ(commands.help().find("chart"), std::string::npos);
  EXPECT_EQ(commands.help().find("Show     G"), 0u) << "the heading stays";
  EXPECT_NE(commands.described().help().find("chart"), std::string::npos);
  hasChart = true;
  EXPECT_NE(commands.help().find("chart"), std::string::npos);
}

TEST(CommandRegistry, ReplacesACommandWhereItIsWithItsKeys)
{
  CommandRegistry commands;
  int olds = 0;
  int news = 0;
  commands.add(once("save", "s", [&olds] { ++olds; }));
  commands.add(once("grid", "g", [] {}));
  commands.bind("save", "F2");
  commands.add(once("save", "w", [&news] { ++news; }));
  EXPECT_EQ(commands.bindings("save"), "F2");
  EXPECT_EQ(commands.names(), (std::vector<std::string>{ "save", "grid" }));
  EXPECT_TRUE(commands.run("save"));
  EXPECT_EQ(olds, 0);
  EXPECT_EQ(news, 1);
}

TEST(CommandRegistry, LetsACommandChangeTheRegistryItIsIn)
{
  CommandRegistry commands;
  std::string name = "another name";
  commands.add(once("once", "o",
    [&commands, name]
    {
      for (int i = 0; i < 50; ++i)
      {
        commands.add(once(name + std::to_string(i), "", [] {}));
      }
      commands.remove("once");
      EXPECT_EQ(name, "another name");
    }));
  EXPECT_TRUE(commands.run("once"));
  EXPECT_EQ(commands.names().size(), 50u);
  EXPECT_FALSE(commands.run("once"));
}

TEST(CommandRegistry, ReportsItsChangesAndKeepsADescriptionQuiet)
{
  CommandRegistry commands;
  int changes = 0;
  commands.setObserver([&changes] { ++changes; });
  commands.add(once("grid", "g", [] { FAIL() << "a description does nothing"; }));
  commands.bind("grid", "F4");
  EXPECT_EQ(changes, 2);
  CommandRegistry description = commands.described();
  description.bind("grid", "F5");
  EXPECT_EQ(changes, 2);
  EXPECT_TRUE(description.run("grid"));
  EXPECT_EQ(description.label("grid"), "F5");
  EXPECT_EQ(commands.label("grid"), "F4");
}

TEST(CommandInput, BeginsMovesAndEndsADragAndNoOtherMeanwhile)
{
  CommandRegistry commands;
  std::string log;
  const auto note = [&log](const char* text) { return [&log, text] { log += text; }; };
  commands.add({ "drag", "left", "", "", DragAction{ note("b"), note("m"), note("e") } });
  commands.add({ "other", "right", "", "", DragAction{ note("B"), note("M"), note("E") } });
  commands.add(once("click", "middle", note("c")));
  CommandInput input(commands);
  EXPECT_FALSE(input.moveMouse());
  input.pressButton("left");
  input.pressButton("right");
  EXPECT_TRUE(input.isDragging());
  EXPECT_TRUE(input.moveMouse());
  input.releaseButton();
  input.releaseButton();
  EXPECT_FALSE(input.isDragging());
  input.pressButton("middle");
  EXPECT_EQ(log, "bmec");
}

TEST(CommandInput, DoesNothingForAGestureThatIsOfAnotherKind)
{
  CommandRegistry commands;
  commands.add({ "drag", "d wheel", "", "", DragAction{ [] { FAIL(); }, [] { FAIL(); }, [] { FAIL(); } } });
  commands.add(once("key", "Shift+wheel", [] { FAIL(); }));
  int turns = 0;
  bool isHeld = false;
  commands.add({ "zoom", "Ctrl+wheel k", "", "", WheelAction{ [&turns](int n) { turns += n; } } });
  commands.add({ "hold", "b", "", "", HoldAction{ [&isHeld](bool isDown) { isHeld = isDown; } } });
  commands.add({ "empty", "e left", "", "", DragAction{} });
  CommandInput input(commands);
  EXPECT_FALSE(input.pressKey("d"));
  EXPECT_FALSE(input.pressKey("k"));
  EXPECT_FALSE(input.releaseKey("k"));
  input.turnWheel("wheel", 1);
  input.turnWheel("Shift+wheel", 1);
  input.turnWheel("Ctrl+wheel", -1);
  EXPECT_EQ(turns, -1);
  EXPECT_TRUE(input.pressKey("b"));
  EXPECT_TRUE(isHeld);
  EXPECT_TRUE(input.releaseKey("b"));
  EXPECT_FALSE(isHeld);
  input.pressButton("left");
  EXPECT_FALSE(input.moveMouse()) << "left to VTK's style";
  input.releaseButton();
}

TEST(CommandRegistry, NamesKeysThatTwoCommandsHaveByDefault)
{
  CommandRegistry commands;
  commands.add({ "first", "k F4", "", "", [] {} });
  commands.add({ "second", "l", "", "", [] {} });
  EXPECT_TRUE(commands.conflicts().empty());
  commands.add({ "third", "m F4", "", "", [] {} });
  EXPECT_EQ(commands.conflicts(), std::vector<std::string>{ "F4: first, third" });
  commands.bind("first", "n");
  commands.add({ "fourth", "k", "", "", [] {} });
  EXPECT_EQ(commands.conflicts().size(), 1u);
}
