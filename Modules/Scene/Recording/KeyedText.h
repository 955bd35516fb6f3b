/// @file
/// Lines of words "name=value".
#pragma once

#include "SettingText.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>

namespace pointhaptics
{
namespace keyed
{

/// Words "name=value", written or read: one description of a line, a sequence of calls, does both.
class Line
{
public:
  /// A line that is written; it begins with @p head.
  static Line startingWith(const std::string& head) { return Line(head, false); }
  /// A line that was read, without its head.
  static Line from(const std::string& words) { return Line(words, true); }

  /// The line; of one that was read the word that is wrong, where there is one.
  const std::string& text() const { return text_; }
  /// True where all words were there and right.
  bool isFine() const { return isFine_; }

  /// @p isRequired false: stays as it is where a line that is read has no such word.
  template <typename Value>
  void value(const std::string& name, Value& value, bool isRequired = true)
  {
    const auto word = words_.find(name);
    if (!isRead_)
    {
      text_ += " " + name + "=" + toText(value);
    }
    else if (word == words_.end() ? isRequired : !fromText(word->second, value))
    {
      text_ = isFine_ && word != words_.end() ? name + "=" + word->second : text_;
      isFine_ = false;
    }
  }
  /// All members of @p settings that what is felt depends on: not sets of names.
  template <typename Settings>
  void settings(Settings& settings, const std::string& prefix = {})
  {
    visitSettings(
      settings,
      [this](const std::string& name, auto& member)
      {
        if constexpr (!std::is_same_v<std::decay_t<decltype(member)>, std::set<std::string>>)
        {
          this->value(name, member, false);
        }
      },
      prefix);
  }
  /// As settings(), where the line may lack all of them.
  template <typename Settings>
  void settings(std::optional<Settings>& settings, const std::string& prefix)
  {
    const auto first = words_.lower_bound(prefix);
    if (first != words_.end() && first->first.rfind(prefix, 0) == 0)
    {
      settings.emplace();
    }
    if (settings)
    {
      this->settings(*settings, prefix);
    }
  }

private:
  Line(const std::string& text, bool isRead)
    : text_(text)
    , isRead_(isRead)
  {
    std::istringstream stream(isRead ? text : std::string());
    for (std::string word; stream >> word;)
    {
      const std::size_t equals = std::min(word.find('='), word.size());
      isFine_ = isFine_ && equals > 0 && equals < word.size();
      words_[word.substr(0, equals)] = word.substr(std::min(equals + 1, word.size()));
    }
  }

  std::string text_;
  std::map<std::string, std::string> words_;
  bool isRead_ = false;
  bool isFine_ = true;
};

} // namespace keyed
} // namespace pointhaptics
