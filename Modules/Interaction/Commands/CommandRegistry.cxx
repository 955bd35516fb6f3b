#include "CommandRegistry.h"

#include "Gesture.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace pointhaptics
{
namespace
{

constexpr std::size_t kGroupWidth = 8;
constexpr std::size_t kGestureWidth = 34;

std::vector<std::string> wordsOf(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
  {
    words.erase(std::remove(words.begin(), words.end(), word), words.end());
    words.push_back(word);
  }
  return words;
}

/// Gives the four arrow keys one name together.
std::string withArrowKeys(std::string text)
{
  const std::string arrows = "Left, Right, Up, Down";
  const std::size_t found = text.find(arrows);
  return found == std::string::npos ? text : text.replace(found, arrows.size(), "arrow keys");
}

} // namespace

bool runOnce(const Command* command)
{
  const auto* action = command ? std::get_if<std::function<void()>>(&command->action) : nullptr;
  if (action && *action)
  {
    const std::function<void()> copy = *action; // the command may change the registry
    copy();
  }
  return action != nullptr;
}

CommandRegistry::Entry* CommandRegistry::entryOf(const std::string& name)
{
  const auto found = std::find_if(entries_.begin(), entries_.end(),
    [&name](const Entry& entry) { return !name.empty() && entry.command.name == name; });
  return found == entries_.end() ? nullptr : &*found;
}

const CommandRegistry::Entry* CommandRegistry::entryOf(const std::string& name) const
{
  return const_cast<CommandRegistry*>(this)->entryOf(name);
}

void CommandRegistry::reportChange() const
{
  if (changed_)
  {
    changed_();
  }
}

void CommandRegistry::setGestures(Entry& entry, const std::string& gestures)
{
  const std::vector<std::string> own = wordsOf(gestures);
  for (Entry& other : entries_)
  {
    std::vector<std::string>& theirs = other.gestures;
    const auto isTaken = [&own](const std::string& gesture)
    { return std::find(own.begin(), own.end(), gesture) != own.end(); };
    theirs.erase(std::remove_if(theirs.begin(), theirs.end(), isTaken), theirs.end());
  }
  entry.gestures = own;
}

void CommandRegistry::add(Command command)
{
  if (Entry* same = this->entryOf(command.name))
  {
    same->command = std::move(command);
  }
  else
  {
    for (const std::string& gesture : wordsOf(command.gestures))
    {
      if (const Command* other = this->findExactly(gesture))
      {
        conflicts_.push_back(gesture + ": " + other->name + ", " + command.name);
      }
    }
    entries_.push_back({ std::move(command), {} });
    this->setGestures(entries_.back(), entries_.back().command.gestures);
  }
  this->reportChange();
}

bool CommandRegistry::remove(const std::string& name)
{
  const Entry* entry = this->entryOf(name);
  if (entry)
  {
    entries_.erase(entries_.begin() + (entry - entries_.data()));
    this->reportChange();
  }
  return entry != nullptr;
}

void CommandRegistry::addNote(const std::string& group, const std::string& what, const std::string& help)
{
  Command note;
  note.group = group;
  note.help = help;
  note.gestures = what;
  entries_.push_back({ std::move(note), {} });
  this->reportChange();
}

const Command* CommandRegistry::get(const std::string& name) const
{
  const Entry* entry = this->entryOf(name);
  return entry ? &entry->command : nullptr;
}

std::vector<std::string> CommandRegistry::names() const
{
  std::vector<std::string> names;
  for (const Entry& entry : entries_)
  {
    names.insert(names.end(), entry.command.name.empty() ? 0 : 1, entry.command.name);
  }
  return names;
}

bool CommandRegistry::bind(const std::string& name, const std::string& gestures)
{
  Entry* entry = this->entryOf(name);
  if (entry)
  {
    this->setGestures(*entry, gestures);
    this->reportChange();
  }
  return entry != nullptr;
}

void CommandRegistry::bind(const std::vector<std::string>& bindings)
{
  for (const std::string& each : bindings)
  {
    const std::size_t equals = std::min(each.find('='), each.size());
    this->bind(each.substr(0, equals), each.substr(std::min(equals + 1, each.size())));
  }
}

std::string CommandRegistry::bindings(const std::string& name) const
{
  const Entry* entry = this->entryOf(name);
  return entry ? fmt::format("{}", fmt::join(entry->gestures, " ")) : std::string();
}

std::string CommandRegistry::label(const std::string& name) const
{
  const Entry* entry = this->entryOf(name);
  if (!entry || entry->gestures.empty())
  {
    return {};
  }
  const std::string words = this->labelOf(entry->gestures.front());
  const bool isCapital = words.size() == 1 && words[0] >= 'A' && words[0] <= 'Z';
  return isCapital && words == entry->gestures.front() ? "Shift+" + words : words;
}

const Command* CommandRegistry::findExactly(const std::string& gesture) const
{
  for (const Entry& entry : entries_)
  {
    if (std::find(entry.gestures.begin(), entry.gestures.end(), gesture) != entry.gestures.end())
    {
      return &entry.command;
    }
  }
  return nullptr;
}

const Command* CommandRegistry::find(const std::string& gesture) const
{
  std::vector<std::string> names = fallbacksOf(gesture);
  names.insert(names.begin(), gesture);
  const Command* found = nullptr;
  for (const std::string& name : names)
  {
    found = found || modifier_.empty() ? found : this->findExactly(modifier_ + name);
    found = found ? found : this->findExactly(name);
  }
  return found;
}

/// Label of a gesture: letters in capitals, as on the keys, where both cases do the same; "drag" or "click"
/// for the mouse.
std::string CommandRegistry::labelOf(const std::string& gesture) const
{
  const Command* command = this->find(gesture);
  if (isMouseButton(gesture))
  {
    const bool isDrag = command && std::holds_alternative<DragAction>(command->action);
    return gestureLabel(gesture) + (isDrag ? " drag" : " click");
  }
  const std::string capital = capitalOf(gesture);
  return gestureLabel(!capital.empty() && this->find(capital) == command ? capital : gesture);
}

/// Labels for a line of the help: the first gesture of each command; a command alone in its line shows two.
std::string CommandRegistry::labelsOf(const std::vector<const Entry*>& line) const
{
  std::vector<std::string> labels;
  for (const Entry* entry : line)
  {
    const Command& command = entry->command;
    if (command.name.empty())
    {
      labels.push_back(command.gestures);
    }
    else if (!command.isAvailable || command.isAvailable())
    {
      const std::size_t count = std::min<std::size_t>(entry->gestures.size(), line.size() == 1 ? 2 : 1);
      for (std::size_t i = 0; i < count; ++i)
      {
        labels.push_back(this->labelOf(entry->gestures[i]));
      }
    }
  }
  return withArrowKeys(fmt::format("{}", fmt::join(labels, ", ")));
}

std::string CommandRegistry::help() const
{
  using Line = std::pair<std::string, std::vector<const Entry*>>; // its words, and the commands
  std::vector<std::string> groups;
  std::map<std::string, std::vector<Line>> linesOfGroup;
  for (const Entry& entry : entries_)
  {
    std::vector<Line>& lines = linesOfGroup[entry.command.group];
    groups.insert(groups.end(), lines.empty() ? 1 : 0, entry.command.group);
    auto line = std::find_if(
      lines.begin(), lines.end(), [&entry](const Line& each) { return each.first == entry.command.help; });
    line = line == lines.end() ? lines.insert(lines.end(), Line(entry.command.help, {})) : line;
    line->second.push_back(&entry);
  }
  std::string text;
  for (const std::string& group : groups)
  {
    std::string heading = group;
    for (const Line& line : linesOfGroup[group])
    {
      const std::string labels = this->labelsOf(line.second);
      if (!labels.empty())
      {
        text += fmt::format("{}{:<{}} {:<{}} {}", text.empty() ? "" : "\n", heading, kGroupWidth, labels,
          kGestureWidth, line.first);
        heading.clear();
      }
    }
  }
  return text;
}

CommandRegistry CommandRegistry::described() const
{
  CommandRegistry copy = *this;
  copy.changed_ = nullptr;
  for (Entry& entry : copy.entries_)
  {
    entry.command.isAvailable = nullptr;
    std::visit([](auto& action) { action = {}; }, entry.command.action);
  }
  return copy;
}

} // namespace pointhaptics
