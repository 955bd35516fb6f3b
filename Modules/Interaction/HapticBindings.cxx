#include "HapticBindings.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <sstream>

namespace pointhaptics
{
namespace
{

struct Default
{
  HapticAction action;
  const char* name;
  const char* gestures;
};

constexpr Default kDefaults[] = {
  { HapticAction::TurnViewDrag, "turn-view-drag", "left" },
  { HapticAction::PanViewDrag, "pan-view-drag", "middle" },
  { HapticAction::DollyViewDrag, "dolly-view-drag", "right" },
  { HapticAction::DollyViewWheel, "dolly-view-wheel", "wheel" },
  { HapticAction::ResetView, "reset-view", "r" },
  { HapticAction::TurnModelDrag, "turn-model-drag", "Shift+left" },
  { HapticAction::TurnX, "turn-x", "x" },
  { HapticAction::TurnBackX, "turn-back-x", "X" },
  { HapticAction::TurnY, "turn-y", "y" },
  { HapticAction::TurnBackY, "turn-back-y", "Y" },
  { HapticAction::TurnZ, "turn-z", "z" },
  { HapticAction::TurnBackZ, "turn-back-z", "Z" },
  { HapticAction::ShiftModelDrag, "shift-model-drag", "Shift+middle Ctrl+Shift+left" },
  { HapticAction::ShiftLeft, "shift-left", "Left" },
  { HapticAction::ShiftRight, "shift-right", "Right" },
  { HapticAction::ShiftUp, "shift-up", "Up" },
  { HapticAction::ShiftDown, "shift-down", "Down" },
  { HapticAction::ZoomModelWheel, "zoom-model-wheel", "Shift+wheel" },
  { HapticAction::ZoomIn, "zoom-in", "plus equal KP_Add" },
  { HapticAction::ZoomOut, "zoom-out", "minus underscore KP_Subtract" },
  { HapticAction::ResetModel, "reset-model", "0 Home KP_0 KP_Home" },
  { HapticAction::UndoModel, "undo-model", "u Ctrl+z" },
  { HapticAction::MoveHandDrag, "move-hand-drag", "Ctrl+left" },
  { HapticAction::HandDepthWheel, "hand-depth-wheel", "Ctrl+wheel" },
  { HapticAction::HandAway, "hand-away", "Prior KP_Prior Page_Up" },
  { HapticAction::HandBack, "hand-back", "Next KP_Next Page_Down" },
  { HapticAction::HandMode, "hand-mode", "f space" },
  { HapticAction::PushPointer, "push-pointer", "g" },
  { HapticAction::ShiftModelByHand, "shift-model-by-hand", "hand1" },
  { HapticAction::TurnModelByHand, "turn-model-by-hand", "hand2" },
  { HapticAction::IndexByHand, "index-by-hand", "hand3" },
  { HapticAction::ZoomModelByHand, "zoom-model-by-hand", "hand4" },
  { HapticAction::HandButton1, "hand-button-1", "1 KP_1" },
  { HapticAction::HandButton2, "hand-button-2", "2 KP_2" },
  { HapticAction::HandButton3, "hand-button-3", "3 KP_3" },
  { HapticAction::HandButton4, "hand-button-4", "4 KP_4" },
  { HapticAction::Pick, "pick", "p" },
  { HapticAction::Help, "help", "h question" },
  { HapticAction::Sliders, "sliders", "v" },
  { HapticAction::ServoPanel, "servo-panel", "i" },
  { HapticAction::Chart, "chart", "c" },
  { HapticAction::PauseChart, "pause-chart", "t" },
  { HapticAction::Axes, "axes", "a" },
  { HapticAction::Figure, "figure", "o" },
  { HapticAction::Colors, "colors", "m" },
  { HapticAction::Ambient, "ambient", "l" },
  { HapticAction::NextFile, "next-file", "n" },
  { HapticAction::PreviousFile, "previous-file", "b" },
  { HapticAction::Screenshot, "screenshot", "s" },
  { HapticAction::WriteSettings, "write-settings", "w" },
  { HapticAction::Quit, "quit", "q Escape" },
};

/// A line of the help: what the actions have in common, and their gestures one after the other.
struct Line
{
  const char* group;
  const char* words;
  std::vector<HapticAction> actions;
};

const std::vector<Line>& lines()
{
  using A = HapticAction;
  static const std::vector<Line> all = {
    { "Look", "turn the view", { A::TurnViewDrag } },
    { "", "pan", { A::PanViewDrag } },
    { "", "nearer, farther", { A::DollyViewDrag, A::DollyViewWheel } },
    { "", "whole workspace", { A::ResetView } },
    { "Model", "turn",
      { A::TurnModelDrag, A::TurnX, A::TurnBackX, A::TurnY, A::TurnBackY, A::TurnZ, A::TurnBackZ } },
    { "", "shift", { A::ShiftModelDrag, A::ShiftLeft, A::ShiftRight, A::ShiftUp, A::ShiftDown } },
    { "", "zoom", { A::ZoomModelWheel, A::ZoomIn, A::ZoomOut } },
    { "", "undo the last move", { A::UndoModel } },
    { "", "back to the start", { A::ResetModel } },
    { "Hand", "move in the view plane", { A::MoveHandDrag } },
    { "", "depth", { A::HandDepthWheel, A::HandAway, A::HandBack } },
    { "", "hand follows the mouse", { A::HandMode } },
    { "", "touch pushes the mouse pointer", { A::PushPointer } },
    { "", "held: hand shifts the model", { A::ShiftModelByHand } },
    { "", "held: hand turns the model", { A::TurnModelByHand } },
    { "", "held: workspace moves over the model", { A::IndexByHand } },
    { "", "held: hand zooms the model", { A::ZoomModelByHand } },
    { "", "buttons of the simulated hand",
      { A::HandButton1, A::HandButton2, A::HandButton3, A::HandButton4 } },
    { "Show", "this help", { A::Help } },
    { "", "the point under the mouse", { A::Pick } },
    { "", "sliders of the touch", { A::Sliders } },
    { "", "servo loop and device", { A::ServoPanel } },
    { "", "chart, pause the chart", { A::Chart, A::PauseChart } },
    { "", "axes and bounds", { A::Axes } },
    { "", "figure: cloud, cube, touch only", { A::Figure } },
    { "", "colour by the next thing", { A::Colors } },
    { "", "ambient light from the normals", { A::Ambient } },
    { "Program", "next, previous file", { A::NextFile, A::PreviousFile } },
    { "", "screenshot", { A::Screenshot } },
    { "", "write the settings to a file", { A::WriteSettings } },
    { "", "quit", { A::Quit } },
  };
  return all;
}

/// Without its modifiers.
std::string nameOf(const std::string& gesture)
{
  const std::size_t plus = gesture.rfind('+');
  return plus == std::string::npos ? gesture : gesture.substr(plus + 1);
}

bool isLetter(const std::string& name)
{
  return name.size() == 1 && std::isalpha(static_cast<unsigned char>(name[0]));
}

bool isButton(const std::string& name)
{
  return name == "left" || name == "middle" || name == "right";
}

bool isHandButton(const std::string& name)
{
  return name.size() == 5 && name.compare(0, 4, "hand") == 0 && name[4] >= '1' && name[4] <= '4';
}

bool isDrag(HapticAction action)
{
  return action == HapticAction::TurnViewDrag || action == HapticAction::PanViewDrag ||
    action == HapticAction::DollyViewDrag || action == HapticAction::TurnModelDrag ||
    action == HapticAction::ShiftModelDrag || action == HapticAction::MoveHandDrag;
}

/// As it stands on the keyboard.
std::string spoken(std::string gesture)
{
  static const std::map<std::string, std::string> names = { { "plus", "+" }, { "minus", "-" },
    { "Prior", "Page Up" }, { "Next", "Page Down" }, { "space", "Space" }, { "question", "?" },
    { "equal", "=" }, { "underscore", "_" } };
  const std::size_t plus = gesture.rfind('+');
  const std::size_t begin = plus == std::string::npos ? 0 : plus + 1;
  const std::string name = gesture.substr(begin);
  const auto known = names.find(name);
  const std::string word = isHandButton(name) ? "device's button " + name.substr(4) : name;
  return gesture.substr(0, begin) + (known == names.end() ? word : known->second);
}

/// Letters in capitals, as on the keys, where both cases do the same.
std::string label(const HapticBindings& bindings, const std::string& gesture)
{
  std::string text = spoken(gesture);
  const std::size_t last = text.size() - 1;
  const bool isSmallLetter =
    std::islower(static_cast<unsigned char>(text[last])) && (last == 0 || text[last - 1] == '+');
  if (isSmallLetter)
  {
    std::string capital = gesture;
    capital.back() = static_cast<char>(std::toupper(static_cast<unsigned char>(capital.back())));
    text[last] = bindings.find(capital) == bindings.find(gesture) ? capital.back() : text[last];
  }
  return isButton(nameOf(gesture)) ? text + (isDrag(bindings.find(gesture)) ? " drag" : " click") : text;
}

std::string joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : ", ") + word;
  }
  const std::string arrows = "Left, Right, Up, Down";
  const std::size_t found = text.find(arrows);
  return found == std::string::npos ? text : text.replace(found, arrows.size(), "arrow keys");
}

std::string row(const std::string& group, const std::string& gestures, const char* words)
{
  char text[200];
  std::snprintf(text, sizeof(text), "%-8s %-34s %s", group.c_str(), gestures.c_str(), words);
  return text;
}

} // namespace

const char* hapticActionName(HapticAction action) noexcept
{
  for (const Default& entry : kDefaults)
  {
    if (entry.action == action)
    {
      return entry.name;
    }
  }
  return "none";
}

HapticAction hapticActionFromName(const std::string& name) noexcept
{
  for (const Default& entry : kDefaults)
  {
    if (name == entry.name)
    {
      return entry.action;
    }
  }
  return HapticAction::None;
}

std::vector<HapticAction> hapticActions()
{
  std::vector<HapticAction> actions;
  for (const Default& entry : kDefaults)
  {
    actions.push_back(entry.action);
  }
  return actions;
}

HapticBindings::HapticBindings()
{
  for (const Default& entry : kDefaults)
  {
    this->set(entry.action, entry.gestures);
  }
}

bool HapticBindings::set(HapticAction action, const std::string& gestures)
{
  if (action == HapticAction::None)
  {
    return false;
  }
  std::vector<std::string> own;
  std::istringstream stream(gestures);
  for (std::string gesture; stream >> gesture;)
  {
    for (auto& entry : gestures_)
    {
      std::vector<std::string>& others = entry.second;
      others.erase(std::remove(others.begin(), others.end(), gesture), others.end());
    }
    own.erase(std::remove(own.begin(), own.end(), gesture), own.end());
    own.push_back(gesture);
  }
  gestures_[action] = own;
  return true;
}

std::string HapticBindings::get(HapticAction action) const
{
  std::string text;
  const auto found = gestures_.find(action);
  for (const std::string& gesture : found == gestures_.end() ? std::vector<std::string>() : found->second)
  {
    text += (text.empty() ? "" : " ") + gesture;
  }
  return text;
}

std::string HapticBindings::firstLabel(HapticAction action) const
{
  const std::string gestures = this->get(action);
  return gestures.empty() ? gestures : label(*this, gestures.substr(0, gestures.find(' ')));
}

HapticAction HapticBindings::find(const std::string& gesture) const
{
  const auto exact = [this](const std::string& wanted)
  {
    for (const auto& [action, gestures] : gestures_)
    {
      if (std::find(gestures.begin(), gestures.end(), wanted) != gestures.end())
      {
        return action;
      }
    }
    return HapticAction::None;
  };
  const HapticAction found = exact(gesture);
  std::string name = nameOf(gesture);
  if (found != HapticAction::None || name.empty() || isButton(name) || name == "wheel")
  {
    return found;
  }
  const bool isCommand = gesture.compare(0, 5, "Ctrl+") == 0 || gesture.compare(0, 4, "Alt+") == 0;
  if (isCommand && isLetter(name))
  {
    return HapticAction::None;
  }
  if (exact(name) != HapticAction::None)
  {
    return exact(name);
  }
  name[0] = name.size() == 1 ? static_cast<char>(std::tolower(static_cast<unsigned char>(name[0]))) : name[0];
  return exact(name);
}

bool HapticBindings::isGesture(const std::string& gesture)
{
  std::string rest = gesture;
  for (const char* modifier : { "Ctrl+", "Shift+" })
  {
    const std::size_t length = std::string(modifier).size();
    rest = rest.compare(0, length, modifier) == 0 ? rest.substr(length) : rest;
  }
  const auto partOfWord = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !rest.empty() && std::all_of(rest.begin(), rest.end(), partOfWord);
}

std::string HapticBindings::gestureOf(const std::string& name, bool control, bool shift, bool alt)
{
  const std::string text = std::string(alt ? "Alt+" : "") + (control ? "Ctrl+" : "");
  if (isLetter(name) && (shift || control))
  {
    const auto letter = static_cast<unsigned char>(name[0]);
    return text + static_cast<char>(shift ? std::toupper(letter) : std::tolower(letter));
  }
  return text + (shift ? "Shift+" : "") + name;
}

std::string HapticBindings::describe() const
{
  std::string text;
  std::string group;
  for (const Line& line : lines())
  {
    group = *line.group ? line.group : group;
    // The first gesture of each action; an action alone in its line shows two.
    std::vector<std::string> gesturesOfLine;
    for (HapticAction action : line.actions)
    {
      std::istringstream gestures(this->get(action));
      std::string gesture;
      for (int i = 0; i < (line.actions.size() == 1 ? 2 : 1) && gestures >> gesture; ++i)
      {
        gesturesOfLine.push_back(label(*this, gesture));
      }
    }
    if (!gesturesOfLine.empty())
    {
      text += row(group, joined(gesturesOfLine), line.words) + "\n";
      group = " ";
    }
  }
  text += row("", "files dropped on the window", "open them") + "\n";
  text += row("", "Escape while a file is read", "keep the former cloud");
  return text;
}

} // namespace pointhaptics
