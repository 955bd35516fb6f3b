#include "Gesture.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace pointhaptics
{
namespace
{

/// Returns the gesture without its modifiers.
std::string nameOf(const std::string& gesture)
{
  const std::size_t plus = gesture.rfind('+');
  return plus == std::string::npos ? gesture : gesture.substr(plus + 1);
}

bool isLetter(const std::string& name)
{
  return name.size() == 1 && std::isalpha(static_cast<unsigned char>(name[0]));
}

bool isDeviceButton(const std::string& name)
{
  return name.size() == 5 && name.compare(0, 4, "hand") == 0 && name[4] >= '1' && name[4] <= '4';
}

char lower(char c)
{
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

char upper(char c)
{
  return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
}

} // namespace

std::string gestureOf(const std::string& name, bool control, bool shift, bool alt)
{
  const std::string text = std::string(alt ? "Alt+" : "") + (control ? "Ctrl+" : "");
  if (isLetter(name) && (shift || control))
  {
    return text + (shift ? upper(name[0]) : lower(name[0]));
  }
  return text + (shift ? "Shift+" : "") + name;
}

bool isGesture(const std::string& gesture)
{
  std::string rest = gesture;
  for (const char* modifier : { "Walk+", "Ctrl+", "Shift+" })
  {
    const std::size_t length = std::string(modifier).size();
    rest = rest.compare(0, length, modifier) == 0 ? rest.substr(length) : rest;
  }
  const auto partOfWord = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !rest.empty() && std::all_of(rest.begin(), rest.end(), partOfWord);
}

std::vector<std::string> fallbacksOf(const std::string& gesture)
{
  std::string name = nameOf(gesture);
  const bool hasCommandModifier = gesture.compare(0, 5, "Ctrl+") == 0 || gesture.compare(0, 4, "Alt+") == 0;
  if (name.empty() || isMouseButton(name) || name == "wheel" || name == kDoubleClick ||
    (hasCommandModifier && isLetter(name)))
  {
    return {};
  }
  std::vector<std::string> others{ name };
  if (name.size() == 1)
  {
    others.emplace_back(1, lower(name[0]));
  }
  return others;
}

std::string gestureLabel(const std::string& gesture)
{
  static const std::map<std::string, std::string> labels = { { "plus", "+" }, { "minus", "-" },
    { "Prior", "Page Up" }, { "Next", "Page Down" }, { "space", "Space" }, { "question", "?" },
    { "equal", "=" }, { kDoubleClick, "double click" }, { "underscore", "_" }, { "bracketleft", "[" },
    { "bracketright", "]" } };
  const std::string name = nameOf(gesture);
  std::string modifiers = gesture.substr(0, gesture.size() - name.size());
  modifiers = modifiers == "Walk+" ? "" : modifiers; // the line of the help says so
  const auto known = labels.find(name);
  const std::string word = isDeviceButton(name) ? "device's button " + name.substr(4) : name;
  return modifiers + (known == labels.end() ? word : known->second);
}

std::string capitalOf(const std::string& gesture)
{
  const std::string name = nameOf(gesture);
  return isLetter(name) && name[0] == lower(name[0]) ? gesture.substr(0, gesture.size() - 1) + upper(name[0])
                                                     : std::string();
}

bool isMouseButton(const std::string& gesture)
{
  const std::string name = nameOf(gesture);
  return name == "left" || name == "middle" || name == "right";
}

} // namespace pointhaptics
