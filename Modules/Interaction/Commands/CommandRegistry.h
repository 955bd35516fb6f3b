/// @file
/// Everything that keys, mouse and the device's buttons do: one entry a command.
#pragma once

#include "Core/Base/Vector3.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace pointhaptics
{

/// Functions of a drag, from the press of a mouse button to its release. Each may be empty; without @c move
/// the mouse is left to VTK's style.
struct DragAction
{
  std::function<void()> begin = {};
  std::function<void()> move = {};
  std::function<void()> end = {};
};

/// Function of the wheel, for a notch: +1 away from the person, -1 towards the person.
struct WheelAction
{
  std::function<void(int direction)> turn;
};

/// Functions of a key that is held. A key that repeats is up and down again each time.
struct HoldAction
{
  std::function<void(bool isDown)> hold;
};

/// Functions of a button of the haptic device that is held: the hand holds the model instead of feeling it.
/// @c move gets the motion of the hand since the last call, metres in the workspace; @c end may be empty.
struct GripAction
{
  std::function<void(const Vec3& way)> move = {};
  std::function<void()> end = {};
};

/// A plain function is called once per key press, click or press of the device's button.
using CommandAction = std::variant<std::function<void()>, DragAction, WheelAction, HoldAction, GripAction>;

/// Something that a user can do by a key, a gesture or a button of the device.
struct Command
{
  std::string name;     ///< Name for bind() and --bind, such as "write-settings".
  std::string gestures; ///< Default gestures, separated by spaces; see Gesture.h. Empty: none.
  std::string group;    ///< Heading in the help.
  std::string help;     ///< Commands of a group with the same text share a line of the help.
  CommandAction action = {};
  /// True if the program has what the command works on; the help leaves it out otherwise. Empty: always.
  std::function<bool()> isAvailable = {};
};

/// Calls the function of @p command if it is of the kind that happens once. False: it is null or of another
/// kind.
POINTHAPTICSINTERACTION_EXPORT bool runOnce(const Command* command);

/// The commands of one window, and the table from gestures to them. A gesture has one command at most.
///
/// A program adds a key, its line in the help and its name for bindings by one call:
/// @code
/// commands.add({ "grid", "g", "Show", "a grid on the floor", [&] { grid.toggle(); } });
/// @endcode
/// Not thread safe: GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT CommandRegistry
{
public:
  /// Adds @p command with its default gestures, which are taken from the commands that had them and named by
  /// conflicts(). One with the same name is replaced, and its gestures in force stay.
  void add(Command command);
  /// The default gestures that two commands were added with, as "plus: scale-up, points-larger". A program
  /// whose keys shall not depend on the order of add() binds the first of the two elsewhere and has none.
  const std::vector<std::string>& conflicts() const { return conflicts_; }
  /// False: there is no such command.
  bool remove(const std::string& name);
  /// Adds a line to the help that is no command, such as "files dropped on the window".
  void addNote(const std::string& group, const std::string& what, const std::string& help);

  /// Returns the command of that name, or null. Valid until the next add() or remove().
  const Command* get(const std::string& name) const;
  /// Runs the command as its key does, for a button or menu of the program. False: see runOnce().
  bool run(const std::string& name) const { return runOnce(this->get(name)); }
  /// All names, in the order they were added.
  std::vector<std::string> names() const;

  /// Gives the command @p name these gestures, separated by spaces, in place of those it has; they are taken
  /// from the commands that had them. Empty: it cannot be reached. False, and nothing changes: there is no
  /// such command.
  bool bind(const std::string& name, const std::string& gestures);
  /// Binds each NAME=GESTURES of @p bindings. Texts that are no binding or name no command are left out.
  void bind(const std::vector<std::string>& bindings);
  /// The gestures of @p name, separated by spaces, in the order they were given.
  std::string bindings(const std::string& name) const;
  /// Label of the first gesture: "A", "Shift+A" where the small letter is another, "Page Up", "Shift+left
  /// drag". Empty: there is none.
  std::string label(const std::string& name) const;
  /// The command that @p gesture runs, or null; see fallbacksOf(). Valid as get()'s.
  const Command* find(const std::string& gesture) const;

  /// Lists the commands in columns, one a line: group, gestures, words. Groups and lines in the order of
  /// their first command. Commands without a gesture, or without the parts they work on, are left out.
  std::string help() const;

  /// Gestures with @p modifier, such as "Walk+", go before those without, until it is set to "".
  void setModifier(const std::string& modifier) { modifier_ = modifier; }

  /// Called after each change.
  void setObserver(std::function<void()> changed) { changed_ = std::move(changed); }
  /// Copies the commands without functions and observer, so that they can be bound and described, but not
  /// run. The help of the copy lists all of them.
  CommandRegistry described() const;

private:
  struct Entry
  {
    Command command; ///< A note has no name; its subject stands in place of the gesture.
    std::vector<std::string> gestures;
  };
  Entry* entryOf(const std::string& name);
  const Entry* entryOf(const std::string& name) const;
  void setGestures(Entry& entry, const std::string& gestures);
  const Command* findExactly(const std::string& gesture) const;
  std::string labelOf(const std::string& gesture) const;
  std::string labelsOf(const std::vector<const Entry*>& line) const;
  void reportChange() const;

  std::vector<Entry> entries_;
  std::vector<std::string> conflicts_;
  std::string modifier_;
  std::function<void()> changed_;
};

/// Adds commands of one group of the help that work on a part. Commands may live for longer than their part.
template <typename Part>
class CommandGroup
{
public:
  /// @p part returns the part while it is there. The help leaves the commands out where it is gone, or where
  /// @p isAvailable, if given, is false.
  CommandGroup(CommandRegistry& commands, const char* group, std::function<Part*()> part,
    std::function<bool(Part&)> isAvailable = {})
    : commands_(commands)
    , group_(group)
    , part_(std::move(part))
    , isAvailable_(std::move(isAvailable))
  {
  }

  /// Wraps @p action, a function or member function: it is called with the part and @p arguments.
  template <typename Action, typename... Arguments>
  auto call(Action action, Arguments... arguments) const
  {
    return [part = part_, action, arguments...](
             auto... more) -> std::invoke_result_t<const Action&, Part&, Arguments..., decltype(more)...>
    {
      if (Part* there = part())
      {
        std::invoke(action, *there, arguments..., more...);
      }
    };
  }
  /// Adds a command. @p action is a CommandAction, or what call() takes.
  template <typename Action, typename... Arguments>
  void add(const char* name, const char* gestures, const char* help, Action action, Arguments... arguments)
  {
    const auto isThere = [part = part_, isAvailable = isAvailable_]
    {
      Part* there = part();
      return there && (!isAvailable || isAvailable(*there));
    };
    if constexpr (std::is_constructible_v<CommandAction, Action>)
    {
      commands_.add({ name, gestures, group_, help, CommandAction(std::move(action)), isThere });
    }
    else
    {
      commands_.add({ name, gestures, group_, help, this->call(action, arguments...), isThere });
    }
  }

private:
  CommandRegistry& commands_;
  const char* group_;
  std::function<Part*()> part_;
  std::function<bool(Part&)> isAvailable_;
};

} // namespace pointhaptics
